"""The command line: what it prints, how it ends, and what it says about a mistake."""

import json
import math
import os
import re
import shlex
import subprocess
import sys

import pytest
from apparatus.grid import slow

from asperity.cli.main import main
from asperity.files.store import read_dataset

SHORT = ["--set", "solve.duration=20 ms", "--set", "vibration.start=2 ms"]
# An overshoot of the limit that grows, below the bound of the linear stability.
OVERSHOT = [
    "--set", "solve.scheme=two-phase", "--set", "friction.exponent=2",
    "--set", "solve.step=9.7 us", "--set", "vibration.direction=0 deg",
]  # fmt: skip
KEYS = {
    "ratio", "drive_force_N", "static_drive_force_N", "breakaway_time_s", "friction_x_mean_N",
    "friction_x_max_N", "friction_x_min_N", "friction_y_max_N", "power_residual", "residual",
    "method", "law", "scheme", "steps", "cycles", "seconds",
}  # fmt: skip
PROGRAM = """
import shlex, sys
from asperity.cli.main import main
for line in sys.argv[1:]:
    try:
        main(shlex.split(line))
    except SystemExit as end:
        assert not end.code, end.code
print("loaded:", *sorted(sys.modules), file=sys.stderr)
"""


def one_object(output):
    assert output.count("\n") == 1
    return json.loads(output, parse_constant=lambda name: pytest.fail(f"{name} is no JSON"))


def test_a_slide_prints_one_object_with_the_keys_of_the_contract(asperity):
    code, output, errors = asperity("slide", "table-4.3", *SHORT, "--json")
    assert (code, errors) == (0, "")
    answer = one_object(output)
    assert answer.keys() >= KEYS
    assert answer["static_drive_force_N"] == pytest.approx(5.5)
    assert answer["drive_force_N"] == pytest.approx(5.5 * answer["ratio"])
    assert (answer["method"], answer["law"], answer["scheme"]) == ("march", "split", "exponential")
    assert answer["steps"] == 20_000


def test_a_periodic_slide_has_no_breakaway(asperity):
    code, output, _ = asperity("slide", "table-4.4", "--set", "solve.method=periodic", "--json")
    assert code == 0
    answer = one_object(output)
    assert answer["breakaway_time_s"] is None
    assert answer["ratio"] == pytest.approx(0.4046, rel=1e-3)


@pytest.mark.slow
def test_pictures_are_written_as_asked(asperity, tmp_path):
    out = ["--out", tmp_path / "out"]
    code, _, errors = asperity("sensitivity", "gearset-2", *out, "--format", "bmp")
    assert (code, errors) == (2, "--format bmp: it must be one of 'png', 'svg', 'pdf'\n")
    assert not (tmp_path / "out").exists()
    code, _, errors = asperity("sensitivity", "gearset-2", *out, "--format", "pdf")
    assert code == 0
    assert "sensitivity.json, sensitivity.nc, sensitivity.pdf" in errors
    assert (tmp_path / "out" / "sensitivity.pdf").read_bytes().startswith(b"%PDF")
    assert not (tmp_path / "out" / "sensitivity.png").exists()


def test_a_slide_is_readable_and_names_symbols_and_units(asperity):
    code, output, errors = asperity("slide", "table-4.3", *SHORT)
    assert (code, errors) == (0, "")
    assert output.isascii()
    assert max(map(len, output.splitlines())) <= 80
    assert re.search(r"^drive force without vibration +mu F_N +5\.5 +N$", output, re.MULTILINE)


@pytest.mark.slow
def test_a_slide_writes_dataset_picture_and_scalars(asperity, tmp_path):
    folder = tmp_path / "new" / "out"
    code, output, errors = asperity("slide", "table-4.3", *SHORT, "--json", "--out", folder)
    assert code == 0
    assert errors == f"written to {folder}: slide.json, slide.nc, slide.png, report.html\n"
    assert json.loads((folder / "slide.json").read_text()) == one_object(output)
    assert (folder / "slide.png").read_bytes().startswith(b"\x89PNG")
    dataset = read_dataset(folder / "slide.nc")
    assert dataset["drive_force"].attrs["units"] == "N"
    names = sorted(path.name for path in folder.iterdir())
    assert names == ["report.html", "slide.json", "slide.nc", "slide.png"]


