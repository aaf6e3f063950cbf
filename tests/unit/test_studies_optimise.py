"""The most efficient design, what holds it back, and what a higher torque costs."""

import dataclasses
import json
import math
import threading
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.errors import InputError
from asperity.files.store import read_dataset, write_dataset
from asperity.gearset import Gearset
from asperity.rating import Operation, RatingOptions, rate_case
from asperity.studies import stepwise
from asperity.studies.climb import climb, spread
from asperity.studies.design import LEAST_THREADS, VARIABLES, Bounds, Space
from asperity.studies.optimise import optimise
from asperity.studies.tradeoff import trade_off


def subject(case):
    return case.require(Gearset), case.require(Operation), case.require(RatingOptions)


def gearset(name="gearset-2", *settings):
    return subject(read_case(name, case_tables(), settings))


@pytest.fixture(scope="module", params=["gearset-2", "gearset-3"])
def name(request):
    return request.param


@pytest.fixture(scope="module")
def best(name):
    return optimise(*gearset(name))


@pytest.fixture(scope="module")
def curve(name):
    return trade_off(*gearset(name))


def samples(name, *settings):
    """Many designs within the bounds, with the corners of the cube among them."""
    space = Space(*gearset(name, *settings))
    inner = spread(len(VARIABLES), 2**14)
    pushed = np.where(inner > 0.95, 1.0, np.where(inner < 0.05, 0.0, inner))
    smooth = inner * [0.0, 1.0, 1.0, 0.0] + [1.0, 0.0, 0.0, 0.0]
    points = np.vstack([inner, pushed, smooth])
    found = space.numbers(points)
    low, high = space.profile_shift
    inside = (found["profile_shift"] >= low) & (found["profile_shift"] <= high)
    return {key: values[inside] for key, values in found.items()}


@pytest.mark.ordinary(1)
def test_no_design_of_many_that_keeps_the_load_capacity_is_better(name, best):
    found = samples(name)
    kept = np.ones(len(found["h_star"]), dtype=bool)
    for key in ("M_w_Nm", "M_s_Nm"):
        kept &= found[key] >= best.before.bs721[key]
    assert kept.sum() > 100
    assert best.after.iso14521["eta_z1_2"] > found["eta_z1_2"][kept].max() - 1e-6


def test_the_load_capacity_is_not_lowered(best):
    for key in ("M_w_Nm", "M_s_Nm"):
        assert best.after.bs721[key] >= best.before.bs721[key] * (1.0 - 1e-12)


def test_every_constraint_holds_and_the_active_ones_are_met(best):
    for limit in best.limits:
        gap = limit.value - limit.bound
        assert (gap <= 1e-12) if limit.relation == "<=" else (gap >= -1e-6 * abs(limit.bound))
        if limit.active:
            assert limit.value == pytest.approx(limit.bound, rel=2e-6)
    assert {limit.symbol for limit in best.active} >= {"M_s", "alpha_n", "Ra_1"}


def test_all_starts_agree(best):
    assert best.agreed == best.starts == 10


def test_what_is_not_free_stays(best):
    before, after = best.before.gearset, best.gearset
    for key in ("starts", "wheel_teeth", "hand", "flank", "wheel_material", "name"):
        assert getattr(after, key) == getattr(before, key)
    assert after.geometry.centre_distance == pytest.approx(
        before.geometry.centre_distance, rel=1e-12
    )


@pytest.mark.ordinary(1)
def test_the_same_call_gives_the_same_design(name, best):
    assert optimise(*gearset(name)).gearset == best.gearset


def test_the_settings_turn_the_case_into_the_design(name, best):
    again = rate_case(read_case(name, case_tables(), best.settings))
    for key in ("eta_z1_2", "h_star"):
        assert again.iso14521[key] == pytest.approx(best.after.iso14521[key], rel=1e-9)
    assert again.bs721["M_s_Nm"] == pytest.approx(best.after.bs721["M_s_Nm"], rel=1e-9)


