"""A shaft of a case as it is calculated, in mm, N and MPa: stretches, details, bearings, loads."""

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from asperity.errors import InputError
from asperity.formulas.traced import number
from asperity.gearset.geometry import Geometry
from asperity.rating.inputs import scaled
from asperity.shafts.beam import Stretch
from asperity.shafts.elements import FACTORS, overhung_load
from asperity.shafts.parameters import ShaftBearing, WheelShaft, WormShaft
from asperity.shafts.statics import PointLoad, Reactions
from asperity.shafts.strength.section import Detail

THREADS_BEND = 1.1
"""Diameter that a worm's threads bend with over that of their root, as ISO/TR 14521 has it."""

_SAME = 1e-9
_BORE = 1e-3  # by which a seat may differ from the bore
_SAME_LENGTH = 1e-3


class Misseated(NamedTuple):
    """A bearing that cannot sit where it stands.

    Attributes
    ----------
    end : str
        ``"A"``, the one nearer to the end that positions start from, or ``"B"``.
    why : str
        In a sentence.
    """

    end: str
    why: str


class Model(NamedTuple):
    """A shaft.

    Attributes
    ----------
    table : WormShaft or WheelShaft
        Of the case.
    stretches : tuple of Stretch
        Parts of one diameter, mm.
    details : tuple of Detail
        Sections that are judged.
    drawn : tuple of float
        Outer diameter of each stretch, mm: of threads, over their tips.
    bearings : tuple of float
        Their positions, mm, the one nearer to the end first.
    mesh : float
        Position, mm.
    modulus : float
        MPa.
    notes : tuple of str
        What is not judged, and what is not as it can be.
    misseated : tuple of Misseated
        Bearings that cannot sit where they stand; the notes say so too.
    threads : str
        What is to be said of a worm whose threads are not as long as the gearset has them; the
        notes say so too.
    """

    table: WormShaft | WheelShaft
    stretches: tuple[Stretch, ...]
    details: tuple[Detail, ...]
    drawn: tuple[float, ...]
    bearings: tuple[float, float]
    mesh: float
    modulus: float
    notes: tuple[str, ...]
    misseated: tuple[Misseated, ...] = ()
    threads: str = ""

    @property
    def places(self) -> tuple[ShaftBearing, ShaftBearing]:
        """Its bearings, the one nearer to the end first."""
        first, second = sorted(self.table.bearing, key=lambda each: each.at)
        return first, second

    @property
    def overhang(self) -> str:
        """How far the mesh lies beyond its bearings and beyond which; empty between them."""
        first, second = self.bearings
        if first <= self.mesh <= second:
            return ""
        end, over = ("A", first - self.mesh) if self.mesh < first else ("B", self.mesh - second)
        return f"{over:.4g} mm beyond bearing {end}"

    @property
    def length(self) -> float:
        """Of all of it, mm."""
        return self.stretches[-1].end

    @property
    def radial_compliance(self) -> tuple[float, float]:
        """Radial compliance of the bearings, mm/N."""
        first, second = (
            0.0 if each.stiffness is None else 1e3 / each.stiffness for each in self.places
        )
        return first, second

    def other_loads(self, torque: float) -> tuple[PointLoad, ...]:
        """Return what else pulls at it under a torque of the shaft, N m."""
        made = []
        for each in self.table.load:
            if each.element is None:
                radial = each.radial or 0.0
            else:
                of = FACTORS[each.element], abs(torque), 1e3 * (each.diameter or 1.0)
                radial = number(overhung_load(*of))
            way = math.cos(each.direction), math.sin(each.direction)
            made.append(PointLoad(scaled(each.at, 1e3), (0.0, radial * way[0], radial * way[1])))
        return tuple(made)

    def axial_of(self, carried: Reactions, radial: tuple[float, float]) -> "Axial":
        """Return how the bearings share the axial force.

        Raises
        ------
        InputError
            None of them carries it.
        """
        return share_axial(self.table.table, self.places, carried.axial, radial)


class Axial(NamedTuple):
    """Axial load of each bearing, N: its size, and with its sign along x."""

    loads: tuple[float, float]
    forces: tuple[float, float]


def share_axial(
    name: str,
    places: Sequence[ShaftBearing],
    force: float,
    radial: tuple[float, float],
) -> Axial:
    """Return how two bearings share an axial force along x, N, which points to the first."""
    from asperity.shafts.rolling.equivalent import shared_axial

    first, second = places
    if first.adjusted and first.bearing is not None and second.bearing is not None:
        induced = first.bearing.induced(radial[0]), second.bearing.induced(radial[1])
        # Face to face each bearing carries what pushes the shaft towards it.
        towards = -force if first.arrangement == "adjusted face-to-face" else force
        a, b = shared_axial(towards, *induced)
        sign = 1.0 if first.arrangement == "adjusted face-to-face" else -1.0
        return Axial((a, b), (sign * a, -sign * b))
    way = "towards end" if force > 0.0 else "away"
    able = [each.takes in ("both", way) for each in places]
    if force and not any(able):
        said = "towards the end that positions start from" if force > 0.0 else "away from it"
        raise InputError(
            f"{name}.bearing.carries: no bearing carries the axial force of {abs(force):.4g} N "
            f"{said}; give one carries = 'both' or '{way}'"
        )
    forces = tuple(force if does else 0.0 for does in able)
    return Axial((abs(forces[0]), abs(forces[1])), (forces[0], forces[1]))