@pytest.mark.parametrize(
    "arguments",
    [
        ["slide", "table-4.3", "--set", "friction.mu=-1"],
        ["slide", "table-4.3", "--set", "solve.step=1 ms"],
        ["slide", "table-4.3", "--set", "solve.duration=1 us"],
        ["slide", "table-4.3", "--set", "solve.step=1 ms", "--set", "solve.method=periodic"],
        ["sweep", "table-4.3", "--over", "friction.mu=-1,1"],
    ],
)
def test_a_case_that_is_refused_leaves_no_folder_behind(tmp_path, capsys, arguments):
    with pytest.raises(SystemExit) as ended:
        main([*arguments, "--out", str(tmp_path / "out")])
    assert ended.value.code == 2
    assert capsys.readouterr().err.count("\n") == 1
    assert not (tmp_path / "out").exists()


def test_samples_named_in_a_setting_are_looked_for_from_the_working_directory(
    tmp_path, monkeypatch, capsys
):
    monkeypatch.chdir(tmp_path)
    waves = [
        "table-4.4", "--set", "vibration.waveform=sampled", "--set", "solve.method=periodic",
    ]  # fmt: skip
    with pytest.raises(SystemExit) as ended:
        main(["slide", *waves, "--set", "vibration.samples=wave.csv"])
    assert ended.value.code == 2
    assert f"vibration.samples: {tmp_path / 'wave.csv'} cannot be read" in capsys.readouterr().err
    rows = [f"{n / 300e3!r},{math.sin(0.02 * math.pi * n)!r}\n" for n in range(101)]
    (tmp_path / "wave.csv").write_text("".join(rows))
    with pytest.raises(SystemExit) as ended:
        main(["slide", *waves, "--set", "vibration.samples=wave.csv", "--json"])
    assert not ended.value.code
    alone = one_object(capsys.readouterr().out)["ratio"]
    assert alone == pytest.approx(0.4046, rel=1e-3)
    with pytest.raises(SystemExit) as ended:
        main(["sweep", *waves, "--over", "vibration.samples=wave.csv", "--json"])
    assert not ended.value.code
    assert one_object(capsys.readouterr().out)["ratio"] == [pytest.approx(alone, rel=1e-9)]


def test_a_file_of_the_users_own_works_like_a_case_that_ships(asperity, tmp_path):
    file = tmp_path / "own.toml"
    file.write_text(
        '[slider]\ndrive_velocity = "1 mm/s"\nnormal_force = "10 N"\n'
        '[friction]\nmodel = "coulomb"\nmu = 0.2\n'
        '[vibration]\nfrequency = "1 kHz"\nvelocity_ratio = 2.0\n'
        '[solve]\nmethod = "periodic"\n'
    )
    code, output, _ = asperity("slide", "own.toml", "--json", cwd=tmp_path)
    assert code == 0
    assert one_object(output)["ratio"] == pytest.approx(1 / 3, rel=1e-3)


def test_no_convergence_ends_with_3_and_tells_what_was_reached(asperity):
    settings = [*OVERSHOT, "--set", "vibration.velocity_ratio=30"]
    code, output, errors = asperity("slide", "table-4.4", *settings, "--json")
    assert code == 3
    assert one_object(output)["reached"]["time_s"] > 0.0
    assert errors.count("\n") == 1
    assert re.search(r"\(reached: time_s [\d.e-]+\)$", errors.rstrip())


