"""Components of a REXS model by what they are of a gearbox; materials, oil and tools of one."""

import math
from collections.abc import Mapping
from types import MappingProxyType
from typing import Any, NamedTuple

from asperity.flanks.export.rexs.document import Attributes, Component
from asperity.flanks.parameters import DISC_PROFILE_RADIUS, Disc, Hob, Mount
from asperity.flanks.worm.setting import Pair
from asperity.gearset import Gearset
from asperity.gearset.tolerancing.warmth import EXPANSION
from asperity.rating import Operation
from asperity.rating.forces import Forces
from asperity.shafts.parameters import WheelShaft, WormShaft

OWN = "custom_asperity_"
"""Begins the names of what the format has no attribute for."""

OILS = {
    "mineral": "mineral_oil", "polyalphaolefin": "polyalfaolefin",
    "polyglycol": "non_water_soluble_polyglycol",
}  # fmt: skip
"""Kinds of oil of the format by base oil."""

LUBRICATION = {"bath": "dip_lubrication", "spray": "injection_lubrication"}
"""Ways to lubricate of the format."""

_MILLIMETRES = 1e3
_ZERO_CELSIUS = 273.15
_MM2 = 1e6
# Components by what they are; a number is that of the file.
_NUMBERS = (
    "unit", "casing", "stage", "worm_shaft", "wheel_shaft", "worm", "wheel", "worm_data",
    "wheel_data", "worm_material", "wheel_material", "oil", "worm_load", "wheel_load",
    "worm_bearing_a", "worm_bearing_b", "wheel_bearing_a", "wheel_bearing_b", "worm_section",
    "wheel_section", "worm_left", "worm_right", "wheel_left", "wheel_right", "worm_settings",
    "wheel_settings", "disc", "hob",
)  # fmt: skip
_MOST_SECTIONS = 1000
NUMBER = {name: number for number, name in enumerate(_NUMBERS, 1)} | {
    f"{part}_section_{n}": thousand * _MOST_SECTIONS + n
    for thousand, part in enumerate(("worm", "wheel"), 1)
    for n in range(2, _MOST_SECTIONS)
}
"""Numbers of the components in a file, by what they are."""


class WormStage(NamedTuple):
    """What is written.

    Attributes
    ----------
    gearset : Gearset
        The gearset.
    operation : Operation or None
        How it is run, its torque known.
    hob, disc, mount : Hob, Disc, Mount or None
        How it is made and mounted.
    forces : Forces or None
        On worm and wheel.
    sump : float or None
        Temperature of the oil, K.
    steps : tuple of tuple of float
        Hours, torque of the wheel, N m, and speed of the worm, rpm, of each step of the load.
    worm_shaft, wheel_shaft : WormShaft, WheelShaft or None
        The shafts.
    carried : mapping of str to mapping
        Tables of the case that the format has no place for.
    left_out : tuple of str
        What of the case the file does not hold.
    """

    gearset: Gearset
    operation: Operation | None = None
    hob: Hob | None = None
    disc: Disc | None = None
    mount: Mount | None = None
    forces: Forces | None = None
    sump: float | None = None
    steps: tuple[tuple[float, float, float], ...] = ()
    worm_shaft: WormShaft | None = None
    wheel_shaft: WheelShaft | None = None
    carried: Mapping[str, Mapping[str, Any]] = MappingProxyType({})
    left_out: tuple[str, ...] = ()


def component(what: str, type_: str, name: str = "", /, **attributes: Any) -> Component:
    """Return a component by what it is; attributes whose value is None are left out."""
    return Component(NUMBER[what], type_, name, _present(attributes))


def _present(attributes: dict[str, tuple[Any, str]]) -> Attributes:
    return {key: own for key, own in attributes.items() if own[0] is not None}


def mm(metres: float | None) -> tuple[float | None, str]:
    """Return a length in metres as an attribute."""
    return (None if metres is None else float(f"{metres * _MILLIMETRES:.15g}")), "mm"


