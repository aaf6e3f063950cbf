"""What is found of the flanks of a worm gearset."""

import functools
import math
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

from asperity.errors import AsperityError
from asperity.files.store import write_text
from asperity.flanks.export.assembly import Assembly
from asperity.flanks.export.turned import Beside, Bodies, blanks_of, shaft_sizes
from asperity.flanks.measuring.drawing import Datum, csv_of, drawing_data
from asperity.flanks.measuring.measures import Measuring
from asperity.flanks.meshing.analysis import LABELS, Analysis
from asperity.flanks.meshing.lubrication import LoadedNumbers
from asperity.flanks.study.meshed import ToothMesh
from asperity.flanks.study.toleranced import Toleranced
from asperity.flanks.wheel.enveloped import Wheel
from asperity.flanks.wheel.flank import RESOLVED
from asperity.gearset import Geometry
from asperity.gearset.answer import Drawn
from asperity.gearset.blanks import wheel_sizes
from asperity.results import Quantities, labelled, part, quantity
from asperity.results.dataset import to_dataset
from asperity.results.quantity import Entry
from asperity.results.table import Column, Table, table_of
from asperity.results.words import Number, text_of

if TYPE_CHECKING:
    import xarray as xr

    from asperity.flanks.export.cad.solids import Solids
    from asperity.gearset.answer import Views
    from asperity.results.report import Picture

_DRAWING = "drawing.csv"
_PLOTS = "asperity.flanks.study.plots"
_DIRECTIONS = {
    "axial": "worm along its axis",
    "torsional": "worm about its axis",
    "wheel_axial": "wheel along its axis",
    "screw": "worm along its lead",
}
# What is shown of the load: the worst over a pitch.
_WORST = {
    "loaded_teeth": min,
    "line_load_max": max,
    "hertz_pressure_max": max,
    "film_mean": min,
    "film_min": min,
    "sliding_speed_mean": max,
}