def test_the_settings_also_work_where_the_case_gives_other_numbers(tmp_path):
    file = tmp_path / "own.toml"
    text = (read_case("gearset-2", case_tables()).folder / "gearset-2.toml").read_text("utf-8")
    for old, new in (
        ('centre_distance = "60.17 mm"', "profile_shift = 0.0"),
        ("diameter_factor = 10.8", 'worm_pitch_diameter = "18.36 mm"'),
    ):
        assert old in text
        text = text.replace(old, new)
    file.write_text(text, "utf-8")
    best = optimise(*subject(read_case(file, case_tables())))
    again = rate_case(read_case(file, case_tables(), best.settings))
    assert again.iso14521["eta_z1_2"] == pytest.approx(best.after.iso14521["eta_z1_2"], rel=1e-9)


@pytest.mark.slow
def test_wider_bounds_are_no_worse_and_no_bounds_leave_the_gearset_as_it_is():
    given = gearset()
    free = Bounds(module_change=(-0.1, 0.1))
    assert optimise(*given, bounds=free).gain > optimise(*given).gain
    geometry = given[0].geometry
    fixed = Bounds(
        pressure_angle=(given[0].pressure_angle,) * 2,
        diameter_factor=(geometry.diameter_factor,) * 2,
        module_change=(0.0, 0.0),
        worm_roughness=(given[0].worm_roughness,) * 2,
    )
    assert optimise(*given, bounds=fixed).gain == pytest.approx(0.0, abs=1e-12)


def test_a_gearset_outside_the_bounds_widens_them():
    best = optimise(*gearset("gearset-2", "gearset.worm_roughness=0.4 um"))
    assert best.gearset.worm_roughness == pytest.approx(0.4e-6)
    assert best.gain > 0.0


@pytest.mark.ordinary(1)
def test_assumed_bounds_and_tables_from_memory_are_said(best):
    assert any("bounds are assumed" in note for note in best.notes)
    assert any("from memory" in note for note in best.notes)
    assert not any("assumed" in note for note in optimise(*gearset(), bounds=Bounds()).notes)


def test_json_is_plain_and_names_units(best):
    answer = json.loads(json.dumps(best.to_json(), allow_nan=False))
    assert answer["optimum"]["pressure_angle_deg"] == 30.0
    assert answer["optimum"]["bs721"]["M_s_Nm"] == best.after.bs721["M_s_Nm"]
    assert {"key", "symbol", "relation", "bound", "value", "active"} == set(
        answer["constraints"][0]
    )


def test_bounds_the_wrong_way_round_are_refused():
    with pytest.raises(InputError, match="the bounds of diameter_factor are 12 and 6; give the"):
        Bounds(diameter_factor=(12.0, 6.0))
    with pytest.raises(InputError, match="the bounds of profile_shift are both 0; it follows"):
        Bounds(profile_shift=(0.0, 0.0))


@pytest.mark.slow
def test_a_variable_without_room_stays_and_the_others_are_free():
    given = gearset()
    angle = given[0].pressure_angle
    best = optimise(*given, bounds=Bounds(pressure_angle=(angle, angle)))
    assert best.gearset.pressure_angle == pytest.approx(angle, rel=1e-14)
    assert 0.04 < best.gain < optimise(*given).gain
    assert best.agreed == best.starts


def test_a_gearset_that_a_standard_cannot_rate_is_refused_with_its_reason():
    with pytest.raises(InputError, match=r"^the film parameter h\* is"):
        optimise(*gearset("gearset-2", "gearset.axial_module=2.4 mm"))


@pytest.mark.slow
def test_a_higher_permissible_torque_never_gives_more_efficiency(curve):
    assert np.all(np.diff(curve.torque) > 0.0)
    assert np.all(np.diff(curve.efficiency) <= 1e-9)


