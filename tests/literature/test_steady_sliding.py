r"""Steady sliding without vibration: friction is the law's own formula.

Coulomb and Dahl: :math:`\mu F_N`; LuGre (Canudas de Wit et al. 1995):
:math:`F = g(v) + h_v v`, :math:`g(v) = \mu F_N + (F_S - \mu F_N)\exp[-(v/v_s)^2]`.
"""

import math

import numpy as np
import pytest
from apparatus.grid import grid, slow
from apparatus.stribeck import SLOW

from asperity.casefile import read_case
from asperity.slider import TABLES, Model, solve
from asperity.slider.cycle_map import Cycle

DRIVES = {
    "rigid": (),
    "elastic": (
        "slider.mass=0.1 kg", "slider.drive_stiffness=0.2 MN/m", "slider.drive_damping=400 N s/m",
    ),
}  # fmt: skip


def body(folder, *settings):
    path = folder / "slow.toml"
    path.write_text(SLOW)
    return Model.from_case(read_case(path, TABLES, settings))


def exact(velocity):
    return 1.0022 + (1.51 - 1.0022) * math.exp(-((velocity / 1.0249e-3) ** 2)) + 0.38046 * velocity


@pytest.mark.ordinary(10)
@pytest.mark.parametrize("drive", DRIVES)
@pytest.mark.parametrize("velocity", [1e-5, 3e-4, 2e-3, 0.1])
@pytest.mark.parametrize("method", ["periodic", "homogenised"])
def test_lugre_is_what_its_formula_says(tmp_path, velocity, method, drive):
    settings = f"slider.drive_velocity={velocity} m/s", f"solve.method={method}", *DRIVES[drive]
    answer = solve(body(tmp_path, *settings, "solve.duration=0.1 s"), history=False)
    assert answer.drive_force == pytest.approx(exact(velocity), rel=1e-9)
    assert answer.settled


LAWS = {
    "coulomb": ("friction.model=coulomb",),
    "dahl": ("friction.model=dahl",),
    "curved": ("friction.model=dahl", "friction.exponent=2", "friction.law=vector"),
    "lugre": (
        "friction.model=lugre",
        "friction.static_mu=0.15",
        "friction.stribeck_velocity=5 mm/s",
        "friction.viscous_damping=1000 N s/m",
    ),
}
WAYS = {
    "along": ("vibration.direction=0 deg",),
    "across": ("vibration.direction=90 deg",),
    "oblique": ("vibration.direction=30 deg",),
    "up": (
        "vibration.direction=30 deg", "vibration.elevation=60 deg", "normal.law=linear",
        "normal.stiffness=20 MN/m", "normal.damping_ratio=0.1", "friction.law=vector",
    ),
}  # fmt: skip


def shaken(ratio, *settings):
    case = read_case("table-4.3", TABLES, (*settings, f"vibration.velocity_ratio={ratio}"))
    return solve(Model.from_case(case), history=False)


@pytest.mark.ordinary(3)
@pytest.mark.parametrize(("law", "way"), grid([*LAWS], [*WAYS], ordinary=3))
def test_a_vibration_of_nothing_changes_nothing(law, way):
    settings = "solve.method=periodic", *LAWS[law], *WAYS[way]
    nothing, little = (shaken(ratio, *settings) for ratio in (0.0, 1e-6))
    assert nothing.settled
    assert little.settled
    assert little.ratio == pytest.approx(nothing.ratio, rel=1e-6)


@pytest.mark.ordinary(1)
@pytest.mark.parametrize("exponent", [2, 3, slow(4)])
@pytest.mark.parametrize("ratio", [0.0, 1e-3])
def test_asperities_that_fade_by_a_power_of_the_time_make_no_state_one_of_many(ratio, exponent):
    """Next to its limit an asperity of exponent i is off it by w, and dw/dt goes by w^i."""
    settings = (
        *LAWS["curved"], f"friction.exponent={exponent}", *WAYS["up"], "solve.method=periodic",
        "slider.drive_damping=40 N s/m",
    )  # fmt: skip
    state = shaken(ratio, *settings)
    assert state.settled
    assert state.ratio == pytest.approx(1.0, abs=2e-5)
    # Nothing damps this contact, and as much is left of its ring however long.
    ringing = shaken(6.0, *settings, "normal.damping_ratio=0")
    assert not ringing.settled
    assert "one of many" in ringing.settled_by