class FlankStudy(Drawn):
    """The flanks of a worm gearset: how they were made, how they touch, and a mesh.

    Attributes
    ----------
    name : str
        Of the gearset.
    mesh : ToothMesh
        A tooth of the wheel.
    wheel : Wheel
        The wheel as it is cut, with the pair it belongs to; the worm's threads are as thick as the
        backlash asks for.
    assumed, from_memory : mapping of str to str
        What was not given, and what no document at hand confirms.
    measuring : Measuring
        What worm and wheel measure.
    assembly : Assembly
        How both stand in mesh in the files.
    step : bool
        Whether the files hold tooth, worm, wheel and both in mesh as STEP.
    dxf : bool
        Whether they hold a drawing as DXF.
    beside : Blanks or Bodies, optional
        What wheel and worm are beside their teeth.
    toleranced : Toleranced, optional
        What the tolerances come to, where there are any.
    """

    title: ClassVar[str] = "worm gearset"
    stem: ClassVar[str] = "flank"
    drawings: ClassVar[Mapping[str, str]] = {
        "pattern": f"{_PLOTS}:pattern",
        "ease-off": f"{_PLOTS}:ease_off",
        "contact-lines": f"{_PLOTS}:contact_lines",
        "transmission-error": f"{_PLOTS}:transmission_error",
        "vibration": f"{_PLOTS}:vibration",
    }
    captions: ClassVar[Mapping[str, str]] = {
        "pattern": "Where the marking compound is squeezed out: bare where the gap is least.",
        "ease-off": "How much less material the wheel has than one cut by an identical hob.",
        "contact-lines": "Lines in touch by angle of the worm; a pitch apart they touch at once.",
        "transmission-error": "How far the wheel is ahead of an even turn.",
        "vibration": "Parts of a vibration's velocity on the flank s = +1.",
    }
    labels = LABELS

    name: str
    wheel: Wheel
    analysis: Analysis = part(Analysis)
    mesh: ToothMesh
    assumed: Mapping[str, str]
    from_memory: Mapping[str, str]
    measuring: Measuring
    assembly: Assembly
    step: bool = False
    dxf: bool = False
    beside: Beside = None
    toleranced: Toleranced | None = None
    seconds: float = quantity("", "s", "time it took", key="seconds", only="json", shown=False)

    @property
    def geometry(self) -> Geometry:
        """What follows from the gearset's numbers."""
        return self.analysis.pair.geometry

    @property
    def hand(self) -> str:
        """Of the worm."""
        return self.wheel.pair.hand

    def both_views(self) -> "Views":
        """Return both views of it, with the shafts of the case."""
        own = self.beside if isinstance(self.beside, Bodies) else Bodies()
        return own.both_views(self.geometry, self.hand) or super().both_views()

    @property
    @labelled(
        "j_n", "mm", "backlash, normal, least over a pitch",
        key="backlash_normal_mm", variable="backlash_normal_least",
    )  # fmt: skip
    def backlash(self) -> float:
        """Least play normal to the flanks, mm."""
        return min(self.analysis.play.normal.values())

    @property
    @labelled("", "mm", "pitch radius of the wheel", shown=False)
    def pitch_radius(self) -> float:
        """Pitch radius of the wheel, mm."""
        return self.analysis.pair.geometry.wheel_mean_diameter / 2.0

    @property
    @labelled("", "mm2", "area of a flank of the wheel")
    def flank_area(self) -> float:
        """Area of the trimmed flank, mm^2."""
        return self.wheel.flank(1).area()

    @property
    @labelled("", "rad", "angle of the worm from tooth to tooth", only="file", shown=False)
    def pitch(self) -> float:
        """Angle of the worm from one tooth to the next, rad."""
        return 2.0 * math.pi / self.analysis.pair.geometry.starts

    @property
    def sizes(self) -> dict[str, Any]:
        """Sizes of wheel and worm beside their teeth, mm, and which of them were assumed."""
        pair = self.assembly.pair
        blanks = blanks_of(self.beside)
        sizes = wheel_sizes(pair.geometry, blanks)
        if not (isinstance(self.beside, Bodies) and self.beside.worm is not None):
            # Else the shaft is that of its own table.
            sizes |= shaft_sizes(pair, blanks)
        given = blanks.model_fields_set if blanks is not None else set()
        return {f"{key}_mm": size for key, size in sizes.items()} | {
            "assumed": [key for key in sizes if key not in given]
        }

    @functools.cached_property
    def solids(self) -> "Solids | None":
        """Tooth, worm and wheel as the STEP files hold them, where they are asked for."""
        if not self.step:
            return None
        from asperity.flanks.export.cad.solids import Solids

        return Solids.of(self.wheel, self.assembly, self.beside)

    @property
    def failure(self) -> AsperityError | None:
        """Which STEP files cannot be written, and why."""
        return None if self.solids is None else self.solids.failure

    @property
    def drawing(self) -> list[Datum]:
        """The data of worm and wheel that stand on their drawings."""
        off = self.toleranced
        if off is None:
            return drawing_data(self.wheel.pair, self.measuring)
        return drawing_data(self.wheel.pair, self.measuring, off.graded, off.backlash)

    def resolution(self, name: str) -> float:
        """Return the size below which a quantity is rounding and shown as zero, in its unit."""
        return RESOLVED if name == "backlash" else 0.0

    def to_json(self) -> dict[str, Any]:
        """Return the numbers by name and unit: those of the flank s = +1, and both in ``flanks``.

        ``base_radius_mm`` and ``base_lead_angle_deg`` are None for flanks without a base cylinder.
        """
        pair = self.analysis.pair
        return {
            "name": self.name,
            "flank": pair.flank,
            "hand": pair.hand,
            **self.analysis.to_json(),
            **super().to_json(),
            "hob": {
                "pitch_diameter_mm": 2.0 * pair.hob.pitch_radius,
                "lead_angle_deg": math.degrees(pair.hob.lead_angle),
                "tip_rounding_mm": pair.hob.tip_rounding,
                "centre_distance_mm": pair.cutting.centre_distance,
                "tilt_deg": math.degrees(pair.cutting.tilt),
            },
            "worm": {
                "tip_rounding_mm": pair.worm.tip_rounding,
                "thread_thickness_mm": 2.0 * (pair.worm.half_pitch - pair.worm.half_space),
            },
            "measuring": self.measuring.to_json()
            | {"drawing": [datum._asdict() for datum in self.drawing]},
            "blank": self.sizes,
            "mesh": self.mesh.to_json(),
            "assumed": dict(self.assumed),
            "from_memory": dict(self.from_memory),
            **({} if self.toleranced is None else {"tolerances": self.toleranced.to_json()}),
        }

    def to_dataset(self) -> "xr.Dataset":
        """Return maps and curves of both flanks by ``side``, and the scalars; lengths in mm.

        Velocities are those at the worm's speed of the attribute ``worm_speed_rad_per_s``. All is
        in the gearset's own frame: that of a left-handed one is the mirror image of what was
        computed.
        """
        import xarray as xr

        pair, flanks = self.analysis.pair, self.analysis.flanks
        parts = [flank.to_dataset().drop_attrs(deep=False) for flank in flanks.values()]
        whole = xr.concat(parts, "side", combine_attrs="override")
        side = xr.Variable("side", list(flanks), {"units": "1", "long_name": "flank s"})
        attributes = {
            "notes": "; ".join(self.notes),
            "flank": pair.flank,
            "hand": pair.hand,
            "worm_speed_rad_per_s": flanks[1].motion.worm_speed,
        }
        numbers = to_dataset(self, {}, attributes, title=f"flanks of {self.heading()}")
        made = whole.assign_coords(side=side).merge(numbers).assign_attrs(numbers.attrs)
        return made if self.toleranced is None else self.toleranced.added(made)

    def heading(self) -> str:
        """Return what it is of."""
        return self.name or self.title

    def keyed(self) -> Iterator[tuple[str, Entry]]:
        """Yield the numbers of JSON, those of both flanks under their side."""
        yield from super().keyed()
        for side, flank in self.analysis.flanks.items():
            for key, entry in flank.keyed():
                yield f"flanks.{side:+d}.{key}", entry

    def attached(self) -> dict[str, bytes]:
        """Return the file that the gearset is drawn from in space."""
        from asperity.flanks.export.space.packed import drawn_from

        parts = self.wheel, self.analysis, self.assembly, self.beside
        return {"flanks.bin": drawn_from(self.heading(), *parts)}

    def tables(self) -> tuple[Table, ...]:
        """Return tables of gearset, flanks, load, vibrations and mesh, and the notes."""
        pair, flanks = self.analysis.pair, self.analysis.flanks
        parts = list(flanks[1].vibration["axial"])
        vibration = [
            (
                _DIRECTIONS[direction],
                *(_share(value, f"{direction}.{name}") for name, value in by_part.items()),
            )
            for direction, by_part in flanks[1].vibration.items()
        ]
        loaded = [flank.loaded for flank in flanks.values()]
        return (
            table_of(self, title=f"{pair.flank}, {pair.hand} hand"),
            _by_side("flank", map(_texts, flanks, flanks.values())),
            *(
                [_by_side("under load, worst over a pitch", map(_worst, flanks, loaded))]
                if all(loaded)
                else []
            ),
            Table.of(("part of a vibration, s = +1", *parts), vibration),
            self.measuring.table(),
            *(() if self.toleranced is None else self.toleranced.tables()),
            table_of(
                self.mesh,
                title=f"mesh of a tooth, {self.mesh.density}",
                remarks=self._remarks(),
                within="mesh",
            ),
        )

    def _remarks(self) -> Iterator[str]:
        yield from self.notes
        if abs(self.backlash) <= RESOLVED:
            yield "there is no backlash, since none is asked for: give mount.backlash for play"
        for words, group in (
            ("from memory, check before use", self.from_memory),
            ("assumed, give them to replace the defaults", self.assumed),
        ):
            if group:
                listed = "; ".join(f"{key} ({text})" for key, text in group.items())
                yield f"{words}: {listed}"

    def pictures(self, folder: Path | None = None) -> "tuple[Picture, ...]":
        """Return its pictures for a page, first of them the gearset as it turns."""
        from asperity.flanks.export.files import GEARSET, TURNING
        from asperity.results.report import Picture

        others = super().pictures(folder)
        path = None if folder is None else folder / TURNING
        if path is None or not path.is_file():
            return others
        said = "It turns on by a pitch. From all sides, in any viewer of GLB:"
        return Picture("In mesh", caption=said, moving=path, beside=GEARSET), *others

    def write(self, folder: Path, *, pictures: str = "png") -> list[str]:
        """Write numbers, pictures, meshes and bodies to a folder that exists; return names."""
        from asperity.flanks.export.files import write_bodies

        names = super().write(folder, pictures=pictures)
        write_text(folder / _DRAWING, csv_of(self.drawing))
        return [
            *names,
            _DRAWING,
            *self._drawn(folder),
            *write_bodies(
                self.wheel,
                self.mesh.hexahedra,
                self.assembly,
                folder,
                beside=self.beside,
                name=self.heading(),
                solids=self.solids,
            ),
        ]

    def _drawn(self, folder: Path) -> tuple[str, ...]:
        if not self.dxf:
            return ()
        from asperity.flanks.export.cad.dxf import write_dxf

        off = self.toleranced
        deviation = 0.0 if off is None else off.backlash.allowances.centre_distance
        pair, name = self.wheel.pair, self.heading()
        return (
            write_dxf(
                folder, pair, self.drawing, beside=self.beside, deviation=deviation, name=name
            ),
        )