def test_the_cases_that_ship_are_listed(asperity):
    code, output, errors = asperity("cases")
    assert (code, errors) == (0, "")
    assert re.search(r"^table-4\.3 +body-shaken-along +Longitudinal", output, re.MULTILINE)
    code, output, _ = asperity("cases", "--json")
    listed = one_object(output)["cases"]
    assert {case["name"]: case["also"] for case in listed}["normal-pin"] == "pin-on-disc"
    names = [case["name"] for case in listed]
    assert {"table-4.3", "table-4.4", *(f"table-4.1-L{n}" for n in range(1, 7))} <= set(names)


@pytest.mark.slow
def test_a_sweep_prints_one_object_and_writes_what_it_found(asperity, tmp_path):
    code, output, errors = asperity(
        "sweep", "table-4.4", "--set", "solve.method=periodic", "--json", "--out", tmp_path,
        "--over", "vibration.velocity_ratio=2,6", "--over", "vibration.direction=0:90:90",
    )  # fmt: skip
    assert code == 0
    assert errors == f"written to {tmp_path}: sweep.json, sweep.nc, sweep.png, report.html\n"
    answer = one_object(output)
    assert answer["dims"] == ["vibration.velocity_ratio", "vibration.direction"]
    assert answer["coords"] == {
        "vibration.velocity_ratio": [2.0, 6.0],
        "vibration.direction": [0.0, 90.0],
    }
    assert answer["units"]["vibration.direction"] == "deg"
    assert (answer["points"], answer["cached"]) == (4, 0)
    assert answer["ratio"][1][1] == pytest.approx(0.4046, rel=1e-3)
    assert answer["file"] == str(tmp_path / "sweep.nc")
    dataset = read_dataset(answer["file"])
    assert dataset["ratio"].values.tolist() == answer["ratio"]
    assert (tmp_path / "sweep.png").read_bytes().startswith(b"\x89PNG")
    assert json.loads((tmp_path / "sweep.json").read_text())["ratio"] == answer["ratio"]


@pytest.mark.slow
def test_a_sweep_is_readable_as_a_matrix_or_a_list(asperity):
    sweep = ["sweep", "table-4.4", "--set", "solve.method=periodic"]
    code, output, _ = asperity(
        *sweep, "--over", "vibration.velocity_ratio=2,6", "--over", "friction.law=split,vector"
    )
    assert code == 0
    assert re.search(r"^velocity_ratio \\ law +split +vector$", output, re.MULTILINE)
    assert re.search(r"^6 +0\.404\d* +0\.336\d*$", output, re.MULTILINE)
    _, output, _ = asperity(*sweep, "--over", "vibration.direction=0:88:1")
    assert re.search(r"^direction \(deg\) +ratio$", output, re.MULTILINE)
    assert "... and 29 more rows; the files of --out, and --json, hold all" in output


@pytest.mark.slow
def test_a_sweep_in_which_a_point_fails_hands_back_the_others_and_ends_with_3(asperity, tmp_path):
    code, output, errors = asperity(
        "sweep", "table-4.4", *OVERSHOT, "--over", "vibration.velocity_ratio=30,2",
        "--json", "--out", tmp_path,
    )  # fmt: skip
    assert code == 3
    answer = one_object(output)
    assert answer["ratio"][0] is None
    assert answer["ratio"][1] > 0
    assert answer["failed"] == 1
    assert read_dataset(tmp_path / "sweep.nc")["status"].values.tolist() == [1, 0]
    assert errors.splitlines()[-1].startswith(
        "1 of 2 points did not converge, the first at vibration.velocity_ratio=30: the march left"
    )


@pytest.mark.slow
def test_the_thesis_makes_one_figure_when_asked_for_one(asperity, tmp_path):
    code, output, _ = asperity("thesis", "--only", "2.7", "--out", tmp_path, "--json")
    assert code == 0
    one_object(output)
    assert (tmp_path / "index.html").is_file()


