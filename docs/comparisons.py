"""What the package is compared with on the page of validation, calculated when that is built.

The tests hold the same comparisons to their limits.
"""

import math
import tomllib
from pathlib import Path
from typing import NamedTuple

import asperity
from asperity.casefile import read_case
from asperity.friction import Friction
from asperity.gearset import Gearset
from asperity.normal import Normal
from asperity.rating import Operation, agma6034, rate
from asperity.rating.demands import DEMANDS
from asperity.runs import Run
from asperity.slider import TABLES, Model, Slider, Solve, solve, static
from asperity.slider.closed_forms import directed_ratio, master_curve
from asperity.vibration import Vibration


class Compared(NamedTuple):
    """A number, and what somebody else has for it.

    The limit is the relative deviation that is allowed.
    """

    quantity: str
    theirs: float
    ours: float
    limit: float
    unit: str = ""

    @property
    def deviation(self):
        return self.ours / self.theirs - 1.0


class Sized(NamedTuple):
    """A published gearset, and the smallest that holds by every standard for the same.

    Centre distances in mm; ours is infinite where none holds. Changed is ours with the assumption
    that differs, and lacking the safeties, as ``standard.key``, of the gearset that was published.
    """

    name: str
    source: str
    trust: str
    asked: str
    theirs: float
    ours: float
    differs: str = ""
    changed: float = math.inf
    fails: str = ""
    lacking: tuple[str, ...] = ()


def published():
    """Published gearsets, sized again from ratio, torque and speed."""
    file = Path(__file__).with_name("published_gearsets.toml")
    for entry in tomllib.loads(file.read_text("utf-8"))["gearset"]:
        differs, fails = entry.get("differs", ""), entry.get("fails", "")
        yield Sized(
            entry["name"],
            entry["source"],
            entry["trust"],
            f"{entry['ratio']:.4g}, {entry['output_torque']}, {entry['worm_speed']}",
            entry["centre_distance"],
            smallest(entry),
            differs,
            smallest({"settings": [], **entry, **entry["instead"]}) if differs else math.inf,
            fails,
            tuple(lacking(entry)) if fails else (),
        )


def smallest(entry):
    """Return the least centre distance that is proposed and holds by every standard, in mm."""
    found = asperity.size(
        entry["ratio"],
        entry["output_torque"],
        entry["worm_speed"],
        settings=entry.get("settings", ()),
    )
    return found.found[0].centre_distance_mm if found.holding else math.inf


def lacking(entry):
    """Yield the safeties that the published gearset does not have, by the same assumptions."""
    settings = [s.partition("=") for s in entry["settings"]]
    given = {"gearset": {}, "operation": {}}
    for path, _, value in settings:
        table, _, key = path.partition(".")
        given[table][key] = value
    gearset = Gearset(
        **entry["own"],
        worm_material="case-hardened steel",
        wheel_material="CuSn12Ni2-C-GZ",
        **given["gearset"],
    )
    operation = Operation(
        worm_speed=entry["worm_speed"],
        output_torque=entry["output_torque"],
        **given["operation"],
    )
    found = rate(gearset, operation)
    for demand in DEMANDS:
        if getattr(found, demand.standard)[demand.key] < demand.asked:
            yield demand.path


def closed_forms():
    """Rigid friction under a sine, marched, against its closed forms."""
    for k, degrees in ((2.0, 0.0), (2.0, 90.0), (6.0, 45.0)):
        settings = [
            "slider.lateral=guided", "friction.transfer=1", "friction.model=coulomb",
            "vibration.start=0 s", "solve.duration=20 ms", "solve.step=0.1 us",
            f"vibration.velocity_ratio={k}", f"vibration.direction={degrees} deg",
        ]  # fmt: skip
        case = read_case("table-4.4", TABLES, settings)
        rigid = case.replace_values({"slider.drive_stiffness": None, "slider.drive_damping": None})
        yield Compared(
            f"drive force over mu F_N, shaken {k:g} times as fast as it slides, {degrees:g} deg",
            float(directed_ratio(k, math.radians(degrees))),
            solve(Model.from_case(rigid), history=False).ratio,
            1e-5,
        )


