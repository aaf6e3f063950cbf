"""The regime of lubrication by the film over the roughness of both flanks."""

import math

import pytest

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.files.shipped import shipped_cases
from asperity.rating.rate import rate_case
from asperity.rating.regime import Film


def test_lambda_is_the_film_over_the_root_mean_square_of_both_flanks():
    # Of normally distributed heights Ra is sqrt(2/pi) of Rq.
    rq = 0.4 / math.sqrt(2.0 / math.pi)
    assert Film(0.9, 0.4).ratio == pytest.approx(0.9 / math.hypot(rq, rq), rel=1e-14)


@pytest.mark.parametrize(
    ("ratio", "regime"),
    [(0.999, "boundary"), (1.001, "mixed"), (2.999, "mixed"), (3.001, "full film")],
)
def test_regimes_part_at_1_and_3(ratio, regime):
    film = Film(ratio / Film(1.0, 0.4).ratio, 0.4)
    assert film.regime == regime
    assert regime in film.sentence()


def test_a_verdict_tells_the_film_of_the_rating():
    assert "gearset-3" in shipped_cases()
    rated = rate_case(read_case("gearset-3", case_tables()))
    film = rated.verdict.film
    assert film == Film(rated.iso14521["h_min_um"], 1.6)
    assert film.sentence() in rated.brief()
    alone = rate_case(read_case("gearset-3", case_tables()), ("bs721",))
    assert alone.verdict.film is None
