"""The thesis as a user reproduces it, with the numbers it must give."""

import json
import re

import numpy as np
import pytest

from asperity.store import read_dataset
from asperity.thesis import run
from asperity.thesis.contents import CLAIMS, FIGURES, TABLES


@pytest.fixture(scope="module")
def result(tmp_path_factory):
    # One folder for all test processes: whoever comes second finds the figures there.
    base = tmp_path_factory.getbasetemp()
    shared = base.parent if base.name.startswith("popen-") else base
    return run(shared / "thesis")


def test_every_figure_has_a_picture_and_its_numbers(result):
    assert [figure.number for figure in result.figures] == list(FIGURES)
    for figure in result.figures:
        assert figure.picture.read_bytes().startswith(b"\x89PNG")
        dataset = read_dataset(figure.dataset)
        for variable in dataset.variables.values():
            assert variable.attrs["units"]
            assert variable.attrs["long_name"]
            assert variable.dtype.kind != "f" or np.all(np.isfinite(variable.values))


@pytest.mark.parametrize(
    ("claim", "verdict"),
    [
        ("4.1", "reproduced"),
        ("4.2", "reproduced"),
        ("4.3", "reproduced"),
        ("4.4", "reproduced"),
        ("4.5", "reproduced"),
        ("4.6", "differs"),
        ("4.7", "reproduced"),
        ("4.8", "differs"),
    ],
)
def test_each_claim_has_its_verdict(result, claim, verdict):
    (entry,) = [entry for entry in result.claims if entry.id == claim]
    assert entry.finding.verdict == verdict, entry.finding.reason


@pytest.mark.parametrize(
    ("claim", "name", "value", "tolerance"),
    [
        ("4.1", "L2_drive_force_N", 1.693, 2e-3),
        ("4.1", "L4_drive_force_N", 1.809, 1e-3),
        ("4.1", "L5_drive_force_N", 3.187, 1e-3),
        ("4.1", "L6_drive_force_N", 3.533, 1e-3),
        ("4.2", "drive_stiffness_N_per_m", 96068.0, 1e-5),
        ("4.3", "friction_x_max_N", 5.417, 1e-3),
        ("4.3", "friction_x_max_two_phase_N", 5.4254, 1e-3),
        ("4.4", "breakaway_time_s", 0.11526, 1e-4),
        ("4.4", "breakaway_time_table_4_4_s", 0.10650, 1e-4),
        ("4.5", "ratio_k_1_split", 0.95599, 1e-3),
        ("4.5", "ratio_k_1_unsplit", 0.98390, 1e-3),
        ("4.5", "ratio_k_1_vector", 0.88061, 1e-3),
        ("4.5", "ratio_k_1_two_phase", 0.95585, 1e-3),
        ("4.6", "crossing_k", 1.204, 1e-3),
        ("4.8", "ratio_90deg", 0.13968, 1e-3),
        ("4.8", "ratio_0deg", 0.03333, 1e-3),
    ],
)
def test_the_ledger_has_the_reference_numbers(result, claim, name, value, tolerance):
    (entry,) = [entry for entry in result.claims if entry.id == claim]
    assert entry.finding.numbers[name] == pytest.approx(value, rel=tolerance)


def test_lugre_without_its_extras_is_dahl_to_the_last_bit(result):
    (entry,) = [entry for entry in result.claims if entry.id == "4.7"]
    assert entry.finding.numbers["largest_difference"] < 1e-12


def figure(result, number):
    (files,) = [files for files in result.figures if files.number == number]
    return read_dataset(files.dataset)


@pytest.mark.parametrize(
    ("k", "two_phase", "converged"),
    [(1.0, 1.0, 1.0), (2.0, 0.55609, 0.55587), (6.0, 0.13649, 0.13700), (20.0, 0.03335, 0.03333)],
)
def test_the_longitudinal_curves_go_through_the_reference_values(result, k, two_phase, converged):
    dataset = figure(result, "4.17")
    marched = dataset.sel(k_marched=k)
    assert float(marched["two_phase"]) == pytest.approx(two_phase, rel=1e-3)
    assert float(marched["exponential"]) == pytest.approx(converged, rel=1e-3)
    periodic = dataset["periodic"].sel(k=k, law="split")
    assert float(periodic) == pytest.approx(converged, rel=1e-3)