@pytest.mark.slow
def test_no_design_of_many_beats_the_curve(name, curve):
    found = samples(name)
    torque = found["M_permissible_Nm"]
    assert torque.max() < curve.torque[-1] * (1.0 + 1e-6)
    for bound, efficiency in zip(curve.torque, curve.efficiency, strict=True):
        strong = torque >= bound
        assert efficiency > np.max(found["eta_z1_2"], where=strong, initial=0.0) - 1e-6


@pytest.mark.slow
def test_the_optimum_lies_on_the_curve_where_strength_decides(curve, best):
    torque = best.after.bs721["M_permissible_Nm"]
    nearby = np.interp(torque, curve.torque, curve.efficiency)
    assert best.after.iso14521["eta_z1_2"] == pytest.approx(nearby, abs=2e-4)


@pytest.mark.ordinary(1)
def test_the_dataset_of_the_curve_survives_its_file(curve, tmp_path):
    dataset = read_dataset(write_dataset(curve.to_dataset(), tmp_path / "curve.nc"))
    assert dataset["torque"].attrs["units"] == "N m"
    assert dataset["eta_z1_2"].values.tolist() == curve.efficiency.tolist()
    assert dataset.attrs["given.M_s_Nm"] == pytest.approx(curve.given["M_s_Nm"])


def test_the_picture_shows_curve_gearset_and_optimum(curve, best):
    (axes,) = dataclasses.replace(best, curve=curve).plot().axes
    assert len(axes.lines) == 3


def test_starts_must_be_a_power_of_two():
    for starts in (0, 6):
        with pytest.raises(InputError, match=f"^starts is {starts}; it must be a power of two"):
            optimise(*gearset(), starts=starts)


@pytest.mark.slow
def test_a_wheel_narrower_than_the_worm_reaches_does_not_hide_the_best_designs():
    subject = gearset("gearset-2", "gearset.wheel_face_width=10 mm")
    found = samples("gearset-2", "gearset.wheel_face_width=10 mm")
    best = optimise(*subject)
    kept = np.ones(len(found["h_star"]), dtype=bool)
    for key in ("M_w_Nm", "M_s_Nm"):
        kept &= found[key] >= best.before.bs721[key]
    assert best.after.iso14521["eta_z1_2"] > found["eta_z1_2"][kept].max() - 1e-6


@pytest.mark.slow
def test_a_wheel_narrower_than_the_worm_reaches_does_not_hide_the_strongest_designs():
    subject = gearset("gearset-2", "gearset.wheel_face_width=10 mm")
    found = samples("gearset-2", "gearset.wheel_face_width=10 mm")
    curve = trade_off(*subject, points=3)
    assert curve.torque[-1] > found["M_permissible_Nm"].max() * (1.0 - 1e-6)


def test_a_curve_needs_two_points():
    with pytest.raises(InputError, match="points is 1"):
        trade_off(*gearset(), points=1)


def test_where_nothing_can_change_the_curve_is_a_point():
    given = gearset()
    same = (given[0].pressure_angle,) * 2, (given[0].worm_roughness,) * 2
    q = given[0].geometry.diameter_factor
    fixed = Bounds(
        pressure_angle=same[0],
        worm_roughness=same[1],
        diameter_factor=(q, q),
        module_change=(0.0, 0.0),
    )
    found = trade_off(*given, bounds=fixed)
    assert found.torque.tolist() == [pytest.approx(found.given["M_permissible_Nm"])]


def test_a_climb_finds_the_top_of_a_hill_behind_a_fence():
    def merit(points):
        x, y = points.T
        hill = -((x - 0.7) ** 2) - (y - 0.6) ** 2
        return np.stack([hill, 0.5 - x], axis=-1)

    top = climb(merit, spread(2, 4))
    assert top.point == pytest.approx([0.5, 0.6], abs=1e-5)
    assert top.agreed == 4


def test_a_climb_goes_round_points_without_an_answer():
    def merit(points):
        x, y = points.T
        return np.where(x + y > 1.5, np.nan, x + y)[:, None]

    top = climb(merit, [np.array([0.2, 0.3])])
    assert math.isfinite(top.height)
    assert 0.5 <= top.height <= 1.5


