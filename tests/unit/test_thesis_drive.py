"""What the claims and tables of the gearset under vibration rest on."""

import itertools
import math
import pickle
import tomllib
from importlib.resources import files
from types import SimpleNamespace

import numpy as np
import pytest
from apparatus.drives import GIVEN

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.drive.parameters import Drive
from asperity.flanks.parameters import Mount
from asperity.sweep import read_grid
from asperity.thesis.contact.derivatives import Before, scheme
from asperity.thesis.contents import CLAIMS
from asperity.thesis.drive import claims, fine
from asperity.thesis.drive.appendix_e import (
    Subroutine,
    advance,
    coulomb_of_path,
    friction_of_path,
    hammered,
)
from asperity.thesis.drive.marches import LOADING, RUN_UP, from_load, from_start
from asperity.thesis.drive.sets import AMPLITUDE, RATIOS, SPEED, conditions
from asperity.thesis.drive.simulations import (
    BASE,
    FACTORS,
    MESHES,
    OURS,
    PARTS,
    of_set,
    on_mesh,
    varied,
)

pytestmark = pytest.mark.usefixtures("plain_kernels")


def test_the_table_of_points_that_ships_has_the_thesis_s_simulations():
    _, axes = read_grid("drive-thesis", case_tables(), (), (), "drive-thesis")
    shown = [dict(zip([a.path for a in axes], row, strict=True))
             for row in zip(*(axis.shown for axis in axes), strict=True)]  # fmt: skip
    asked = [
        {path: float(text.split()[0]) for path, text in (one.split("=") for one in each.settings)}
        for number in (1, 2, 3)
        for each in of_set(number)
    ]
    assert shown == asked
    assert len(asked) == 33


def test_each_set_has_eleven_simulations_from_0_1_to_20():
    assert len(RATIOS) == 11
    assert (RATIOS[0], RATIOS[-1]) == (0.1, 20.0)
    sets = [conditions(number) for number in (1, 2, 3)]
    assert sum(map(len, sets)) == 33
    for one in (condition for each in sets for condition in each):
        assert one.sliding_speed * one.ratio == pytest.approx(one.velocity)
        assert 2.0 * math.pi * one.frequency * one.amplitude == pytest.approx(one.velocity)


def test_sets_1_and_2_change_the_speed_and_set_3_the_frequency():
    first, second, third = (conditions(number) for number in (1, 2, 3))
    assert {(c.frequency, c.torque) for c in (*first, *second)} == {(750.0, 23.0)}
    assert [c.velocity for c in (first[0], second[0])] == [0.059, 0.087]
    assert first[0].amplitude == pytest.approx(12.5e-6, rel=2e-3)
    for one in third:
        assert one.amplitude == pytest.approx(AMPLITUDE)
        assert one.sliding_speed == pytest.approx(SPEED)
        assert one.worm_speed * 60.0 / (2.0 * math.pi) == pytest.approx(1440.0)
    assert third[-1].frequency == pytest.approx(30.06e3, rel=1e-3)


def test_the_band_of_balance_is_that_of_the_closed_form():
    low, none, high = claims.band()
    assert none == pytest.approx(366.0 / 15.0, rel=1e-9)
    assert (low, high) == pytest.approx((15.40, 34.63), abs=0.01)


def test_a_motor_swings_slowly_all_it_turns_and_above_resonance_the_rotor_alone():
    both = claims._ROTOR + claims._WORM_INERTIA
    omega = 2.0 * math.pi * 5.0
    assert claims.worm_swing(36.0, 5.0) == pytest.approx(36.0 / (both * omega**2), rel=1e-3)
    high = 2.0 * math.pi * 40e3
    carried = claims._SHAFT / (claims._WORM_INERTIA * high**2)
    expected = 36.0 / (claims._ROTOR * high**2) * carried
    assert claims.worm_swing(36.0, 40e3) == pytest.approx(expected, rel=0.4)


def test_a_motor_that_saves_what_the_thesis_says_keeps_its_share_of_the_torque():
    ratio = 7.4 / 33.8
    mass, shapes = claims.motor_of_the_saving(ratio)
    assert mass * (1.0 - ratio) == pytest.approx(6.0)
    for diameter, length, density in shapes:
        left = (diameter - 0.05) ** 2 * (length - 0.03)
        assert left == pytest.approx(ratio * diameter**2 * length)
        assert density * math.pi / 4.0 * diameter**2 * length == pytest.approx(mass)


SUBROUTINE = Subroutine(0.1344, 7e-8, 1.0)
SHARES = (0.424, 0.317)


def test_elastic_increments_of_the_subroutine_are_the_scheme_of_7_3():
    rng = np.random.default_rng(3)
    state = np.zeros(5)
    for _ in range(200):
        # Lengths over s_max, increments well below it.
        before = Before(state[2], state[3], state[1], state[4], 0.0, 1.0)
        d_1, d_2 = rng.uniform(-0.2, 0.2, 2)
        at = scheme(before, state[0] + d_1, state[1] + d_2, 1.0)
        share = at["s_1"].real
        found = advance(Subroutine(1.0, 1.0, 1.0), state, d_1, d_2, 1.0)
        assert abs(share) < 1.0
        assert found == pytest.approx((share * at["cos_b"].real, share * at["sin_b"].real))