def asperities():
    """Bending asperities by two methods: marched through time, and as a periodic state."""
    for name, way in (("table-4.3", "along"), ("table-4.4", "across")):
        marched, periodic = (
            solve(Model.from_case(read_case(name, TABLES, [f"solve.method={method}"]))).ratio
            for method in ("march", "periodic")
        )
        yield Compared(f"drive force over mu F_N, shaken {way}", periodic, marched, 1e-3)


GRAVITY = 9.80665
# Acceleration of the base over that of gravity, azimuth and elevation in degrees, and the largest
# pull over mu m g, for mu 0.3, at the worst phase.
SHAKEN_BASE = (
    (0.05, 0, 0, 0.8333), (0.15, 0, 0, 0.5), (0.28, 0, 0, 0.0667), (0.15, 90, 0, 0.8660),
    (0.28, 90, 0, 0.3590), (0.20, 45, 0, 0.4105),
    (0.10, 0, 90, 0.9), (0.50, 0, 90, 0.5), (0.90, 0, 90, 0.1), (0.15, 0, 30, 0.4920),
    (0.30, 60, 60, 0.3503),
)  # fmt: skip


def static_ratio(acceleration, azimuth, elevation):
    """Largest pull over mu m g under which a body of 1 kg stays on a base shaken at 100 Hz."""
    turn, stiffness = 200.0 * math.pi, (40.0 * 200.0 * math.pi) ** 2
    contact = None
    if elevation:
        # Forty times as fast as the base, so that the body follows it but for 1/1600.
        contact = Normal(law="linear", stiffness=stiffness, damping_ratio=0.05, units="SI")
    body = Model(
        Slider(drive_velocity=1e-3, normal_force=GRAVITY, mass=1.0, lateral="free", units="SI"),
        Friction(model="coulomb", mu=0.3, units="SI"),
        Vibration(
            frequency=100.0, displacement_amplitude=acceleration * GRAVITY / turn**2,
            direction=f"{azimuth} deg", elevation=f"{elevation} deg", units="SI",
        ),
        normal=contact,
    )  # fmt: skip
    return static.answer(body, Run()).static_ratio


def shaken_base():
    """Static friction on a base that is shaken, of a paper of 1967."""
    for acceleration, azimuth, elevation, theirs in SHAKEN_BASE:
        if not elevation:
            yield Compared(
                f"largest pull over mu m g, base shaken with {acceleration:g} g, {azimuth} deg",
                theirs, static_ratio(acceleration, azimuth, elevation), 2e-4 / theirs,
            )  # fmt: skip


def lugre():
    """A body on a spring that sticks and slips, by LuGre's authors, against the same equations."""
    body = Model(
        Slider(
            drive_velocity=0.1, normal_force=1.0, drive_stiffness=2.0, mass=1.0, lateral="guided",
            units="SI",
        ),
        Friction(
            model="lugre", mu=1.0, static_mu=1.5, tangential_stiffness=1e5, stribeck_velocity=1e-3,
            contact_damping=math.sqrt(1e5), viscous_damping=0.4, units="SI",
        ),
        Vibration(velocity_ratio=0.0, frequency=1e3, units="SI"),
        Solve(method="march", duration=15.0, step=20e-6, units="SI"),
    )  # fmt: skip
    found = solve(body)
    history = found.history
    fast = history.velocity[:, 0] > 0.01
    starts = history.time[1:][fast[1:] & ~fast[:-1]]
    yield Compared("the body passes 10 mm/s", 7.4581, found.breakaway_time, 2e-4, "s")
    yield Compared("friction at most", 1.47657, float(history.friction_max[:, 0].max()), 1e-4, "N")
    yield Compared("spring at most", 1.507988, float(history.drive_force_max.max()), 1e-4, "N")
    yield Compared("from slip to slip", 6.362, float(starts[1] - starts[0]), 2e-3, "s")


