"""A fit names what spoils it, what no law can give, and what it does not know."""

import dataclasses
import math
from types import SimpleNamespace

import numpy as np
import pytest

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.errors import ConvergenceError, InputError
from asperity.results.terminal import rendered
from asperity.runs import Run
from asperity.tribometer.fit import forward, study
from asperity.tribometer.fit.estimate import Fit
from asperity.tribometer.fit.outliers import spoilt
from asperity.tribometer.fit.study import answer, prepare

LIMIT, MU, AMPLITUDE = "friction.max_deflection", "friction.mu", "vibration.velocity_ratio"
K = np.array([1.3, 1.6, 2.0, 3.0, 4.0, 6.0])


def curve(k, limit, mu):
    """A ratio that falls with the vibration, the later the softer the contact is."""
    return 1.0 / (1.0 + (k / (limit / 25e-9)) ** (10.0 * mu))


class Smooth:
    """Stands in for a `Predictor`: a smooth curve of two parameters."""

    marched = solves = rigid = 0

    def __call__(self, conditions, given):
        k = np.array([one.get(AMPLITUDE, 2.0) for one in conditions])
        return curve(k, given[LIMIT], given.get(MU, 0.2)), {}


def solved(folder, monkeypatch, values, *, sd=0.01, free=f"{LIMIT},{MU}", settings=()):
    monkeypatch.setattr(study, "Predictor", lambda *_: Smooth())
    head = f"{AMPLITUDE},ratio" + (",sd" if sd else "")
    rows = [f"{k},{v:.6g}" + (f",{sd}" if sd else "") for k, v in zip(K, values, strict=False)]
    (folder / "data.csv").write_text("\n".join([head, *rows]), "utf-8")
    case = read_case("table-4.3", case_tables(), ["friction.mu=0.2", *settings])
    return answer(prepare(case, data=str(folder / "data.csv"), free=free), Run())


def said(result):
    return " / ".join(result.notes)


TRUE = curve(K, 70e-9, 0.21)


def test_a_row_that_spoils_a_fit_is_named_with_its_residual(tmp_path, monkeypatch):
    values = TRUE.copy()
    values[4] += 0.25
    result = solved(tmp_path, monkeypatch, values)
    (one,) = result.to_json()["outliers"]
    assert (one["row"], one["measurement"]) == (6, 5)
    assert one["by_the_others"] == pytest.approx(TRUE[4], abs=1e-3)
    # Its own deviation and that of what the others say of it: not over 25.
    assert 18.0 < one["standardised_residual"] < 25.0
    assert "the 5th measurement (row 6) spoils the fit" in said(result)
    assert f"{LIMIT} 70 nm" in said(result)


def test_two_rows_on_one_side_do_not_hide_each_other():
    rng = np.random.default_rng(4)
    x = np.linspace(1.0, 2.0, 16)
    y = 2.0 * x + 0.01 * rng.normal(size=16)
    y[[13, 14]] += 0.5
    fit = Fit(lambda p: (y - math.exp(p[0]) * x) / 0.01, np.full(1, -9.0), np.full(1, 9.0))
    best = fit.least(np.zeros(1))
    for weighed in (True, False):
        found = spoilt(fit, best, np.zeros(1), weighed)
        assert [one.measurement for one in found.outliers] == [13, 14]
        assert math.exp(found.point[0]) == pytest.approx(2.0, rel=5e-3)


@pytest.mark.slow
def test_noise_alone_is_no_outlier_and_hardly_ever_called_one():
    named = 0
    x = np.linspace(1.0, 2.0, 12)
    for seed in range(60):
        y = 2.0 * x + 0.01 * np.random.default_rng(seed).normal(size=12)
        fit = Fit(lambda p, y=y: (y - math.exp(p[0]) * x) / 0.01, np.full(1, -9.0), np.full(1, 9.0))
        best = fit.least(np.zeros(1))
        named += any(spoilt(fit, best, np.zeros(1), weighed) for weighed in (True, False))
    assert named <= 2


def test_a_wrong_law_is_not_laid_upon_single_rows(tmp_path, monkeypatch):
    result = solved(tmp_path, monkeypatch, 0.2 + 0.1 * np.arange(6) % 0.31, free=LIMIT)
    assert result.to_json()["outliers"] == []
    assert "no few rows account for it" in said(result)


