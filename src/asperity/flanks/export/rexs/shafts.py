"""The shafts of a REXS model: sections, bearings and loads, as a case has them or as assumed.

A shaft that the case describes, ``[worm_shaft]`` or ``[wheel_shaft]``, is written with its sections
and with its bearings at their places, as wide and as stiff as they are. One that it does not is a
plain one, long enough for the gear, with a bearing at either side.
"""

from collections.abc import Iterator
from typing import Any, NamedTuple

from asperity.flanks.export.rexs.components import OWN, WormStage, component, mm
from asperity.flanks.export.rexs.document import Component
from asperity.rating import Operation
from asperity.shafts.parameters import ShaftBearing

ALONG_X = {"u_axis_vector": ((1.0, 0.0, 0.0), "mm"), "w_axis_vector": ((0.0, 0.0, 1.0), "mm")}
ALONG_Z = {"u_axis_vector": ((0.0, 0.0, 1.0), "mm"), "w_axis_vector": ((0.0, 1.0, 0.0), "mm")}
_MILLIMETRES = 1e3
_OF_ROOT, _OF_DISTANCE = 0.8, 0.4  # diameters of plain shafts
_WAYS = {"both": "both_directions", "radial": "no_direction", "away": "positive",
         "towards end": "negative"}  # fmt: skip


class Place(NamedTuple):
    """A bearing.

    Attributes
    ----------
    at : float
        From the end, mm.
    inside, outside, width : float
        Its boundary dimensions, mm.
    absorbs : str
        The axial force it takes, as the format has it.
    own : mapping
        What else is known of it, as attributes.
    """

    at: float
    inside: float
    outside: float
    width: float
    absorbs: str
    own: dict[str, tuple[Any, str]]


class Laid(NamedTuple):
    """A shaft along its axis.

    Attributes
    ----------
    mesh : float
        Where its gear is, from the end, mm.
    sections : tuple of tuple of float
        Diameter and length of each, mm.
    places : tuple of Place
        Its two bearings, the nearer to the end first.
    """

    mesh: float
    sections: tuple[tuple[float, float], ...]
    places: tuple[Place, ...]


def worm_shaft(stage: WormStage) -> Laid:
    """Return the worm's shaft."""
    g = stage.gearset.geometry
    if stage.worm_shaft is not None:
        return _described(stage.worm_shaft, g.worm_root_diameter)
    span = _span(stage.operation, g.centre_distance)
    return _plain(span, 0.5 * span, _OF_ROOT * g.worm_root_diameter)


def wheel_shaft(stage: WormStage) -> Laid:
    """Return the wheel's shaft."""
    far = stage.gearset.geometry.centre_distance
    if stage.wheel_shaft is not None:
        return _described(stage.wheel_shaft, 0.0)
    return _plain(far, 0.5 * far, _OF_DISTANCE * far)


def _span(run: Operation | None, distance: float) -> float:
    """Between the bearings of a worm whose shaft is not described, mm."""
    if run is not None and run.bearing_span is not None:
        return float(f"{run.bearing_span * _MILLIMETRES:.15g}")
    return 1.5 * distance


def _plain(mesh: float, side: float, size: float) -> Laid:
    places = tuple(
        Place(at, size, 2.0 * size, 0.5 * size, absorbs, {})
        for at, absorbs in ((mesh - side, "both_directions"), (mesh + side, "no_direction"))
    )
    return Laid(mesh, ((size, 2.0 * mesh),), places)


def _described(table: Any, threads: float) -> Laid:
    sections = tuple(
        (threads if one.diameter is None else _millimetres(one.diameter), _millimetres(one.length))
        for one in table.section
    )
    bearings = sorted(table.bearing, key=lambda one: one.at)
    places = tuple(
        _place(one, sections, _absorbs(one, first))
        for one, first in zip(bearings, (True, False), strict=True)
    )
    return Laid(_millimetres(table.mesh), sections, places)