def master():
    """Springs under a load that swings by half, pulled by a rigid machine: the master curve."""
    depth, frequency, swing, limit = 0.4e-6, 4e3, 0.5, 68.75e-9
    critical = 2.0 * math.pi * frequency * limit * swing
    for speed in (0.05, 0.2, 0.5, 0.9):
        body = Model(
            Slider(drive_velocity=speed * critical, normal_force=55.0, units="SI"),
            Friction(model="springs", mu=0.1, max_deflection=limit, units="SI"),
            Vibration(
                frequency=frequency, displacement_amplitude=swing * depth, elevation="90 deg",
                units="SI",
            ),
            Solve(method="periodic"),
            normal=Normal(law="linear", control="displacement", penetration=depth, units="SI"),
        )  # fmt: skip
        yield Compared(
            f"friction over mu F_N, {speed:g} of the critical velocity",
            1.0 - swing * float(master_curve(speed)), solve(body, history=False).ratio, 1e-4,
        )  # fmt: skip


PIN_SWING, PIN_DEFLECTION, PIN_FREQUENCY = 0.77, 2.44e-6, 22e3


def pin(velocity):
    """Answer for a pin on a disc that 22 kHz press and relieve, with its two fitted numbers."""
    body = Model(
        Slider(drive_velocity=velocity, normal_force=3.0, units="SI"),
        Friction(mu=0.2, max_deflection=PIN_DEFLECTION, exponent=0.0, units="SI"),
        Vibration(
            frequency=PIN_FREQUENCY, displacement_amplitude=PIN_SWING * 1e-6, elevation="90 deg",
            units="SI",
        ),
        Solve(method="periodic"),
        normal=Normal(law="linear", control="displacement", penetration=1e-6, units="SI"),
    )  # fmt: skip
    return solve(body, history=False)


def ultrasonic_pin():
    """A steel pin under 22 kHz normal to the disc, of two speeds from one swing and one s_max."""
    for speed, theirs in ((20.3, 0.38), (87.0, 0.71)):
        yield Compared(
            f"friction over that without vibration, {speed:g} mm/s",
            theirs, pin(1e-3 * speed).ratio, 5e-3,
        )  # fmt: skip


def textbook():
    """AGMA 6034 against example 15-3 of Shigley's Mechanical Engineering Design."""
    inch, capacity = {"units": "inch"}, agma6034.capacity
    pitch, worm = math.pi / 4.0, 3.0
    wheel = 24 * pitch / math.pi
    lead = math.atan(pitch / (math.pi * worm))
    sliding = agma6034.mesh.sliding_velocity(worm, lead, 1800.0, **inch)
    c_s = capacity.materials_factor(0.5 * (worm + wheel), wheel, "chill", **inch)
    c_m = capacity.ratio_correction_factor(24.0)
    c_v = capacity.velocity_factor(sliding, **inch)
    face = capacity.effective_face_width(2.0, worm, **inch)
    load = capacity.allowable_tangential_load(c_s, wheel, face, c_m, c_v, **inch)
    yield Compared("sliding velocity V_s", 1419.0, sliding, 1e-3, "ft/min")
    yield Compared("materials factor C_s", 1000.0, c_s, 1e-3)
    yield Compared("ratio factor C_m", 0.823, c_m, 1e-3)
    yield Compared("velocity factor C_v", 0.211, c_v, 2e-3)
    yield Compared("allowable tangential load", 1456.0, load, 1e-3, "lbf")


def commercial():
    """ISO/TR 14521 against a commercial program's public report by DIN 3996."""
    gearset = Gearset(
        starts=1, wheel_teeth=30, centre_distance="125.125 mm", axial_module="6.4999 mm",
        diameter_factor=8.5, worm_roughness="0.6 um", worm_material="case-hardened steel",
        wheel_material="CuSn12Ni2-C-GZ",
    )  # fmt: skip
    operation = Operation(
        worm_speed="2298 rpm", output_torque="1980 N m", lubricant="ISO VG 460 polyglycol"
    )
    found = rate(gearset, operation, standards=("iso14521",)).iso14521
    yield Compared("power of the worm P_1", 19270.0, found["input_power_W"], 2e-4, "W")
    yield Compared("power of the wheel P_2", 15883.0, found["output_power_W"], 2e-4, "W")
    yield Compared("torque of the worm T_1", 80.074, found["input_torque_Nm"], 2e-4, "N m")


ALL = {
    each.__name__: each
    for each in (
        closed_forms,
        asperities,
        shaken_base,
        lugre,
        master,
        ultrasonic_pin,
        textbook,
        commercial,
    )
}