def model_of(table: WormShaft | WheelShaft, geometry: Geometry) -> Model:
    """Return a shaft of a case."""
    root = float(geometry.worm_root_diameter)
    tip = float(geometry.worm_tip_diameter)
    stretches, drawn, bears, at = [], [], [], 0.0
    for section in table.section:
        end = at + scaled(section.length, 1e3)
        if section.diameter is None:
            stretches.append(Stretch(at, end, THREADS_BEND * root))
            drawn.append(tip)
            bears.append(root)
        else:
            own = scaled(section.diameter, 1e3)
            stretches.append(Stretch(at, end, own))
            drawn.append(own)
            bears.append(own)
        at = end
    bearings = sorted(scaled(each.at, 1e3) for each in table.bearing)
    modulus = 206e3 if table.material is None else 1e-6 * table.material.youngs_modulus
    details, notes = _details(table, stretches, bears, max(drawn))
    misseated, threads = tuple(_seats(table, stretches)), _of_threads(table, geometry)
    return Model(
        table,
        tuple(stretches),
        details,
        tuple(drawn),
        (bearings[0], bearings[1]),
        scaled(table.mesh, 1e3),
        modulus,
        (*notes, *(one.why for one in misseated), *([threads] if threads else [])),
        misseated,
        threads,
    )


def _of_threads(table: WormShaft | WheelShaft, geometry: Geometry) -> str:
    """Say how long the threads of the sections are where the gearset has them of another length."""
    bare = [section.length for section in table.section if section.diameter is None]
    long, b_1 = scaled(math.fsum(bare), 1e3), float(geometry.worm_face_width)
    if not bare or abs(long - b_1) <= _SAME_LENGTH * b_1:
        return ""
    return (
        f"{table.table}: its sections have {long:.4g} mm of threads, and b_1 is {b_1:.4g} mm: give "
        "gearset.worm_face_width where it is to be the same"
    )


def _seats(table: WormShaft | WheelShaft, stretches: Sequence[Stretch]) -> Iterator[Misseated]:
    """Yield each bearing that cannot sit: on threads, or on another diameter than its bore."""
    for end, place in zip("AB", sorted(table.bearing, key=lambda each: each.at), strict=True):
        at = scaled(place.at, 1e3)
        here = [
            section
            for section, stretch in zip(table.section, stretches, strict=True)
            if stretch.start - _SAME <= at <= stretch.end + _SAME
        ]
        if all(section.diameter is None for section in here):
            yield Misseated(
                end, f"{table.table}: bearing {end} at {at:.4g} mm stands on the threads"
            )
            continue
        if place.bearing is None:
            continue
        bore = scaled(place.bearing.bore, 1e3)
        sizes = [scaled(one.diameter, 1e3) for one in here if one.diameter is not None]
        if all(abs(size - bore) > _BORE * bore for size in sizes):
            yield Misseated(
                end,
                f"{table.table}: bearing {end} has a bore of {bore:.4g} mm and stands on a section "
                f"of {sizes[0]:.4g} mm",
            )


def _details(
    table: WormShaft | WheelShaft,
    stretches: Sequence[Stretch],
    bears: Sequence[float],
    largest: float,
) -> tuple[tuple[Detail, ...], tuple[str, ...]]:
    """Return the sections that are judged, and what is not."""
    inner = [scaled(table.mesh, 1e3)]
    inner += [scaled(each.at, 1e3) for each in table.bearing]
    inner += [scaled(each.at, 1e3) for each in table.load]
    made, notes = [], []
    for place, (section, stretch, d) in enumerate(
        zip(table.section, stretches, bears, strict=True)
    ):
        rough = scaled(section.roughness, 1e6)
        within = [stretch.start, *(s for s in inner if stretch.start < s < stretch.end)]
        within.append(stretch.end)
        name = f"section {place + 1}"
        if section.diameter is None:
            beta = table.thread_notch_bending, table.thread_notch_torsion
            made += [
                Detail(s, f"threads, {name}", d, "threads", rough, largest, beta=beta)
                for s in within
            ]
        elif section.notch == "groove":
            assert section.groove_depth is not None
            assert section.groove_radius is not None
            depth, radius = scaled(section.groove_depth, 1e3), scaled(section.groove_radius, 1e3)
            made += [
                Detail(s, f"groove, {name}", d - 2.0 * depth, "groove", rough, largest, d, radius)
                for s in within
            ]
        elif section.notch != "none":
            made += [
                Detail(s, f"{section.notch}, {name}", d, section.notch, rough, largest)
                for s in within
            ]
        if place + 1 < len(stretches):
            other = bears[place + 1]
            if abs(other - d) < _SAME:
                continue
            if section.fillet is None:
                notes.append(
                    f"{table.table}: the step from {d:.4g} to {other:.4g} mm at "
                    f"{stretch.end:.4g} mm has no fillet and is not judged"
                )
                continue
            small = section if d < other else table.section[place + 1]
            radius = scaled(section.fillet, 1e3)
            low, high = min(d, other), max(d, other)
            made.append(
                Detail(
                    stretch.end,
                    f"fillet at {stretch.end:.4g} mm",
                    low,
                    "shoulder",
                    scaled(small.roughness, 1e6),
                    largest,
                    high,
                    radius,
                )
            )
    return tuple(made), tuple(notes)
