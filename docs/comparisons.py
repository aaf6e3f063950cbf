"""What the package is compared with on the page of validation, calculated when that is built.

The tests hold the same comparisons to their limits.
"""

import math
import tomllib
from pathlib import Path
from typing import NamedTuple

import asperity
from asperity.casefile import read_case
from asperity.gearset import Gearset
from asperity.rating import Operation, agma6034, rate
from asperity.rating.demands import DEMANDS
from asperity.slider import TABLES, Model, solve
from asperity.slider.closed_forms import directed_ratio


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


ALL = {each.__name__: each for each in (closed_forms, asperities, textbook, commercial)}