def test_without_deviations_intervals_follow_from_the_residuals(tmp_path, monkeypatch):
    values = TRUE + 0.004 * np.array([1.0, -1.0, 0.5, -1.0, 1.0, -0.5])
    result = solved(tmp_path, monkeypatch, values, sd=None)
    left = result.measured - result.predicted
    assert result.to_json()["deviation_known"] is False
    assert result.deviation == pytest.approx(math.sqrt(float(left @ left) / 4.0), rel=1e-6)
    assert result.chi2 == pytest.approx(4.0)
    assert "without sd all measurements weigh the same" in said(result)
    # Student's distribution of four degrees of freedom, where known deviations take 1.96.
    known = solved(tmp_path, monkeypatch, values, sd=float(result.deviation[0]))
    for own, other in zip(result.parameters, known.parameters, strict=True):
        widths = [math.log(one.ends[1] / one.ends[0]) for one in (own, other)]
        assert widths[0] / widths[1] == pytest.approx(2.776 / 1.960, rel=0.02)


def test_of_many_sets_without_deviations_intervals_hold_the_truth(tmp_path, monkeypatch):
    monkeypatch.setattr(study, "Predictor", lambda *_: Smooth())
    solved(tmp_path, monkeypatch, TRUE, sd=None)
    case = read_case("table-4.3", case_tables(), ["friction.mu=0.2"])
    problem = prepare(case, data=str(tmp_path / "data.csv"), free=LIMIT)
    held = []
    for seed in range(40):
        noise = 0.01 * np.random.default_rng(seed).normal(size=6)
        data = dataclasses.replace(problem.data, values=curve(K, 70e-9, 0.2) + noise)
        (one,) = answer(dataclasses.replace(problem, data=data), Run()).parameters
        held.append(one.ends[0] <= 70e-9 <= one.ends[1])
    assert 34 <= sum(held) <= 40


def test_an_exact_table_without_deviations_has_narrow_intervals(tmp_path, monkeypatch):
    (one, _) = solved(tmp_path, monkeypatch, TRUE, sd=None).parameters
    assert one.value == pytest.approx(70e-9, rel=1e-5)
    assert one.ends[0] < one.value < one.ends[1]


@pytest.mark.parametrize(
    ("settings", "told"),
    [
        ((), True),
        (("friction.model=lugre",), True),
        (("friction.model=lugre", "friction.static_mu=0.3", "friction.stribeck_velocity=1 mm/s"),
         False),
        (("normal.law=hertz", "normal.penetration=1 um"), False),
    ],
)  # fmt: skip
def test_ratios_above_one_that_no_law_can_give_are_told(tmp_path, monkeypatch, settings, told):
    values = [1.12, 1.03, 1.25, 0.9, 0.8, 0.7]
    result = solved(tmp_path, monkeypatch, values, sd=0.02, free=LIMIT, settings=settings)
    assert ("the ratios of rows 2, 4 lie above 1" in said(result)) is told


def test_as_many_parameters_as_measurements_are_warned_of(tmp_path, monkeypatch):
    result = solved(tmp_path, monkeypatch, TRUE[:2])
    assert result.dof == 0
    assert "leave nothing that would show a wrong law" in said(result)
    missed = solved(tmp_path, monkeypatch, [0.3, 0.6])
    assert "with 0 degrees of freedom, where it should be 0" in said(missed)


def test_parameters_that_go_together_stand_on_the_terminal(tmp_path, monkeypatch):
    class Product(Smooth):
        def __call__(self, conditions, given):
            k = np.array([one[AMPLITUDE] for one in conditions])
            return given[MU] / 0.2 * (given[LIMIT] / 70e-9 / k) ** 1.05, {}

    monkeypatch.setattr(study, "Predictor", lambda *_: Product())
    head = f"{AMPLITUDE},ratio,sd"
    rows = [f"{k},{1.0 / k:.5f},0.01" for k in K]
    (tmp_path / "data.csv").write_text("\n".join([head, *rows]), "utf-8")
    case = read_case("table-4.3", case_tables(), ["friction.mu=0.2"])
    problem = prepare(case, data=str(tmp_path / "data.csv"), free=f"{LIMIT},{MU}")
    lines = rendered(answer(problem, Run()).tables(), 80).splitlines()
    place = next(n for n, line in enumerate(lines) if "correlation" in line and "goes" in line)
    assert lines[place + 1].split() == [LIMIT, MU, "-1.000"]
    apart = solved(tmp_path, monkeypatch, TRUE, free=LIMIT)
    assert "goes with" not in rendered(apart.tables(), 80)