def test_a_climb_that_ends_beyond_a_kink_goes_back_as_far_as_needed():
    def merit(points):
        x, y = points.T
        # The height falls steeply beyond a ridge that no slope announces.
        ridge = np.where(x < 0.4, 1.0 + x, 1.4 - 50.0 * (x - 0.4))
        return np.stack([y, ridge - y - 0.9], axis=-1)

    start = np.array([0.1, 0.05])
    top = climb(merit, [start])
    assert top.height > 0.45
    assert merit(top.point[None])[0, 1] >= -1e-12


@pytest.mark.parametrize("dimensions", [1, 2, 3, 4])
def test_the_starts_are_points_of_sobol(dimensions):
    from scipy.stats.qmc import Sobol

    expected = Sobol(dimensions, scramble=False).random(64)
    assert spread(dimensions, 64).tolist() == expected.tolist()


def test_a_failure_of_the_merit_ends_all_climbs():
    def merit(points):
        raise InputError("there is nothing to climb")

    with pytest.raises(InputError, match="nothing to climb"):
        climb(merit, spread(2, 4))


def test_a_climb_without_an_allowed_point_has_no_top():
    assert (
        climb(lambda points: np.stack([points[:, 0], points[:, 0] - 2.0], -1), spread(1, 2)) is None
    )


def test_a_fixed_tooth_friction_leaves_nothing_to_optimise():
    case = read_case("gearset-2", case_tables(), ["rating.friction=0.05"])
    tables = case.require(Gearset), case.require(Operation), case.require(RatingOptions)
    with pytest.raises(InputError, match=r"^rating.friction is 0.05, .* leave it out"):
        optimise(*tables)


def test_what_has_no_say_stays_as_near_as_it_may_to_where_it_was():
    # The edition of 1998 knows no pressure angle: every one that the hob can cut is as good.
    found = optimise(*gearset("gearset-3", "rating.iso14521_edition=1998"))
    assert found.to_json()["optimum"]["pressure_angle_deg"] == pytest.approx(20.0, abs=0.5)
    assert found.gain > 0.03


def test_of_several_tops_the_nearest_to_the_first_start_is_taken():
    def merit(points):
        return np.stack([-((points[:, 0] - 0.5) ** 2), points[:, 0]], axis=-1)

    top = climb(merit, [np.array([0.1, 0.3]), *spread(2, 8)])
    assert top.point == pytest.approx([0.5, 0.3], abs=1e-6)
    assert top.agreed == 9


def test_climbs_that_are_interrupted_as_they_set_out_wait_for_nobody(monkeypatch):
    real, begun = ThreadPoolExecutor.submit, []

    def submit(pool, *what):
        begun.append(what)
        if len(begun) == 3:
            raise KeyboardInterrupt
        return real(pool, *what)

    def merit(points):
        return np.stack([-((points[:, 0] - 0.5) ** 2), points[:, 0]], axis=-1)

    def climbed():
        with pytest.raises(KeyboardInterrupt):
            climb(merit, [*spread(2, 8)])
        ended.append(True)

    # Where SciPy's function climbs, each climb has a thread.
    monkeypatch.setattr(stepwise, "_machine_code", lambda: None)
    monkeypatch.setattr(ThreadPoolExecutor, "submit", submit)
    ended = []
    thread = threading.Thread(target=climbed, daemon=True)
    thread.start()
    thread.join(30.0)
    assert ended


def test_a_design_keeps_its_threads_or_as_few_as_the_gearset_has():
    parts = gearset("gearset-3")
    space = Space(*parts, least={})
    own = float(space.threads_of(parts[0].geometry.diameter_factor, parts[0].pressure_angle))
    assert own > LEAST_THREADS
    assert space.least_threads == LEAST_THREADS
    # The thesis looks at none.
    assert Space(*parts).least_threads is None
