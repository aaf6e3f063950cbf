"""The tables of BS 721: what a user's file may replace, and what is said where they end."""

import numpy as np
import pytest

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.errors import InputError
from asperity.gearset import Gearset
from asperity.rating import Operation, RatingOptions, bs721, rate_case, variants
from asperity.rating.inputs import RPM

OWN = """
[strength_speed_factor]
source = "BS 721-2:1983, figure 8"
confidence = "one source"
x = [1, 2000]
y = [0.6, 0.2]
"""


@pytest.fixture
def write(tmp_path):
    def write(text):
        path = tmp_path / "own.toml"
        path.write_text(text, encoding="utf-8")
        return path

    return write


def test_own_file_replaces_the_tables_it_holds_and_no_others(write):
    own = bs721.tables.read_tables(write(OWN))
    assert bs721.torque.strength_speed_factor(1000.5, tables=own) == pytest.approx(0.4)
    assert bs721.torque.wear_speed_factor(1.0, 100.0, tables=own) == bs721.torque.wear_speed_factor(
        1.0, 100.0
    )
    assert own.sources["strength_speed_factor"].confidence == "one source"
    assert own.sources["zone_factor"].confidence == "from memory"
    assert bs721.torque.strength_speed_factor(60.0) == 0.45


def test_own_rows_of_the_zone_factor_bring_other_starts(write):
    own = bs721.tables.read_tables(
        write(
            '[zone_factor]\nsource = "own"\nconfidence = "one source"\n'
            "diameter_factor = [8, 10]\nstarts = { 2 = [1.1, 1.2], 6 = [1.3, 1.4] }\n"
        )
    )
    width = 2.0 * 10.0**0.5
    assert bs721.torque.zone_factor(6, 9.0, width, 1.0, tables=own) == pytest.approx(1.35)
    with pytest.raises(InputError, match="rows for 2, 6 starts"):
        bs721.torque.zone_factor(4, 9.0, width, 1.0, tables=own)


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (
            lambda: bs721.torque.wear_speed_factor(31.0, 100.0),
            "sliding_velocity is 31 m/s; it must be from 0 to 30",
        ),
        (
            lambda: bs721.torque.wear_speed_factor(1.0, 0.1),
            "wheel_speed is 0.1 rpm; it must be from 0.5 to 600",
        ),
        (
            lambda: bs721.torque.strength_speed_factor(1440.0),
            "wheel_speed is 1440 rpm; it must be from 1 to 1200",
        ),
        (
            lambda: bs721.torque.zone_factor(4, 5.0, 10.0, 2.0),
            "diameter_factor is 5; it must be from 6 to 20",
        ),
        (
            lambda: bs721.torque.zone_factor(5, 8.0, 10.0, 2.0),
            "starts is 5; .* rows for 1, 2, 3, 4 starts",
        ),
    ],
)
def test_end_of_a_table_is_a_named_error(call, words):
    with pytest.raises(bs721.tables.TableRangeError, match=words):
        call()


def test_start_between_rows_is_refused():
    with pytest.raises(InputError, match="rows for 1, 2, 3, 4 starts"):
        bs721.torque.zone_factor(1.5, 8.0, 10.0, 2.0)


def test_end_of_a_table_is_masked_in_arrays():
    result = bs721.torque.strength_speed_factor([60.0, 1440.0], on_invalid="mask")
    assert result.values[0] == 0.45
    assert result.reason[0] == 0
    assert "from 1 to 1200 rpm" in result.legend[result.reason[1]]


# Mean and spread of the numbers; mean of them and of their places, each as often as it is far on.
SUMS = {
    "zone_factor": (1.25498, 0.215412, 8.38967672),
    "sliding_speed_factor": (0.524, 0.238084, 6.30909524),
    "rotation_speed_factor": (0.6766, 0.224819, 133.877633),
    "strength_speed_factor": (0.45875, 0.108102, 185.320441),
    "friction": (0.0586, 0.0405854, 3.8556043),
    "bending_stress_factor": (106, 78.7337, 126.583333),
    "surface_stress_factor": (7.175, 3.14593, 7.63161765),
    "worm_surface_stress_factor": (18.1875, 15.6409, 19.5823529),
}


@pytest.mark.parametrize("name", SUMS)
def test_no_number_of_a_table_is_another_than_it_was(name):
    # Most of them are from memory: no document tells which is wrong, so that mean and spread do,
    # and of two that are exchanged the mean in their order.
    table = getattr(bs721.tables.read_tables(), name)
    places = np.empty(0)
    if isinstance(table, bs721.tables.ZoneFactor):
        places = np.concatenate([row.x for row in table.rows.values()])
        numbers = np.concatenate([row.y for row in table.rows.values()])
    elif isinstance(table, bs721.tables.Curve):
        places, numbers = table.x, table.y
    else:
        rows = sorted(table.values.items())
        numbers = np.array([v for _, row in rows for _, v in sorted(row.items())])
    both = np.concatenate([numbers, places])
    in_order = np.average(both, weights=np.arange(1.0, both.size + 1.0))
    mean, spread, order = SUMS[name]
    assert (numbers.mean(), numbers.std()) == pytest.approx((mean, spread), rel=1e-5)
    assert in_order == pytest.approx(order, rel=1e-8)


def test_factors_of_speed_and_friction_fall_and_that_of_the_zone_rises():
    tables = bs721.tables.read_tables()
    for name in ("sliding_speed_factor", "rotation_speed_factor", "strength_speed_factor"):
        assert np.all(np.diff(getattr(tables, name).y) < 0.0)
    assert np.all(np.diff(tables.friction.y) < 0.0)
    for row in tables.zone_factor.rows.values():
        assert np.all(np.diff(row.y) > 0.0)