@pytest.mark.ordinary(1)
@pytest.mark.parametrize("exponent", [5, slow(7), 10])
@pytest.mark.parametrize("ratio", [0.0, slow(1e-3), 1e-2])
def test_nor_do_those_whose_power_is_too_slow_to_be_followed(ratio, exponent):
    settings = (
        *LAWS["curved"], f"friction.exponent={exponent}", *WAYS["up"], "solve.method=periodic",
        "slider.drive_damping=40 N s/m",
    )  # fmt: skip
    state = shaken(ratio, *settings)
    assert state.settled
    assert state.ratio == pytest.approx(1.0, abs=2e-4)
    # In what time, by the test below: longer than one marches from an exponent of 3 on.
    after = 68.75e-9 / 0.5e-3 * 1e3 ** (exponent - 1) / (exponent - 1)
    told = [note for note in state.notes if "come to their limit by a power of the time" in note]
    assert [note.endswith(f"after about {after:.2g} s") for note in told] == [True] * (after > 10.0)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("ratio", "exponent"), grid([5e-4, 2e-3], [2, 5], ordinary=[(5e-4, 2), (2e-3, 5)])
)
def test_a_contact_that_nothing_damps_rings_on_next_to_the_limit_too(ratio, exponent):
    """The law tells where asperities come to, not how far the contact rings."""
    settings = (
        "solve.method=periodic", "vibration.elevation=90 deg", f"friction.exponent={exponent}",
        f"vibration.velocity_ratio={ratio}", "slider.drive_damping=40 N s/m",
    )  # fmt: skip
    damped, ringing = (
        solve(Model.from_case(read_case("pin-on-disc", TABLES, (*settings, *own))), history=False)
        for own in ((), ("normal.damping_ratio=0",))
    )
    assert damped.settled
    assert not ringing.settled
    assert "one of many" in ringing.settled_by


@pytest.mark.ordinary(2)
@pytest.mark.parametrize("exponent", [3, 5, 10])
@pytest.mark.parametrize("off", [0.3, -0.3])
def test_from_above_and_below_asperities_come_to_their_limit_by_the_power(off, exponent):
    """dw/dx = -w^i over the way x in deflection limits: w^(1 - i) grows by i - 1 a limit."""
    settings = (
        *LAWS["curved"], f"friction.exponent={exponent}", *WAYS["up"], "slider.lateral=guided",
        "slider.drive_stiffness=96 MN/m", "slider.drive_damping=10000 N s/m",
    )  # fmt: skip
    case = read_case("table-4.3", TABLES, (*settings, "vibration.velocity_ratio=0"))
    model = Model.from_case(case)
    cycle = Cycle(model, 64, 1e-6)
    assert cycle.find(0)
    stretch, _, deflection, *_ = np.eye(len(cycle.jacobian))
    cycles = 1024
    *_, (left, _) = cycle.pushed(off * (stretch + deflection), cycles)
    # The body goes on by what its drive is let out, or is held back by what it is stretched.
    way = 0.5e-3 * 64e-6 * cycles - (left[0] - off) * 5.5 / 96e6
    by_law = (abs(off) ** (1 - exponent) + (exponent - 1) * way / 68.75e-9) ** (1 / (1 - exponent))
    assert left[2] == pytest.approx(math.copysign(by_law, off), rel=1e-3)


@pytest.mark.slow
def test_nor_does_it_settle_what_sticks_and_slips():
    falls = *LAWS["lugre"], "friction.viscous_damping=0 N s/m", "solve.method=periodic"
    for ratio in (0.0, 1e-6):
        assert not shaken(ratio, *falls).settled


@pytest.mark.ordinary(3)
@pytest.mark.parametrize("law", ["linear", "hertz", "rough"])
@pytest.mark.parametrize("elevation", ["0 deg", "90 deg"])
def test_springs_slide_steadily_at_their_limit_shaken_by_nothing(law, elevation):
    given = ("friction.model=springs", f"normal.law={law}", "vibration.velocity_ratio=1e-6",
             f"vibration.elevation={elevation}")  # fmt: skip
    found = solve(Model.from_case(read_case("normal-pin", TABLES, given)))
    assert found.settled
    assert found.ratio == pytest.approx(1.0, rel=1e-6)


@pytest.mark.slow
def test_a_state_that_leaves_slowly_has_not_settled():
    """Steady sliding on LuGre's falling branch, whose disturbances grow by some 0.3/s."""
    given = (
        "slider.drive_velocity=8.6 mm/s", "slider.normal_force=5.18 N", "slider.mass=0.4866 kg",
        "slider.drive_stiffness=66.4 MN/m", "slider.drive_damping=0 N s/m",
        "slider.lateral=guided", "friction.model=lugre", "friction.mu=0.568",
        "friction.static_mu=0.7014", "friction.max_deflection=0.053 um",
        "friction.stribeck_velocity=2.99 mm/s",
        "vibration.frequency=5.088 kHz", "vibration.velocity_ratio=1e-6", "solve.method=periodic",
    )  # fmt: skip
    found = solve(Model.from_case(read_case("table-4.3", TABLES, given)))
    assert not found.settled
    assert "a disturbance grows 1.000" in found.settled_by