def _place(bearing: ShaftBearing, sections: tuple[tuple[float, float], ...], absorbs: str) -> Place:
    at, rolling = _millimetres(bearing.at), bearing.bearing
    own: dict[str, tuple[Any, str]] = {"radial_stiffness": (bearing.stiffness, "N / m")}
    if rolling is None:
        size = _diameter_at(sections, at)
        return Place(at, size, 2.0 * size, 0.5 * size, absorbs, own)
    own |= {
        "part_number": (rolling.name or None, "none"),
        f"{OWN}kind": (rolling.kind, "none"),
        f"{OWN}arrangement": (bearing.arrangement, "none"),
        f"{OWN}dynamic_rating": (rolling.dynamic_rating, "N"),
        f"{OWN}static_rating": (rolling.static_rating, "N"),
    }
    bore, outside, width = (
        _millimetres(each) for each in (rolling.bore, rolling.outside_diameter, rolling.width)
    )
    return Place(at, bore, outside, width * (2.0 if bearing.pair else 1.0), absorbs, own)


def _absorbs(bearing: ShaftBearing, first: bool) -> str:
    """Return the axial force that a bearing takes; of adjusted ones each takes one way."""
    if not bearing.adjusted:
        return _WAYS[bearing.takes]
    # Face to face each is pushed outwards, back to back inwards.
    outwards = bearing.arrangement == "adjusted face-to-face"
    return "negative" if first == outwards else "positive"


def _diameter_at(sections: tuple[tuple[float, float], ...], at: float) -> float:
    end = 0.0
    for diameter, length in sections:
        end += length
        if at <= end:
            return diameter
    return sections[-1][0]


def _millimetres(metres: float) -> float:
    return float(f"{metres * _MILLIMETRES:.15g}")


def section_names(part: str, laid: Laid) -> list[str]:
    """Return what the sections of a shaft are called."""
    return [f"{part}_section", *(f"{part}_section_{n}" for n in range(2, len(laid.sections) + 1))]


def shaft_components(
    part: str, laid: Laid, support: tuple[float, float, float], along: Any, **defined: Any
) -> Iterator[Component]:
    """Yield a shaft, its sections and its bearings.

    Parameters
    ----------
    part : {'worm', 'wheel'}
        Whose shaft.
    laid : Laid
        The shaft.
    support : tuple of float
        Where its end is, mm.
    along : mapping
        Its axes, as attributes.
    **defined
        More attributes of the shaft.
    """
    name = f"{part}_shaft"
    yield component(
        name, "shaft", name.replace("_", " "), support_vector=(support, "mm"),
        reference_component_for_position=(1, "none"), **along, **defined,
    )  # fmt: skip
    begin = 0.0
    for what, (size, length) in zip(section_names(part, laid), laid.sections, strict=True):
        yield component(
            what, "shaft_section", outer_diameter_begin=(size, "mm"),
            outer_diameter_end=(size, "mm"), inner_diameter_begin=mm(0.0),
            inner_diameter_end=mm(0.0), length=(length, "mm"),
            u_coordinate_on_shaft=(begin, "mm"),
        )  # fmt: skip
        begin = float(f"{begin + length:.15g}")
    axis = along["u_axis_vector"][0]
    for end, place in zip("ab", laid.places, strict=True):
        there = tuple(a + place.at * b for a, b in zip(support, axis, strict=True))
        yield component(
            f"{part}_bearing_{end}", "concept_bearing", radial_force_absorption=(True, "none"),
            axial_force_absorption=(place.absorbs, "none"), inner_diameter=(place.inside, "mm"),
            outer_diameter=(place.outside, "mm"), width=(place.width, "mm"),
            u_coordinate_on_shaft_inner_side=(place.at, "mm"),
            u_coordinate_on_shaft_outer_side=(place.at, "mm"),
            reference_component_for_position=(1, "none"), support_vector=(there, "mm"), **along,
            **place.own,
        )  # fmt: skip