@pytest.mark.ordinary(2)
@pytest.mark.parametrize("arguments", [[], ["--help"], ["-h"]])
def test_without_a_command_there_is_help(asperity, arguments):
    code, output, errors = asperity(*arguments)
    assert (code, errors) == (0, "")
    for command in ("slide", "sweep", "thesis", "cases"):
        assert command in output


def test_the_version_is_told(asperity):
    assert asperity("--version") == (0, "asperity 0.1.0\n", "")


@pytest.mark.ordinary(14)
@pytest.mark.parametrize(
    ("arguments", "parts"),
    [
        (["slide", "table-4.33"], ["table-4.33 is neither a file nor", "'table-4.3'"]),
        (["slide", "table-4.3", "--set", "vibratoin.start=1 s"], ["[vibratoin]", "'vibration'"]),
        (["slide", "table-4.3", "--set", "slider.mas=1 kg"], ["slider.mas ", "'mass'"]),
        (["slide", "table-4.3", "--set", "vibration.frequency=4 kN"], ["'4 kN'", "'4 kHz'"]),
        (["slide", "table-4.3", "--set", "friction.law=splt"], ["'splt'", "'split'"]),
        (["slide", "table-4.3", "--set", "slider.drive_stiffness=0 N/m"], ["0 N/m", "positive"]),
        (["slide", "table-4.3", "--set", "slider.drive_velocity=-1 mm/s"], ["must be positive"]),
        (["slide", "table-4.3", "--set", "solve.step=1 ms"], ["solve.step is 0.001 s, too coarse"]),
        (["slide", "table-4.3", "--set", "nonsense"], ["it must be table.key=value"]),
        (["slide", "missing.toml"], ["missing.toml: vibration.velocity_ratio is missing"]),
        (["slide", "two.toml"], ["two.toml: ", "velocity_ratio and", "are given; keep one"]),
        (["slide", "broken.toml"], ["broken.toml: not valid TOML"]),
        (["slide", "gap.toml"], ["wave.csv", "a gap of"]),
        (["slide", "nan.toml"], ["nan.csv", "fill the gap"]),
        (["slide", "table-4.3", "--out", "taken"], ["taken cannot be used as output folder"]),
        (["slide", "table-4.3", "--out", ""], ["'--out': it is empty", "give a folder"]),
        (["export", "block-longitudinal", "--to", "abaqus", "--out", ""], ["it is empty"]),
        (["thesis", "--out", ""], ["it is empty"]),
        (["slide", "table-4.3", "--out", "/dev/null/x"], ["/dev/null/x cannot be used"]),
        (["sweep", "table-4.3", "--over", "friction.mu=0.1", "--out", "taken"], ["taken cannot"]),
        (["sweep", "table-4.3", "--over", "friction.mu=1:2"], ["start:stop:step"]),
        (["sweep", "table-4.3", "--over", "friction.law=split,vectr"], ["'vectr'", "'vector'"]),
        (["sweep", "table-4.3"], ["no axis; give one", "--over", "--points"]),
        (["sweep", "nope", "--over", "friction.mu=1"], ["nope is neither a file"]),
        (["thesis", "--only", "4.99"], ["4.99"]),
        (["slide"], ["missing argument 'CASE'", "asperity slide --help"]),
        (["slide", "table-4.3", "--sett", "x"], ["no such option: --sett"]),
        (["slide", "table-4.3", "extra"], ["extra"]),
        (["slyde", "table-4.3"], ["no such command 'slyde'", "'slide'"]),
    ],
)
def test_a_mistake_is_one_line_and_ends_with_2(folder, monkeypatch, capsys, arguments, parts):
    monkeypatch.chdir(folder)
    with pytest.raises(SystemExit) as ended:
        main(arguments)
    output, errors = capsys.readouterr()
    assert (ended.value.code, output) == (2, "")
    assert errors.count("\n") == 1
    for part in parts:
        assert part in errors


