"""``asperity export`` as a user runs it."""

import json

import pytest

from asperity.files.shipped import shipped_cases


def test_abaqus_gets_a_deck_and_the_friction_subroutine(asperity, tmp_path):
    folder = tmp_path / "to" / "abaqus"
    code, output, errors = asperity(
        "export", "block-longitudinal", "--to", "abaqus", "--out", folder
    )
    assert (code, errors) == (0, "")
    assert output.splitlines() == [str(folder / "block.inp"), str(folder / "user.f")]
    assert sorted(path.name for path in folder.iterdir()) == ["block.inp", "user.f"]
    assert "*FRICTION, USER, DEPVAR=3, PROPERTIES=10" in (folder / "block.inp").read_text()
    assert "      SUBROUTINE FRIC(LM,TAU,DDTDDG,DDTDDP" in (folder / "user.f").read_text()


def test_calculix_gets_a_deck_and_without_a_folder_it_stands_in_out(asperity, tmp_path):
    code, output, errors = asperity("export", "block-transverse", "--to", "calculix", cwd=tmp_path)
    assert (code, errors) == (0, "")
    assert output.splitlines() == ["out/calculix/block.inp"]
    assert (tmp_path / "out" / "calculix" / "block.inp").read_text().startswith("*HEADING")


def test_one_object_names_the_files(asperity, tmp_path):
    code, output, errors = asperity(
        "export", "block-transverse", "--to", "abaqus", "--out", tmp_path, "--json",
        "--set", "block.element=hex8", "--set", "solve.scheme=two-phase",
    )  # fmt: skip
    assert (code, errors) == (0, "")
    assert output.count("\n") == 1
    assert json.loads(output) == {
        "to": "abaqus",
        "files": [str(tmp_path / "block.inp"), str(tmp_path / "user.f")],
    }
    assert "TYPE=C3D8," in (tmp_path / "block.inp").read_text()
    assert "two explicit phases" in (tmp_path / "user.f").read_text()


def test_the_mean_friction_of_a_body_is_taken_to_c(asperity, tmp_path):
    code, output, errors = asperity("export", "table-4.4", "--to", "c", "--out", tmp_path)
    assert (code, errors) == (0, "")
    assert output.splitlines() == [str(tmp_path / name) for name in ("law.c", "law.h")]
    header = (tmp_path / "law.h").read_text()
    assert "slider.normal_force = 50.8 N" in header
    assert "double asperity_friction(double velocity);" in header


@pytest.mark.slow
def test_over_a_value_the_mean_friction_is_a_map(asperity, tmp_path):
    over = "vibration.velocity_ratio=6,2"
    code, _, errors = asperity(
        "export", "table-4.4", "--to", "csv", "--over", over, "--out", tmp_path
    )
    assert (code, errors) == (0, "")
    rows = [line for line in (tmp_path / "map.csv").read_text().splitlines() if line[0] != "#"]
    assert rows[0].startswith("vibration.velocity_ratio,velocity [m/s],friction [N]")
    assert {row.partition(",")[0] for row in rows[1:]} == {"2.0", "6.0"}


def test_the_law_of_the_asperities_is_taken_to_c_and_matlab(asperity, tmp_path):
    code, output, errors = asperity(
        "export", "table-4.3", "--to", "dahl", "--set", "friction.law=vector", cwd=tmp_path
    )
    assert (code, errors) == (0, "")
    names = [f"out/dahl/asperity_dahl.{kind}" for kind in ("c", "h", "m")]
    assert output.splitlines() == names
    source, header, matlab = ((tmp_path / name).read_text() for name in names)
    assert "#define LENGTH 6.875e-08 " in source
    assert "slider.normal_force = 55 N" in header
    first = "function [next, force] = asperity_dahl(state, velocity, normal_force, dt)"
    assert matlab.startswith(f"{first}\n%#codegen\n")