def test_the_plastic_branch_keeps_its_root_and_gains_work_from_a_slip_that_turns():
    # Out by 100 increments of 20 s_max, back by 50: friction should turn with the slip.
    steps = 20.0 * SUBROUTINE.max_deflection * np.array([1.0] * 100 + [-1.0] * 50)
    slips = np.stack([steps, np.zeros(150)], axis=-1)
    found = friction_of_path(SUBROUTINE, slips, np.ones(150))
    assert found[:, 0] == pytest.approx(np.full(150, SUBROUTINE.mu))
    work_back = (found * slips)[100:].sum()
    assert work_back == pytest.approx(-SUBROUTINE.mu * 50 * 20.0 * SUBROUTINE.max_deflection)
    sound = (coulomb_of_path(SUBROUTINE.mu, slips, np.ones(150)) * slips).sum(axis=1)
    assert np.all(sound > 0.0)


def test_both_laws_agree_where_slip_does_not_turn_and_part_where_it_does():
    gentle = hammered(SUBROUTINE, 0.5, SHARES, 0.16e-3, 1000)
    assert gentle.subroutine == pytest.approx(gentle.coulomb, abs=0.02)
    for k in (3.0, 5.0, 10.0):
        found = hammered(SUBROUTINE, k, SHARES, 0.16e-3, 1000)
        assert found.subroutine < found.coulomb - 0.1


@pytest.mark.slow
def test_a_sound_asperity_hammers_as_coulomb_does_whatever_the_increments():
    for increments in (500, 4000):
        for k in (0.5, 3.0, 20.0):
            found = hammered(SUBROUTINE, k, SHARES, 0.16e-3, increments)
            assert found.dahl == pytest.approx(found.coulomb, abs=0.01)


@pytest.mark.slow
def test_coulomb_friction_of_the_hammering_worm_is_its_integral():
    # With all of the motion along the sliding, friction is the sign of 1 - k cos.
    phase = np.pi * (np.arange(20000) + 0.5) / 20000
    for k, increments in ((0.5, 4000), (2.0, 8000), (6.0, 4000)):
        found = hammered(SUBROUTINE, k, (1.0, 0.0), 0.16e-3, increments).coulomb
        expected = (np.sin(phase) * np.sign(1.0 - k * np.cos(phase))).mean() * np.pi / 2.0
        assert found == pytest.approx(expected, abs=1e-3)


def test_every_exhibit_of_the_marches_names_what_it_needs_and_its_commands():
    for name, parts in PARTS.items():
        # They are handed to processes.
        needed = pickle.loads(pickle.dumps(parts))(False)
        assert needed, name
        assert all(one.command().startswith("asperity drive drive-") for one in needed)
    assert len({one.task.name for one in (*PARTS["figure 7.13"](False), *of_set(3))}) == 33


@pytest.mark.slow
def test_the_fine_mesh_that_is_kept_is_the_one_that_is_condensed():
    kept = tomllib.loads(files("asperity.thesis.drive").joinpath("fine.toml").read_text("utf-8"))
    assert tomllib.loads("\n".join(fine.lines(fine.computed()))) == kept


def test_the_mesh_study_has_three_densities_at_every_velocity_ratio_and_marches_each_as_named():
    each = [on_mesh(name) for name in MESHES]
    assert {len(group) for group in each} == {len(RATIOS)}
    turns = []
    for name, group in zip(MESHES, each, strict=True):
        drive = read_case(BASE, case_tables(), group[0].settings).require(Drive)
        turns.append(drive.deflection)
        assert name == MESHES[-1] or drive.density == name
        assert name == MESHES[0] or group[0].name.endswith(f"drive.density={name}")
    assert [turn is None for turn in turns] == [True, True, False]
    assert turns[-1][2] == pytest.approx((366.0, 435e-6), rel=1e-2)


def test_at_a_tenth_of_the_sliding_speed_hardly_anything_happens():
    found = of_set(3, *GIVEN)[0].shaken()
    assert found.settled
    assert found.ratio == pytest.approx(1.0, abs=2e-3)
    assert found.window == pytest.approx(1.0, abs=5e-3)
    assert found.closure < 1e-3
    assert found.static == pytest.approx(34.67, abs=0.01)


def test_a_march_from_the_start_is_the_one_that_is_kept_cycle_by_cycle():
    one = of_set(3, *GIVEN)[-1]
    rows = from_start(one.case, one.settings, 3, 20)
    kept = one.shaken().cycle_torque[:3]
    assert rows["torque"].reshape(3, 20).mean(axis=1) == pytest.approx(kept, rel=2e-2)


