"""The tables of BS 721: what a user's file may replace, and what is said where they end."""

import numpy as np
import pytest

from asperity.errors import InputError
from asperity.rating import bs721

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
    own = bs721.read_tables(write(OWN))
    assert bs721.strength_speed_factor(1000.5, tables=own) == pytest.approx(0.4)
    assert bs721.wear_speed_factor(1.0, 100.0, tables=own) == bs721.wear_speed_factor(1.0, 100.0)
    assert own.sources["strength_speed_factor"].confidence == "one source"
    assert own.sources["zone_factor"].confidence == "from memory"
    assert bs721.read_tables().strength_speed_factor(60.0) == 0.45


def test_own_rows_of_the_zone_factor_bring_other_starts(write):
    own = bs721.read_tables(
        write(
            '[zone_factor]\nsource = "own"\nconfidence = "one source"\n'
            "diameter_factor = [8, 10]\nstarts = { 2 = [1.1, 1.2], 6 = [1.3, 1.4] }\n"
        )
    )
    width = 2.0 * 10.0**0.5
    assert bs721.zone_factor(6, 9.0, width, 1.0, tables=own) == pytest.approx(1.35)
    with pytest.raises(InputError, match="rows for 2, 6 starts"):
        bs721.zone_factor(4, 9.0, width, 1.0, tables=own)


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (
            lambda: bs721.wear_speed_factor(31.0, 100.0),
            "sliding_velocity is 31 m/s; it must be from 0 to 30",
        ),
        (lambda: bs721.wear_speed_factor(1.0, 0.1), "speed is 0.1 rpm; it must be from 0.5 to 600"),
        (
            lambda: bs721.strength_speed_factor(1440.0),
            "speed is 1440 rpm; it must be from 1 to 1200",
        ),
        (
            lambda: bs721.zone_factor(4, 5.0, 10.0, 2.0),
            "diameter_factor is 5; it must be from 6 to 20",
        ),
        (
            lambda: bs721.zone_factor(5, 8.0, 10.0, 2.0),
            "starts is 5; .* rows for 1, 2, 3, 4 starts",
        ),
    ],
)
def test_end_of_a_table_is_a_named_error(call, words):
    with pytest.raises(bs721.TableRangeError, match=words):
        call()


def test_start_between_rows_is_refused():
    with pytest.raises(InputError, match="rows for 1, 2, 3, 4 starts"):
        bs721.zone_factor(1.5, 8.0, 10.0, 2.0)


def test_end_of_a_table_is_masked_in_arrays():
    result = bs721.strength_speed_factor([60.0, 1440.0], on_invalid="mask")
    assert result.values[0] == 0.45
    assert result.reason[0] == 0
    assert "from 1 to 1200 rpm" in result.legend[result.reason[1]]


def given(**replaced):
    case = {
        "starts": 4,
        "diameter_factor": [8.2, 5.0, 8.2],
        "axial_module": 2.2,
        "lead_angle": 0.45,
        "wheel_diameter": 132.0,
        "worm_tip_diameter": 22.4,
        "face_width": 13.0,
        "sliding_velocity": 1.5,
        "worm_speed": [1440.0, 600.0, 600.0],
        "wheel_speed": [96.0, 40.0, 40.0],
        "wheel_material": "phosphor bronze centrifugal",
        "worm_material": "case-hardened C steel",
        "on_invalid": "mask",
    }
    return {**case, **replaced}


def test_variant_the_tables_do_not_cover_is_masked_and_the_worm_left_out_where_it_is_too_fast():
    rated = bs721.permissible_torques(**given())
    m_26k = rated.m_26k
    assert list(rated.wear.reason > 0) == [False, True, False]
    assert list(rated.wear.worm > 0.0) == [False, False, True]
    assert "everywhere" in rated.wear.note
    assert m_26k[0] == min(rated.wear.wheel[0], rated.strength.wheel[0])
    assert np.isnan(m_26k[1])
    assert m_26k[2] == min(
        rated.wear.wheel[2], rated.wear.worm[2], rated.strength.wheel[2], rated.strength.worm[2]
    )
    assert rated.m_w(100.0).shape == rated.m_s(10.0).shape == (3,)


def test_variant_masked_for_strength_alone_has_no_smallest_torque():
    rated = bs721.permissible_torques(
        **given(diameter_factor=8.2, worm_speed=600.0, wheel_speed=[0.7, 40.0])
    )
    assert np.all(rated.wear.wheel > 0.0)
    assert list(rated.strength.reason > 0) == [True, False]
    assert list(np.isnan(rated.m_26k)) == [True, False]


def test_arrays_raise_unless_masked():
    with pytest.raises(bs721.TableRangeError, match="diameter_factor is 5"):
        bs721.permissible_torques(**given(on_invalid="raise"))


@pytest.mark.parametrize(
    ("replaced", "words"),
    [
        ({"worm_speed": -1.0}, "worm_speed is -1 rpm; it must be positive"),
        ({"worm_speed": float("nan")}, "worm_speed is nan rpm"),
        (
            {"wheel_material": "phosphor bronze centrifugl"},
            "did you mean 'phosphor bronze centrifugal'",
        ),
        ({"wheel_material": "aluminium"}, "has no row for 'aluminium'"),
        ({"worm_material": "0.5C steel"}, "did you mean '0.55C steel'"),
        ({"face_width": 50.0, "axial_module": 8.0}, "tip diameter"),
    ],
)
def test_what_cannot_be_rated_is_refused(replaced, words):
    scalars = {"diameter_factor": 8.2, "worm_speed": 600.0, "wheel_speed": 40.0}
    with pytest.raises(InputError, match=words):
        bs721.permissible_torques(**given(**{**scalars, "on_invalid": "raise", **replaced}))


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
        bs721.read_tables(write(text))
    assert "\n" not in str(caught.value)


def test_missing_file_of_tables_is_refused(tmp_path):
    with pytest.raises(InputError, match="cannot be read: no such file"):
        bs721.read_tables(tmp_path / "none.toml")