@pytest.mark.parametrize(
    ("k", "split", "unsplit", "vector", "rigid"),
    [
        (1.0, 0.95599, 0.98390, 0.88061, 0.90064),
        (6.0, 0.40460, 0.49686, 0.33603, 0.42007),
        (20.0, 0.13968, 0.14317, 0.12898, 0.18093),
    ],
)
def test_the_transverse_curves_go_through_the_reference_values(
    result, k, split, unsplit, vector, rigid
):
    dataset = figure(result, "4.20")
    here = dataset.isel(k=int(np.argmin(np.abs(dataset["k"].values - k))))
    for law, value in (("split", split), ("unsplit", unsplit), ("vector", vector)):
        assert float(here["periodic"].sel(law=law)) == pytest.approx(value, rel=1e-3), law
    assert float(here["rigid"]) == pytest.approx(rigid, rel=1e-4)


def test_the_two_phase_undulation_is_there_and_the_real_one_is_small(result):
    dataset = figure(result, "4.18")

    def swing(scheme):
        time = dataset[f"time_{scheme}"].values
        force = dataset[f"drive_force_{scheme}"].values
        return np.ptp(force[time > time[-1] - 1e-3])

    assert swing("two_phase") == pytest.approx(0.0256, rel=0.01)
    assert swing("exponential") == pytest.approx(0.0034, rel=0.02)


def test_transverse_friction_has_its_reference_extremes(result):
    friction = figure(result, "4.22")["friction_two_phase"]
    along, across = friction.sel(axis="x"), friction.sel(axis="y")
    assert float(along.min()) == pytest.approx(0.3652, rel=2e-3)
    assert float(along.max()) == pytest.approx(1.3046, rel=2e-3)
    assert float(across.max()) == pytest.approx(5.0625, rel=1e-3)
    assert float(across.min()) == pytest.approx(-5.0625, rel=1e-3)


def test_exponential_and_two_phase_friction_lie_together(result):
    dataset = figure(result, "4.19")
    two_phase = dataset["friction_two_phase"].sel(axis="x")
    time = dataset["time_exponential"].values
    there = np.interp(time, dataset["time_two_phase"].values, two_phase.values)
    here = dataset["friction_exponential"].sel(axis="x").values
    assert np.max(np.abs(here - there)) < 0.05 * 5.5
    assert time[-1] == pytest.approx(2.0 / 4000.0, rel=0.02)


def test_every_direction_is_drawn_at_every_k_and_lugre_lies_on_dahl(result):
    dataset = figure(result, "4.23")
    assert dataset["dahl"].shape == (5, 25)
    assert float(dataset["dahl"].sel(k=6.0, theta=0.0)) == pytest.approx(0.13839, rel=5e-3)
    assert float(dataset["dahl"].sel(k=6.0, theta=45.0)) == pytest.approx(0.20336, rel=5e-3)
    assert float(dataset["dahl"].sel(k=6.0, theta=90.0)) == pytest.approx(0.40488, rel=5e-3)
    dahl = dataset["periodic"].sel(k=[2.0, 20.0], theta_dense=dataset["theta"].values).values
    assert dataset["lugre"].values == pytest.approx(dahl, abs=1e-12)


def test_the_page_is_one_file_that_fetches_nothing(result):
    page = result.index.read_text("utf-8")
    assert "<script" not in page
    assert "http" not in page
    sources = re.findall(r'src="([^"]{0,30})', page)
    assert len(sources) == len(FIGURES)
    assert all(source.startswith("data:image/png;base64,") for source in sources)
    assert not re.search(r"<link|@import|url\(", page)


def test_the_page_shows_every_claim_with_its_verdict_in_words_and_its_commands(result):
    page = result.index.read_text("utf-8")
    for entry in result.claims:
        assert f'id="claim-{entry.id}"' in page
    assert page.count("✓ reproduced") == 6
    assert page.count("≠ differs") == 2
    assert "asperity slide table-4.3 --set solve.method=periodic" in page


def test_a_second_run_finds_everything_and_says_so(result):
    lines = []
    again = run(result.index.parent, progress=lines.append)
    assert all(files.reused for files in again.figures)
    assert [entry.to_json() for entry in again.claims] == [e.to_json() for e in result.claims]
    assert len(lines) == len(FIGURES) + len(TABLES) + len(CLAIMS)
    assert all(line.endswith("there already") for line in lines)


def test_the_result_is_plain_json(result):
    plain = json.loads(json.dumps(result.to_json(), allow_nan=False))
    assert plain["index"] == str(result.index)
    assert len(plain["claims"]) == len(CLAIMS)
    assert plain["figures"][0]["number"] == "2.7"