def celsius(kelvin: float | None) -> tuple[float | None, str]:
    """Return a temperature as an attribute."""
    return (None if kelvin is None else float(f"{kelvin - _ZERO_CELSIUS:.12g}")), "C"


def materials(stage: WormStage) -> list[Component]:
    """Return the materials of worm and wheel."""
    made = []
    for part in ("worm", "wheel"):
        own = getattr(stage.gearset, f"{part}_material")
        metal = "bronze" if "bronze" in getattr(own, "family", "") else "cast iron"
        grows = EXPANSION["steel" if part == "worm" else metal]
        made.append(
            component(
                f"{part}_material", "material", own.name,
                material_designation=(own.name or None, "none"),
                elastic_modulus=(float(f"{own.youngs_modulus / 1e6:.12g}"), "N / mm^2"),
                poisson_ratio=(own.poisson_ratio, "none"),
                thermal_expansion_coefficient_plus=(1e6 * grows, "1e-6 / C"),
            )
        )  # fmt: skip
    return made


def oil(run: Operation) -> Component:
    """Return the oil of an operation."""
    own = run.lubricant
    density = None if own.density_15 is None else float(f"{own.density_15 / 1e3:.12g}")
    return component(
        "oil", "lubricant", own.name, name=(own.name or own.base_oil, "none"), kind=("oil", "none"),
        lubricant_type_iso_6336_2006=(OILS[own.base_oil], "none"),
        viscosity_at_40_degree_celsius=(float(f"{own.viscosity_40 * _MM2:.12g}"), "mm^2 / s"),
        viscosity_at_100_degree_celsius=(float(f"{own.viscosity_100 * _MM2:.12g}"), "mm^2 / s"),
        density_at_15_degree_celsius=(density, "kg / dm^3"),
    )  # fmt: skip


def tools(stage: WormStage, pair: Pair) -> list[Component]:
    """Return the tools that make worm and wheel, and how they stand."""
    g, gearset, hob = stage.gearset.geometry, stage.gearset, pair.hob
    form = (gearset.flank.lower(), "none")
    flat = (math.degrees(g.pressure_angle), "deg")
    disc = stage.disc or Disc()
    radius = None
    if gearset.flank == "ZC":
        radius = disc.profile_radius or DISC_PROFILE_RADIUS * g.axial_module / _MILLIMETRES
    ground = disc.diameter if gearset.flank in ("ZK", "ZC") else None
    correction = pair.cutting.centre_distance - g.centre_distance
    given_hob = stage.hob or Hob()
    return [
        component("worm_settings", "worm_gear_manufacturing_settings",
                   center_distance_correction=(0.0, "mm"),
                   pressure_angle_correction=(0.0, "deg")),
        component("wheel_settings", "worm_gear_manufacturing_settings",
                   center_distance_correction=(correction, "mm"),
                   lyra_angle=(math.degrees(given_hob.tilt), "deg"),
                   hobbing_procedure=("radial", "none")),
        component("disc", "worm_grinding_disc_tool", "grinding disc", flank_form=form,
                   pressure_angle_worm_gear=flat, profile_radius_zc_disc=mm(radius),
                   grinding_disk_diameter=mm(ground)),
        component("hob", "worm_wheel_hob_tool", "hob", flank_form=form,
                   pressure_angle_worm_gear=flat, number_of_teeth=(g.starts, "none"),
                   lead=(2.0 * math.pi * hob.reduced_lead, "mm"),
                   tip_diameter_worm_gear=(2.0 * hob.tip_radius, "mm"),
                   **{f"{OWN}tip_radius": (given_hob.tip_radius, "none"),
                      f"{OWN}oversize": (given_hob.oversize, "none"),
                      f"{OWN}rule": (given_hob.rule, "none")}),
    ]  # fmt: skip
