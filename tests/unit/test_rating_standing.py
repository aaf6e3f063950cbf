"""What standards come to: short on the terminal, whole in the report."""

from types import SimpleNamespace

import pytest

import asperity
from asperity.gearset import oil
from asperity.rating.changes import changed_words, says_less
from asperity.rating.iso14521.limits import PLAUSIBLE, VALIDITY, implausible
from asperity.rating.power_words import power_lines
from asperity.rating.standing import WIDTH, Standing, efficiency_outside

WHY = (
    "h* is -0.00541; it must be above 0. m_x1 = 0.9891 mm drives it (with x_2 = -2.48e-06); any "
    "one of these, x_2 following, brings it back: m_x1 of 1.2 mm, z_2 of 80"
)
NONE = [Standing("iso14521", "no answer", reasons=(WHY,))]


def test_a_long_reason_ends_where_a_part_of_it_ends():
    _, told = Standing.sentences(NONE)
    assert told.endswith("(with x_2 = -2.48e-06) ...")
    assert len(told) <= 2 * WIDTH


def test_a_reason_that_fits_and_one_without_parts_stay_as_they_were():
    short = [Standing("bs721", "no answer", reasons=("the table goes no further",))]
    assert [*Standing.sentences(short)][1] == "BS 721: the table goes no further"
    endless = [Standing("bs721", "no answer", reasons=("on " * 80,))]
    assert [*Standing.sentences(endless)][1].endswith("on on ...")


def test_the_report_has_the_whole_reason():
    _, told = Standing.sentences(NONE, whole=True)
    assert told == f"ISO/TR 14521: {WHY}"


LIMITS = {**VALIDITY, **PLAUSIBLE}
OF_EFFICIENCY = {
    "centre_distance", "profile_shift", "geometry_factor", "idle_share", "theta_S_degC",
}  # fmt: skip
"""Limits of what friction, or what is lost without load, rests on."""


@pytest.mark.parametrize("key", LIMITS)
def test_an_efficiency_is_marked_by_what_it_rests_on_alone(key):
    assert set(LIMITS) >= OF_EFFICIENCY
    sentence = LIMITS[key].violation(2.0 * LIMITS[key].upper + 1.0)
    marked = efficiency_outside(SimpleNamespace(violations=(sentence,)))
    assert len(marked) == (key in OF_EFFICIENCY)


def powers(setting):
    rated = asperity.rate("gearset-3", standard="iso14521", settings=[setting])
    return rated.iso14521, " ".join(map(str, power_lines(rated.rating_inputs, rated.iso14521)))


def test_an_oil_hotter_than_its_range_marks_the_efficiency():
    assert "of the teeth (OUTSIDE ITS RANGE)" in powers("operation.output_torque=1e12 N m")[1]
    for of_oil in (oil.TEMPERATURE, oil.VISCOSITY):
        sentence = of_oil.violation(2.0 * of_oil.upper + 1.0)
        assert efficiency_outside(SimpleNamespace(violations=(sentence,)))


def test_a_gearbox_that_comes_out_above_its_teeth_says_why():
    for setting, above in (("worm_speed=1e-9 rpm", True), ("worm_speed=1500 rpm", False)):
        iso, said = powers(f"operation.{setting}")
        assert (iso["eta_ges"] > iso["eta_z1_2"]) == above
        assert ("comes out above its teeth: the standard's loss has 0.1" in said) == above


ORDER = "does not hold", "no answer", "undecided", "holds"


@pytest.mark.parametrize("before", ORDER)
@pytest.mark.parametrize("after", ORDER)
def test_a_standard_says_less_of_another_part_where_its_word_is_worth_less(before, after):
    def rated(**words):
        standing = [SimpleNamespace(standard=name, word=word) for name, word in words.items()]
        return SimpleNamespace(verdict=SimpleNamespace(standing=standing))

    one, other = rated(bs721=before, agma6034="holds"), rated(bs721=after, agma6034="holds")
    assert says_less(one, other) == (ORDER.index(after) < ORDER.index(before))
    # What one standard gains makes up for nothing.
    lost = rated(bs721="holds", agma6034="no answer")
    assert says_less(one, lost)
    # A standard that was not asked says neither.
    assert not says_less(rated(agma6034="holds"), rated(agma6034="holds", bs721=after))


@pytest.mark.parametrize(("idle", "said"), [(0.0, 0), (99.0, 0), (101.0, 1)])
def test_more_lost_without_load_than_is_delivered_is_implausible(idle, said):
    sound = {key: 0.5 * (one.lower + one.upper) for key, one in PLAUSIBLE.items()}
    losses = {"loss_idle_W": 0.9 * idle, "loss_seal_W": 0.1 * idle, "output_power_W": 100.0}
    assert len(implausible({**sound, **losses})) == said


def test_what_another_part_no_longer_holds_against_is_said_where_the_verdict_was_that_already():
    def rated(word, **margins):
        safeties = [
            SimpleNamespace(
                demand=SimpleNamespace(standard="iso14521", key=name, name=name),
                holds=margin >= 1.0,
            )
            for name, margin in margins.items()
        ]
        standing = [SimpleNamespace(standard="iso14521", word=word, unrated=())]
        verdict = SimpleNamespace(standing=standing, safeties=safeties)
        return SimpleNamespace(verdict=verdict, self_locking=())

    fails = "does not hold"
    before = rated(fails, wear=0.5, pitting=1.1, root=0.9)
    (said,) = changed_words(before, rated(fails, wear=2.0, pitting=0.7, root=0.8))
    assert said == "ISO/TR 14521: no longer holds against pitting"
    assert not changed_words(before, rated(fails, wear=0.4, pitting=1.0, root=2.0))
    (said,) = changed_words(rated("holds", wear=1.5), rated(fails, wear=0.5))
    assert said == "ISO/TR 14521: holds -> does not hold"