WEAK = ("gearset.worm_material=0.4C steel",)


def varied(*settings, **values):
    case = read_case("gearset-3", case_tables(), settings)
    tables = [case.require(table) for table in (Gearset, Operation, RatingOptions)]
    return variants(*tables, ("bs721",), **values)


def test_variant_the_tables_do_not_cover_is_masked_and_the_worm_left_out_where_it_is_too_fast():
    speeds = np.array([1440.0, 600.0, 600.0]) / RPM
    found = varied(diameter_factor=[8.2, 5.0, 8.2], worm_speed=speeds)
    assert list(found.reason("bs721") > 0) == [False, True, False]
    assert "diameter_factor is not allowed" in found.legend("bs721")[found.reason("bs721")[1]]
    m_26k = found["bs721.M_26k_Nm"]
    wheel = np.minimum(found["bs721.M_c_wheel_Nm"], found["bs721.M_b_wheel_Nm"])
    assert m_26k[0] == wheel[0]
    assert np.isnan(m_26k[1])
    # The hardened worm bears more than the wheel.
    assert m_26k[2] == wheel[2]


def test_a_weak_worm_limits_only_the_variants_at_speeds_its_tables_have():
    found = varied(*WEAK, worm_speed=np.array([1440.0, 600.0]) / RPM)
    lower = found["bs721.M_26k_Nm"] < found["bs721.M_c_wheel_Nm"]
    assert list(lower) == [False, True]
    slow = read_case("gearset-3", case_tables(), [*WEAK, "operation.worm_speed=600 rpm"])
    alone = rate_case(slow, ("bs721",)).bs721
    assert found["bs721.M_26k_Nm"][1] == pytest.approx(alone["M_c_worm_Nm"], rel=1e-13)


def test_variant_masked_for_strength_alone_has_no_smallest_torque():
    # The wheel turns at 0.7 rpm, where the speed factor for strength ends at 1 rpm.
    found = varied(worm_speed=np.array([10.5, 600.0]) / RPM)
    assert np.all(found["bs721.M_c_wheel_Nm"] > 0.0)
    assert list(np.isnan(found["bs721.M_b_wheel_Nm"])) == [True, False]
    assert list(np.isnan(found["bs721.M_26k_Nm"])) == [True, False]


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (
            lambda t: t.surface_stress_factor("phosphor bronze centrifugl", "0.4C steel"),
            "did you mean 'phosphor bronze centrifugal'",
        ),
        (lambda t: t.bending_stress_factor("wheel", "aluminium"), "nothing for 'wheel' with"),
        (lambda t: t.surface_stress_factor("aluminium", "0.4C steel"), "no row for 'aluminium'"),
        (lambda t: t.bending_stress_factor("worm", "0.5C steel"), "did you mean '0.55C steel'"),
        (lambda t: bs721.torque.root_arc(50.0, 22.4, 8.0, 8.2, 0.45), "tip diameter"),
        (
            lambda t: bs721.torque.wear_speed_factor(1.0, -1.0),
            "speed is -1 rpm; it must be positive",
        ),
        (lambda t: bs721.torque.wear_speed_factor(1.0, float("nan")), "speed is nan rpm"),
    ],
)
def test_what_cannot_be_rated_is_refused(call, words):
    with pytest.raises(InputError, match=words):
        call(bs721.tables.read_tables())


HEAD = 'source = "own"\nconfidence = "one source"\n'


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("x = [", "own.toml: not valid TOML"),
        (
            "[friktion]\n" + HEAD,
            r"\[friktion\] is not a table of BS 721 \(did you mean 'friction'\?\)",
        ),
        ("friction = 3", r"\[friction\]: it must be a table"),
        ("[friction]\nx = [0, 1]\ny = [1, 2]", "the source has no name"),
        ('[friction]\nsource = "own"\nconfidence = "sure"\nx = [0, 1]\ny = [1, 2]', "'sure'"),
        ("[friction]\n" + HEAD + "x = [0, 1]", "y is missing"),
        ("[friction]\n" + HEAD + "x = [0, 1]\ny = [1, 2]\nz = 3", "z is not a key"),
        ("[friction]\n" + HEAD + "x = [0, 1]\ny = [1]", "all of the same length"),
        ("[friction]\n" + HEAD + "x = [0, 1]\ny = [1, nan]", "lists of numbers"),
        ("[friction]\n" + HEAD + "x = [1, 0]\ny = [1, 2]", "must increase"),
        ("[friction]\n" + HEAD + "x = [0, 1]\ny = [0, 2]", "must be positive"),
        ("[friction]\n" + HEAD + "hold_above = 1\nx = [0, 1]\ny = [1, 2]", "true or false"),
        ("[zone_factor]\n" + HEAD + "diameter_factor = [6, 7]\nstarts = {}", "rows by the number"),
        ("[surface_stress_factor]\n" + HEAD + "wheel = { a = 3 }", "a table for each material"),
        ("[surface_stress_factor]\n" + HEAD + "wheel = { a = { b = -3 } }", "a, b is -3"),
        ("[bending_stress_factor]\n" + HEAD + "wheel = { a = 3 }", "worm is missing"),
    ],
)
def test_wrong_file_of_tables_is_refused_in_one_line(write, text, words):
    with pytest.raises(InputError, match=words) as caught:
        bs721.tables.read_tables(write(text))
    assert "\n" not in str(caught.value)


def test_missing_file_of_tables_is_refused(tmp_path):
    with pytest.raises(InputError, match="cannot be read: no such file"):
        bs721.tables.read_tables(tmp_path / "none.toml")