@pytest.mark.parametrize(
    ("arguments", "line"),
    [
        (
            ["gearset-3", "--to", "c"],
            "gearset-3: the table [slider] is missing; add it",
        ),
        (
            ["table-4.4", "--to", "c", "--over", "friction.law=split,vector"],
            "--over friction.law=split,vector: a map is over two numbers or more",
        ),
        (
            ["table-4.3", "--to", "dahl"],
            "table-4.3: friction.law is 'split'; the law that is written step by step is "
            "'vector', which is the same along a line: set friction.law to 'vector'",
        ),
        (
            ["block-longitudinal", "--to", "abaqus", "--over", "friction.mu=0.1,0.2"],
            "--over is for 'c', 'csv', 'mat'; leave it out with --to abaqus",
        ),
        (
            ["block-longitudinal", "--to", "abacus"],
            "--to abacus: it must be one of 'abaqus', 'calculix', 'c', 'csv', "
            "'mat', 'dahl' (did you mean 'abaqus'?)",
        ),
        (
            ["block-longitudinal"],
            "asperity export: missing option '--to'; see asperity export --help",
        ),
        (
            ["table-4.3", "--to", "abaqus"],
            "table-4.3: the table [block] is missing; add it",
        ),
        (
            ["block-longitudinal", "--to", "abaqus", "--set", "friction.model=lugre"],
            "friction.model is 'lugre'; FRIC is written for 'dahl' (for 'coulomb' the deck uses "
            "Abaqus's own friction)",
        ),
        (
            [
                "block-longitudinal",
                "--to",
                "abaqus",
                "--set",
                "block.elements=[200, 100, 100]",
            ],
            "block.elements is [200, 100, 100] with 'hex27', 16200801 nodes; a deck is written "
            "with at most 2000000: take fewer elements",
        ),
        (
            ["block-longitudinal", "--to", "calculix", "--set", "slider.normal_force=40 MN"],
            "slider.normal_force is 4e+07 N, a mean pressure of 3.333e+10 Pa; block.youngs_modulus "
            "is 2.09e+11 Pa; it must be at least 3.333e+11 Pa, for the deformation to be small",
        ),
        (
            ["block-transverse", "--to", "abaqus", "--set", "contact.stiffness=1 kPa/m"],
            "slider.normal_force is 50.8 N, a mean pressure of 4.233e+04 Pa; contact.stiffness is "
            "1000 Pa/m; it must be at least 1.411e+07 Pa/m, for the overclosure to be small",
        ),
        (
            ["block-longitudinal", "--to", "abaqus", "--set", "block.element=hex20"],
            "--set block.element=hex20: block.element is 'hex20'; it must be one of 'hex27', "
            "'hex8', 'hex8i' (did you mean 'hex27'?)",
        ),
        (
            ["block-longitudinal", "--to", "calculix", "--out", "taken"],
            "taken cannot be used as output folder: file exists; choose another",
        ),
    ],
)
def test_what_cannot_be_written_is_said_in_one_line(asperity, tmp_path, arguments, line):
    (tmp_path / "taken").touch()
    code, output, errors = asperity("export", *arguments, cwd=tmp_path)
    assert (code, output, errors) == (2, "", line + "\n")
    assert [path.name for path in tmp_path.iterdir()] == ["taken"]


@pytest.mark.slow
def test_a_drive_that_is_all_but_none_is_one_line(asperity, tmp_path):
    code, output, errors = asperity(
        "export", "table-4.4", "--to", "csv", "--set", "solve.method=periodic",
        "--set", "slider.drive_stiffness=1.8e-156 N/m", cwd=tmp_path,
    )  # fmt: skip
    assert (code, output, errors.count("\n")) == (3, "", 1)
    assert "the powers do not balance" in errors


def test_a_line_feed_in_the_name_of_a_case_begins_no_line_of_a_deck(asperity, tmp_path):
    name = "a\n*INCLUDE, INPUT=theirs.inp\n.toml"
    (tmp_path / name).write_bytes(shipped_cases()["block-longitudinal"].read_bytes())
    code, _, errors = asperity("export", name, "--to", "abaqus", "--out", "out", cwd=tmp_path)
    assert (code, errors) == (0, "")
    lines = (tmp_path / "out" / "block.inp").read_text().splitlines()
    assert not [line for line in lines if line.startswith("*INCLUDE")]


@pytest.mark.parametrize(
    ("case", "program", "name", "told"),
    [
        ("block-transverse", "abaqus", "appendix-e", "is of a gearset's deck"),
        ("drive-thesis", "calculix", "appendix-e", "--subroutine is for --to abaqus"),
        ("drive-thesis", "abaqus", "appendix-f", "it must be 'appendix-e'"),
    ],
)
def test_the_subroutine_of_appendix_e_is_for_a_gearset_in_abaqus_alone(
    asperity, tmp_path, case, program, name, told
):
    code, output, errors = asperity(
        "export", case, "--to", program, "--subroutine", name, "--out", tmp_path / "deck"
    )
    assert (code, output) == (2, "")
    assert told in errors
    assert errors.count("\n") == 1
    assert not (tmp_path / "deck").exists()