@pytest.mark.slow
@pytest.mark.parametrize(
    "arguments",
    [
        ["--help"],
        ["slide", "table-4.3", *SHORT],
        slow(["slide", "table-4.4", *OVERSHOT, "--set", "vibration.velocity_ratio=30", "--json"]),
        slow(["rate", "gearset-3", "--standard", "bs721"]),
    ],
)
def test_a_process_of_its_own_answers_what_is_answered_here(asperity, asperity_process, arguments):
    assert asperity_process(*arguments) == asperity(*arguments)


@pytest.mark.slow
def test_a_mistake_ends_the_process_with_2(asperity_process):
    mistake = ["slide", "table-4.3", "--set", "friction.mu=-1", "--json"]
    code, output, errors = asperity_process(*mistake)
    assert (code, output) == (2, "")
    assert errors == "--set friction.mu=-1: friction.mu is -1; it must be above 0 and at most 100\n"


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A folder of files with one mistake each."""
    folder = tmp_path_factory.mktemp("mistakes")
    good = (
        '[slider]\ndrive_velocity = "1 mm/s"\nnormal_force = "10 N"\n'
        '[friction]\nmodel = "coulomb"\nmu = 0.2\n[vibration]\n'
    )
    sampled = 'waveform = "sampled"\nvelocity_ratio = 2\nsamples = '
    (folder / "missing.toml").write_text(f'{good}frequency = "1 kHz"\n')
    (folder / "two.toml").write_text(
        f'{good}frequency = "1 kHz"\nvelocity_ratio = 2\nvelocity_amplitude = "1 mm/s"\n'
    )
    (folder / "broken.toml").write_text(f"{good}frequency = = 3\n")
    (folder / "gap.toml").write_text(f'{good}{sampled}"wave.csv"\n')
    (folder / "nan.toml").write_text(f'{good}{sampled}"nan.csv"\n')
    rows = [f"{n * 1e-5:g},{n % 10}" for n in (*range(30), *range(50, 61))]
    (folder / "wave.csv").write_text("\n".join(rows))
    (folder / "nan.csv").write_text("\n".join([*rows[:20], "0.1,nan", *rows[20:]]))
    (folder / "taken").touch()
    return folder


def test_a_reader_who_leaves_early_is_not_told_off(start):
    read, write = os.pipe()
    os.close(read)
    process = start("cases", stdout=write)
    os.close(write)
    _, errors = process.communicate(timeout=180)
    assert errors == ""


@pytest.mark.slow
@pytest.mark.parametrize(
    ("lines", "absent"),
    [
        (["--help"], {"numpy", "numba", "pydantic", "matplotlib", "xarray", "scipy"}),
        (["cases"], {"numpy", "numba", "pydantic", "matplotlib", "xarray", "scipy"}),
        (
            ["rate gearset-2", "sensitivity gearset-2"],
            {"matplotlib", "pint", "rich", "scipy"}
            | {f"asperity.{room}" for room in ("block", "slider", "vibration")}
            # Flanks and shafts are for a rating that they add to.
            | {"asperity.flanks", "asperity.shafts.study"},
        ),
        (
            ["rate gearset-3", "sensitivity gearset-3", "methods gearset-3"],
            {"numba", "llvmlite", "matplotlib", "pint", "rich", "scipy.stats"},
        ),
        (
            [shlex.join(["slide", "table-4.3", *SHORT, "--json"])],
            {"matplotlib", "xarray", "pandas", "h5py", "distributed", "sqlite3", "rich"}
            | {f"scipy.{part}" for part in ("integrate", "interpolate", "optimize", "special")},
        ),
    ],
)
def test_what_a_command_does_not_need_is_not_loaded(environment, lines, absent):
    ended = subprocess.run(
        [sys.executable, "-c", PROGRAM, *lines],
        env=environment, capture_output=True, text=True, timeout=180, check=True,
    )  # fmt: skip
    loaded = set(ended.stderr.rpartition("loaded:")[2].split())
    assert "asperity.cli.main" in loaded
    assert not loaded & absent
