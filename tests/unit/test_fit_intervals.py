"""Intervals of a fit end where the profile of chi-square does, which the tests know on paper."""

import math

import numpy as np
import pytest
from apparatus.stribeck import (
    DAMPING,
    DEVIATION,
    FORCES,
    KEYS,
    MU,
    SPEED,
    SPEEDS,
    START,
    STATIC,
    STRIBECK,
    Exact,
    Paper,
    forces,
)  # fmt: skip

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.errors import ConvergenceError
from asperity.runs import Run
from asperity.tribometer.fit import study
from asperity.tribometer.fit.estimate import RISE, WIDEST, Fit
from asperity.tribometer.fit.study import answer, prepare

# Where chi-square, all others refitted, is 3.84 above its least: SciPy, by Brent's method.
ENDS = {
    MU: (0.973668, 1.030293), STATIC: (1.460865, 1.520060), SPEED: (0.921597e-3, 1.138106e-3),
    DAMPING: (None, 0.884270),
}  # fmt: skip


def problem(folder, **options):
    (folder / "stribeck.toml").write_text(STRIBECK, "utf-8")
    rows = [f"{v},{force},{DEVIATION}" for v, force in zip(SPEEDS, FORCES, strict=True)]
    head = "slider.drive_velocity [mm/s],force [N],sd"
    (folder / "stribeck.csv").write_text("\n".join([head, *rows]), "utf-8")
    case = read_case(str(folder / "stribeck.toml"), case_tables())
    return prepare(case, data=str(folder / "stribeck.csv"), free=",".join(KEYS), **options)


def rises_by_3_84(exact, place, value):
    """Whether a value is the end of an interval, to 2 % of its way from the best."""
    best = exact.best[place]
    way = math.log(value) - best
    inner, outer = (exact.profile(place, math.exp(best + part * way)) for part in (0.98, 1.02))
    return inner < RISE < outer


@pytest.mark.slow
def test_the_ends_that_are_expected_are_those_of_the_exact_profile():
    exact = Exact(1e-3 * SPEEDS, FORCES, np.full(8, DEVIATION), START)
    for place, key in enumerate(KEYS):
        for value in ENDS[key]:
            if value is None:
                assert exact.profile(place, math.exp(exact.best[place] - WIDEST)) < RISE
            else:
                assert rises_by_3_84(exact, place, value)


def meets(result):
    for one in result.parameters:
        for found, expected in zip(one.ends, ENDS[one.key], strict=True):
            if expected is None:
                assert found is None
            else:
                assert found == pytest.approx(expected, rel=2e-3)


@pytest.mark.slow
def test_four_parameters_of_steady_sliding_have_the_intervals_of_the_exact_profile(
    tmp_path, monkeypatch
):
    monkeypatch.setattr(study, "Predictor", lambda *_: Paper())
    meets(answer(problem(tmp_path), Run()))


@pytest.mark.slow
def test_four_parameters_of_steady_sliding_are_fitted_by_the_model_itself(tmp_path):
    result = answer(problem(tmp_path), Run())
    assert result.marched == 0
    assert result.points == 8
    meets(result)


def random_set(seed):
    """Steady sliding under a random law at random speeds, with noise; bodies of 1 N."""
    rng = np.random.default_rng(seed)
    mu = rng.uniform(0.05, 1.0)
    static, speed = mu * rng.uniform(1.1, 2.0), 10.0 ** rng.uniform(-4.0, -2.0)
    damping = 10.0 ** rng.uniform(-1.0, 1.5) * mu * 0.1 / (30.0 * speed)
    count = rng.integers(6, 20)
    ends = speed * 10.0 ** rng.uniform(-2.0, -0.6), speed * 10.0 ** rng.uniform(0.8, 2.0)
    speeds = np.geomspace(*ends, count)
    sd = mu * 10.0 ** rng.uniform(-2.5, -1.2)
    measured = forces(speeds, mu, static, speed, damping) + sd * rng.normal(size=count)
    exact = Exact(speeds, measured, np.full(count, sd), (mu, static, speed, damping))
    return exact, np.log([0.9 * mu, 1.1 * static, 1.3 * speed, 0.7 * damping])


def wrong_ends(seed):
    """Return how many ends of a random set are not those of the exact profile."""
    exact, start = random_set(seed)

    def forward(point):
        if point[1] < point[0]:
            raise ConvergenceError("static friction below kinetic")
        return exact.residuals(point)

    fit = Fit(forward, start - 2.0 * WIDEST, start + 2.0 * WIDEST)
    best = fit.least(start)
    assert best.chi2 == pytest.approx(exact.chi2, abs=0.01)
    wrong = 0
    for place in range(4):
        for side in (-1, 1):
            end = fit.end(best, place, side)
            if end is not None:
                wrong += not rises_by_3_84(exact, place, math.exp(end))
            else:
                known = best.point[place] + side * WIDEST
                reached, _ = fit.walls.get((place, side), (known, ""))
                wrong += exact.profile(place, math.exp(reached)) > RISE
    return wrong


@pytest.mark.slow
@pytest.mark.parametrize("seed", [2, 7, 46, 80])
def test_ends_that_were_wrong_are_those_of_the_exact_profile(seed):
    # With a damping that says nothing on the way, and a saddle: what is carried along stops there.
    assert wrong_ends(seed) == 0


@pytest.mark.slow
@pytest.mark.campaign(tried_by="test_ends_that_were_wrong_are_those_of_the_exact_profile")
def test_of_random_sets_hardly_an_end_is_another_than_the_exact_one():
    wrong = [wrong_ends(seed) for seed in range(1000, 1100)]
    assert sum(wrong) <= 0.005 * 8 * len(wrong)


def test_where_a_model_answers_no_more_an_end_is_open_and_says_so(tmp_path, monkeypatch):
    class Short(Paper):
        def __call__(self, conditions, given):
            if given[MU] > 1.01:
                return np.full(len(conditions), math.nan), {0: "no answer beyond"}
            return super().__call__(conditions, given)

    monkeypatch.setattr(study, "Predictor", lambda *_: Short())
    one = {one.key: one for one in answer(problem(tmp_path), Run()).parameters}[MU]
    assert one.ends[1] is None
    assert one.ends[0] == pytest.approx(ENDS[MU][0], rel=2e-3)
    assert not one.identifiable
    assert one.why.startswith("the model answers no further than 1.0")
    assert "no answer beyond" in one.why