def test_what_has_not_settled_is_no_prediction_and_its_row_is_named(tmp_path, monkeypatch):
    def of_a_curve(model):
        k = model.peak_velocity / model.slider.drive_velocity
        why = {True: "", False: "the body is still being taken up"}
        settled = k < 1.9
        ratio = curve(k, model.friction.max_deflection, 0.2)
        return SimpleNamespace(settled=settled, settled_by=why[settled], ratio=ratio, notes=())

    monkeypatch.setattr(forward, "solve_many", lambda models, **_: [*map(of_a_curve, models)])
    rows = ["1.3,0.9,0.01", "1.6,0.8,0.01", "2,0.6,0.01"]
    (tmp_path / "data.csv").write_text("\n".join([f"{AMPLITUDE},ratio,sd", *rows]), "utf-8")
    case = read_case("table-4.3", case_tables())
    result = answer(prepare(case, data=str(tmp_path / "data.csv"), free=LIMIT), Run())
    assert result.points == 2
    assert "the 3rd measurement (row 4) has no answer and is left out" in said(result)
    assert "still being taken up" in said(result)
    (tmp_path / "data.csv").write_text("\n".join([f"{AMPLITUDE},ratio,sd", rows[2]]), "utf-8")
    problem = prepare(case, data=str(tmp_path / "data.csv"), free=LIMIT)
    with pytest.raises(ConvergenceError, match=r"answers 0 of 1 measurements.*has not settled"):
        answer(problem, Run())


def test_a_table_without_deviations_and_without_residuals_is_refused(tmp_path, monkeypatch):
    with pytest.raises(InputError, match="no column sd, and 2 measurements for 2 free"):
        solved(tmp_path, monkeypatch, TRUE[:2], sd=None)


def test_a_long_reason_stands_below_the_table_and_its_value_in_the_table_s_unit(
    tmp_path, monkeypatch
):
    class Short(Smooth):
        def __call__(self, conditions, given):
            if given[LIMIT] > 75e-9:
                why = "the model has not settled there: the state is one of many: " + 9 * "and on "
                return np.full(len(conditions), math.nan), {0: why.strip()}
            return super().__call__(conditions, given)

    monkeypatch.setattr(study, "Predictor", lambda *_: Short())
    rows = [f"{k},{v:.6g},0.2" for k, v in zip(K, TRUE, strict=True)]
    (tmp_path / "data.csv").write_text("\n".join([f"{AMPLITUDE},ratio,sd", *rows]), "utf-8")
    settings = ["friction.mu=0.21", "friction.max_deflection=0.07 um"]
    case = read_case("table-4.3", case_tables(), settings)
    result = answer(prepare(case, data=str(tmp_path / "data.csv"), free=LIMIT), Run())
    assert max(map(len, rendered(result.tables(), 79).splitlines())) <= 79
    lines = rendered(result.tables(), 120).splitlines()
    place = next(n for n, line in enumerate(lines) if line.startswith(LIMIT))
    shown = lines[place]
    assert "the model answers no further than 0.07" in shown
    assert shown.endswith(" um")
    assert f"- {LIMIT}: the model has not settled there" in "\n".join(lines[place:])
    (one,) = result.parameters
    assert "one of many" in one.why


def test_what_a_fit_would_be_without_a_row_is_told_in_the_unit_of_the_table(tmp_path, monkeypatch):
    values = TRUE.copy()
    values[4] += 0.25
    settings = ["friction.max_deflection=0.08 um"]
    result = solved(tmp_path, monkeypatch, values, free=LIMIT, settings=settings)
    assert result.parameters[0].written == "um"
    assert "max_deflection 0.0" in said(result)
    assert " nm" not in said(result)
