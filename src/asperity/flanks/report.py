"""A study of flanks as tables for the terminal."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rich.console import Group
    from rich.table import Table

    from asperity.flanks.result import FlankStudy

# Key in JSON, what it is, symbol, unit.
_GEARSET = (
    ("lead_angle_deg", "lead angle", "gamma", "deg"),
    ("base_radius_mm", "base radius", "r_b", "mm"),
    ("base_lead_angle_deg", "base lead angle", "gamma_b", "deg"),
    ("backlash_normal_mm", "backlash, normal, least over a pitch", "j_n", "mm"),
    ("axial_clearance_mm", "axial clearance of the worm", "", "mm"),
    ("axial_amplitude_max_mm", "greatest amplitude of its axial vibration", "", "mm"),
    ("flank_area_mm2", "area of a flank of the wheel", "", "mm2"),
)
_FLANK = (
    ("transmission_error_rad", "transmission error, peak to peak", "rad"),
    ("transmission_error_mean_rad", "transmission error, mean", "rad"),
    ("ease_off_max_um", "ease-off, greatest", "um"),
    ("ease_off_min_um", "ease-off, least", "um"),
    ("pattern_area_fraction", "contact pattern (6 um), share", ""),
    ("pattern_centre_mm", "its centre: face, radial", "mm"),
    ("contact_ratio", "contact ratio, unloaded", ""),
    ("contact_ratio_marked", "contact ratio, gaps to 6 um", ""),
    ("undercut", "undercut", ""),
    ("conjugacy_residual_mm", "distance to the hob that cuts it", "mm"),
)
_LOADED = (
    ("loaded_teeth", "teeth that carry, least", min, ""),
    ("line_load_max_N_per_mm", "line load, greatest", max, "N/mm"),
    ("hertz_pressure_max_MPa", "Hertzian pressure, greatest", max, "MPa"),
    ("film_mean_um", "oil film, mean, least", min, "um"),
    ("film_min_um", "oil film, least", min, "um"),
    ("sliding_speed_mean_mm_per_s", "sliding speed, mean, greatest", max, "mm/s"),
)
_MESH = (
    ("element_size_mm", "element size on the flank", "mm"),
    ("nodes", "nodes", ""),
    ("elements", "elements", ""),
    ("scaled_jacobian_min", "scaled Jacobian, least", ""),
    ("scaled_jacobian_median", "scaled Jacobian, median", ""),
)
_DIRECTIONS = {
    "axial": "worm along its axis",
    "torsional": "worm about its axis",
    "wheel_axial": "wheel along its axis",
    "screw": "worm along its lead",
}


def to_rich(study: "FlankStudy") -> "Group":
    """Return tables of the gearset, the flanks, the vibrations and the mesh, and the notes."""
    from rich.console import Group
    from rich.text import Text

    found = study.to_json()
    pair = study.wheel.pair
    gearset = _table(f"{pair.flank}, {pair.hand} hand", "symbol", "value", "unit")
    for key, name, symbol, unit in _GEARSET:
        if found[key] is not None:
            gearset.add_row(name, symbol, _text(found[key]), unit)
    sides = found["flanks"]
    flanks = _table("flank", *(f"s = {side}" for side in sides), "unit")
    for key, name, unit in _FLANK:
        flanks.add_row(name, *(_text(side[key]) for side in sides.values()), unit)
    mesh = _table(f"mesh of a tooth, {study.density}", "value", "unit")
    for key, name, unit in _MESH:
        mesh.add_row(name, _text(found["mesh"][key]), unit)
    remarks = [f"- {line}" for line in _remarks(study)]
    tables = [gearset, flanks, _vibration(found["vibration"]), mesh]
    if all("loaded" in side for side in sides.values()):
        tables.insert(2, _loaded(sides))
    parts: list[Any] = [part for table in tables for part in (table, Text())]
    return Group(*parts, *map(Text, remarks))


def _loaded(sides: Mapping[str, Mapping[str, Any]]) -> "Table":
    """What is greatest or least under load at any angle of a pitch."""
    table = _table("under load, over a pitch", *(f"s = {side}" for side in sides), "unit")
    for key, name, choose, unit in _LOADED:
        chosen = (choose(lines[key] for lines in side["loaded"]) for side in sides.values())
        table.add_row(name, *map(_text, chosen), unit)
    return table


def _vibration(found: Mapping[str, Mapping[str, float]]) -> "Table":
    parts = list(next(iter(found.values())))
    table = _table("part of a vibration, s = +1", *parts)
    for direction, by_part in found.items():
        row = (f"{value:.3f}" for value in by_part.values())
        table.add_row(_DIRECTIONS[direction], *row)
    return table


def _remarks(study: "FlankStudy") -> list[str]:
    remarks = list(study.notes)
    for words, group in (
        ("from memory, check before use", study.from_memory),
        ("assumed, give them to replace the defaults", study.assumed),
    ):
        if group:
            listed = "; ".join(f"{key} ({text})" for key, text in group.items())
            remarks.append(f"{words}: {listed}")
    return remarks


def _table(*headings: str) -> "Table":
    from rich.table import Table

    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    for place, heading in enumerate(headings):
        table.add_column(heading, no_wrap=place > 0)
    return table


def _text(value: Any) -> str:
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, list):
        return ", ".join(map(_text, value))
    return f"{value:.5g}" if isinstance(value, float) else str(value)
