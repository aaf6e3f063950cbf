"""Static friction from the command line."""

import json
import signal

import pytest

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.files.store import read_dataset
from asperity.runs import Run
from asperity.slider import static

NORMAL = [
    "--set", "friction.law=vector", "--set", "vibration.elevation=90 deg",
    "--set", "normal.stiffness=97.12 MN/m", "--set", "normal.damping_ratio=0.05",
]  # fmt: skip


@pytest.mark.slow
def test_static_friction_stands_beside_its_closed_form_and_the_load_it_is_of(asperity, tmp_path):
    folder = tmp_path / "out"
    code, output, errors = asperity("static", "table-4.3", *NORMAL, "--json", "--out", folder)
    assert code == 0
    assert errors == f"written to {folder}: static.json, static.nc, static.png, report.html\n"
    answer = json.loads(output)
    assert answer["static_force_N"] == pytest.approx(5.5 * answer["static_ratio"])
    assert answer["static_ratio"] == pytest.approx(answer["closed_form_ratio"], abs=1e-4)
    assert answer["closed_form"] == "mu N_min"
    assert answer["normal_min_N"] == pytest.approx(55.0 * answer["closed_form_ratio"])
    assert answer["normal_mean_N"] == pytest.approx(55.0)
    assert (answer["open_share"], answer["period"]) == (0.0, 1)
    assert answer["creep_m_s"] > 0.0
    dataset = read_dataset(folder / "static.nc")
    assert float(dataset["static_ratio"]) == answer["static_ratio"]
    assert dataset.attrs["normal.stiffness"] == 97.12e6


def test_static_friction_in_the_plane_has_no_normal_force_that_changes(asperity):
    code, output, errors = asperity("static", "table-4.3", "--set", "friction.exponent=0")
    assert (code, errors) == (0, "")
    assert output.isascii()
    assert "static friction over mu W" in output
    assert "N_min" not in output


@pytest.mark.parametrize(
    ("arguments", "part"),
    [
        (["table-4.1-L3"], "slider.mass is missing"),
        (["table-4.3", "--set", "vibration.velocity_ratio=0"], "nothing vibrates"),
        (["table-4.3", "--set", "solve.scheme=two-phase"], "solve.scheme is 'two-phase'"),
        (["table-4.4", "--set", "friction.mu=4e-177"], "times as slowly as it is shaken"),
    ],
)
def test_a_body_that_cannot_be_held_is_refused_in_one_line(asperity, arguments, part):
    code, output, errors = asperity("static", *arguments)
    assert (code, output) == (2, "")
    assert errors.count("\n") == 1
    assert part in errors


def test_ctrl_c_ends_the_search_at_the_pull_it_is_pressed_in():
    pulls = []

    def press(done, _):
        pulls.append(done)
        if done == 3:
            signal.raise_signal(signal.SIGINT)

    case = read_case("table-4.3", case_tables(), ["friction.exponent=0"])
    with pytest.raises(KeyboardInterrupt):
        static.answer(static.prepare(case), Run(progress=press))
    assert pulls == [1, 2, 3]