def test_from_load_on_the_worm_holds_then_turns_as_without_vibration_then_shakes_as_from_balance():
    one = of_set(3, *GIVEN)[-1]
    found = from_load(one.case, one.settings, 3, 20)
    time, torque, wheel = found["time"], found["torque"], found["wheel"]
    assert np.diff(time).min() > 0.0
    # Loaded, the wheel turns the worm back on its shaft: friction bears a part of the load.
    low, _, high = claims.band()
    loaded = np.argmin(np.abs(time - LOADING))
    assert wheel[loaded] == pytest.approx(conditions(3)[-1].torque, rel=5e-3)
    assert torque[loaded] == pytest.approx(low / high * found["static"], rel=0.05)
    assert not found["open"][1 : -3 * 20].any()
    # It turns as the one that begins in balance, and swings about that by little.
    steady = (time > LOADING + RUN_UP) & (time < found["steps"][-1])
    assert torque[steady].mean() == pytest.approx(found["static"], rel=5e-3)
    assert np.ptp(torque[steady]) < 0.1 * found["static"]
    begun = from_start(one.case, one.settings, 3, 20)
    shaken = torque[-3 * 20 :]
    assert shaken == pytest.approx(begun["torque"], abs=0.05 * found["static"])
    assert found["open"][-3 * 20 :] == pytest.approx(begun["open"], abs=0.5)


def test_what_is_varied_is_what_the_case_has_and_each_once_less_and_more():
    case = read_case(BASE, case_tables())
    drive, mount = case.require(Drive), case.require(Mount)
    has = (drive.load_inertia, drive.worm_inertia, drive.contact_damping, 1e3 * mount.backlash)
    assert [value for value, _ in OURS.values()] == pytest.approx(has, rel=1e-12)
    last = of_set(3)[-1].settings
    changed = [set(one.settings) - set(last) for one in varied()]
    assert all(set(last) < set(one.settings) for one in varied())
    assert sorted(key.partition("=")[0] for (key,) in changed) == sorted([*OURS] * len(FACTORS))
    for (setting,), (key, factor) in zip(changed, itertools.product(OURS, FACTORS), strict=True):
        value = float(setting.partition("=")[2].split()[0])
        assert value == pytest.approx(factor * OURS[key][0], rel=1e-5)


def test_the_advantages_are_the_torques_over_again():
    found = CLAIMS["7.4"].make()
    assert found.verdict == "arithmetic"
    assert found.numbers["advantage_without_friction"] == pytest.approx(15.0, rel=1e-9)


@pytest.mark.parametrize(
    ("least", "settled", "verdict"),
    [(0.4, True, "differs"), (0.2, False, "differs"), (0.2, True, "reproduced")],
)
def test_one_balanced_march_as_low_would_uphold_the_saving(monkeypatch, least, settled, verdict):
    def run(ratio, settled=True):
        one = SimpleNamespace(ratio=ratio, settled=settled)
        return SimpleNamespace(shaken=lambda: one, command=lambda: "asperity drive")

    module = "asperity.thesis.drive.claims"
    monkeypatch.setattr(f"{module}.of_set", lambda _number: [run(0.9), run(0.6)])
    monkeypatch.setattr(f"{module}.varied", lambda: [run(0.7), run(least, settled)])
    found = CLAIMS["7.11"].make()
    assert found.verdict == verdict
    assert found.numbers["saved_by_its_numbers"] == pytest.approx(0.781, rel=1e-3)
    assert found.numbers["gain_by_its_numbers"] == pytest.approx(4.57, rel=1e-3)
    assert found.numbers["ratio_marched_most"] == 0.7
    assert found.numbers["ratio_marched_least"] == (least if settled else 0.6)


def test_ten_times_the_amplitude_is_a_hundred_times_the_energy_at_one_frequency_alone():
    found = CLAIMS["7.12"].make()
    assert found.verdict == "arithmetic"
    assert found.numbers["energy_at_k_w_0.5"] == pytest.approx(100.0, rel=5e-3)
    assert found.numbers["energy_at_k_w_5"] == pytest.approx(1e4, rel=5e-3)


def test_what_a_motor_saves_in_balance_follows_from_the_runs_that_settled(monkeypatch):
    def run(ratio, settled=True):
        one = SimpleNamespace(ratio=ratio, settled=settled)
        return SimpleNamespace(shaken=lambda: one, command=lambda: "asperity drive")

    runs = [run(1.0), run(0.8), run(0.6), run(0.3, settled=False)]
    monkeypatch.setattr("asperity.thesis.drive.claims.of_set", lambda _number: runs)
    found = CLAIMS["7.13"].make().numbers
    assert found["least_settled_ratio"] == 0.6
    assert found["saved_at_least_kg"] == pytest.approx(0.4 * found["motor_mass_kg"])
    assert found["saved_at_most_kg"] == pytest.approx(0.2 * found["motor_mass_kg"])
