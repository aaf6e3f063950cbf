"""What studies of gearsets show fits a terminal of eighty characters."""

import math
import random

import pytest
from apparatus.any_gearset import gearset, written

LOTS = [0, *(pytest.param(n, marks=(pytest.mark.slow, pytest.mark.campaign)) for n in range(1, 20))]
BEST = [pytest.param(n, marks=(pytest.mark.slow, pytest.mark.campaign)) for n in range(10)]


@pytest.fixture
def screen(asperity, environment):
    """Run the command line as a terminal of the usual width shows it."""
    return lambda *given, **more: asperity(*given, **more, env={**environment, "COLUMNS": "79"})


def longest(shown):
    return max(map(len, shown.splitlines()))


@pytest.mark.parametrize("lot", LOTS)
def test_gearsets_that_are_proposed_fit_in_79_characters(screen, lot):
    rng = random.Random(lot)
    given = (
        "--ratio", f"{math.exp(rng.uniform(math.log(5), math.log(90))):.3g}",
        "--output-torque", f"{math.exp(rng.uniform(2, 8)):.3g} N m",
        "--worm-speed", f"{math.exp(rng.uniform(5, 8)):.4g} rpm",
    )  # fmt: skip
    rank = rng.choice(["size", "efficiency", "margin"])
    code, shown, errors = screen("size", *given, "--uncut", "--rank", rank)
    assert code in (0, 2, 3), errors
    if code == 0:
        assert "margin" in shown
        assert longest(shown) <= 79, given


@pytest.mark.slow
def test_a_proposal_with_the_longest_names_fits_in_79_characters(screen):
    given = "--ratio", "60", "--output-torque", "300 N m", "--worm-speed", "1500 rpm", "--uncut"
    code, shown, _ = screen("size", *given)
    assert code == 0
    assert "ISO/TR" in shown
    assert longest(shown) <= 79


@pytest.mark.slow
def test_an_optimum_that_locks_by_some_fits_in_79_characters(screen):
    code, shown, _ = screen("optimise", "actuator-duty", "--set", "requirements.self_locking=any")
    assert code == 0
    assert "by BS and AGMA" in shown
    assert longest(shown) <= 79


@pytest.mark.parametrize("lot", BEST)
def test_an_optimum_of_any_gearset_fits_in_79_characters(screen, tmp_path, lot):
    for seed in range(5 * lot, 5 * lot + 5):
        path = tmp_path / "own.toml"
        path.write_text(written(gearset(seed)))
        code, shown, errors = screen("optimise", path.name, cwd=tmp_path)
        assert code in (0, 2, 3), (seed, errors)
        if shown:
            assert longest(shown) <= 79, seed