def _texts(side: int, answer: Quantities) -> dict[tuple[str, str], str]:
    """What is shown of a flank by meaning and unit."""
    return {
        (entry.label.meaning, entry.label.unit): text_of(
            entry.value, entry.resolution, f"flanks.{side:+d}.{entry.key}"
        )
        for entry in answer.entries()
        if entry.label.shown and not entry.label.dims
    }


def _worst(side: int, loaded: tuple[Any, ...]) -> dict[tuple[str, str], str]:
    known = {entry.name: entry for entry in LoadedNumbers.declared()}
    shown = {}
    for name, choose in _WORST.items():
        values = [getattr(lines.numbers, name) for lines in loaded]
        worst, entry = choose(values), known[name]
        key = f"flanks.{side:+d}.loaded.{values.index(worst)}.{entry.key}"
        shown[entry.label.meaning, entry.label.unit] = text_of(worst, key=key)
    return shown


def _by_side(title: str, sides: Iterator[dict[tuple[str, str], str]]) -> Table:
    plus, minus = sides
    rows = tuple((name, text, minus[name, unit], unit) for (name, unit), text in plus.items())
    columns = (
        Column(title),
        *(Column(f"s = {s}", right=True) for s in ("+1", "-1")),
        Column("unit"),
    )
    return Table(columns, rows)


def _share(value: float, name: str) -> str:
    return "0" if value < RESOLVED else Number(f"{value:.3f}", value, f"vibration.{name}")
