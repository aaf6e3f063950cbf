"""What the shafts of a gearset and their bearings come to."""

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, ClassVar

from asperity.gearset.answer import Drawn
from asperity.results import quantity
from asperity.results.table import Table
from asperity.shafts.loads import Load
from asperity.shafts.shaft import LoadedShaft

if TYPE_CHECKING:
    from pathlib import Path

    import xarray as xr

    from asperity.gearset.answer import Views
    from asperity.gearset.blanks import Blanks
    from asperity.gearset.geometry import Geometry
    from asperity.rating.inputs import Inputs, Values
    from asperity.rating.verdict_rows import Row
    from asperity.results.formula_sheets import Cells


class ShaftStudy(Drawn):
    """Shafts and bearings of a worm gearset.

    Attributes
    ----------
    name : str
        Of the gearset.
    found : mapping of str to LoadedShaft
        By ``worm_shaft`` and ``wheel_shaft``, those that are given.
    loads : tuple of Load
        Of the life.
    life : float
        That the bearings must reach, h.
    rating_inputs : Inputs, optional
        The gearset that they belong to.
    blanks : Blanks, optional
        What the wheel is beside its teeth, for drawings.
    """

    title: ClassVar[str] = "Shafts and bearings"
    stem: ClassVar[str] = "shafts"
    drawings: ClassVar[Mapping[str, str]] = {"shafts": "asperity.shafts.plots:plot_shafts"}
    captions: ClassVar[Mapping[str, str]] = {
        "shafts": "Each shaft to scale with its bearings and what they carry, bending moment and "
        "torque, and deflection, in the case that bends it most."
    }

    name: str
    found: Mapping[str, LoadedShaft]
    loads: tuple[Load, ...]
    life: float = quantity("", "h", "life that the bearings must reach", key="asked_life_h")
    worm_deflection: float | None = quantity(
        "v_1", "um", "deflection of the worm at the mesh by bending", optional=True
    )
    worm_deflection_with_shear: float | None = quantity(
        "", "um", "the same with shear", optional=True
    )
    iso_deflection: float | None = quantity(
        "delta_m", "um", "deflection of the worm by the formula of ISO/TR 14521", optional=True
    )
    deflection_limit: float | None = quantity(
        "delta_lim", "um", "deflection that may be, by ISO/TR 14521", optional=True
    )
    least_life: float | None = quantity(
        "L_h", "h", "life of the weakest bearing", key="least_life_h", optional=True
    )
    least_static_safety: float | None = quantity(
        "s_0", "", "static safety of the weakest bearing", optional=True
    )
    least_fatigue_safety: float | None = quantity(
        "S_D", "", "fatigue safety of the weakest section by DIN 743, case 2", optional=True
    )
    least_yield_safety: float | None = quantity(
        "S_F", "", "yield safety of the weakest section by DIN 743", optional=True
    )

    rating_inputs: "Inputs | None" = None
    blanks: "Blanks | None" = None

    @classmethod
    def of(
        cls,
        inputs: "Inputs",
        shafts: Mapping[str, LoadedShaft],
        loads: tuple[Load, ...],
        life: float,
        iso: tuple[float, float] | None,
        blanks: "Blanks | None" = None,
    ) -> "ShaftStudy":
        """Return the answer of shafts that are found; ISO's deflection and limit in mm.

        Parameters
        ----------
        inputs : Inputs
            The gearset and its operation.
        shafts : mapping of str to LoadedShaft
            By ``worm_shaft`` and ``wheel_shaft``.
        loads : tuple of Load
            That they carry.
        life : float
            Required of the bearings, h.
        iso : tuple of float or None
            Deflection by ISO/TR 14521 and its limit, mm.
        blanks : Blanks, optional
            What the wheel is beside its teeth, for drawings.

        Returns
        -------
        ShaftStudy
            With the least of each safety and life.
        """
        lives = [
            each for shaft in shafts.values() for own in shaft.lives if own for each in own.values()
        ]
        sections = [each.judged for shaft in shafts.values() for each in shaft.sections]
        worm = shafts.get("worm_shaft")
        bent = None if worm is None else worm.worst.at_mesh
        notes = [note for shaft in shafts.values() for note in shaft.model.notes]
        if worm is not None and worm.model.overhang:
            notes.append(
                f"the worm overhangs, its mesh {worm.model.overhang}: ISO/TR 14521 has no "
                "deflection of such a worm, its limit is taken"
            )
        if (factor := inputs.operation.application_factor) != 1.0:
            notes.append(
                f"forces of the teeth are those under K_A = {factor:g} times the torque, as in "
                "ISO/TR 14521: lives, strength, static safety and deflection have it"
            )
        for key, shaft in shafts.items():
            if shaft.model.table.material is None:
                notes.append(f"{key}.material is not given: its strength is not judged")
            elif not shaft.model.details:
                notes.append(f"{key} has no fillet and no notch: its strength is not judged")
            if any(own is None for own in shaft.lives):
                notes.append(f"{key}: a bearing without a name has loads and no life")
            if any(each.outside for own in shaft.lives if own for each in own.values()):
                notes.append(
                    f"{key}: f_0 F_a/C_0 of a deep groove bearing is above 6.89, where its table "
                    "ends; the last row is taken"
                )
            if any(each.detail.kind == "threads" for each in shaft.sections):
                table = shaft.model.table
                if "thread_notch_bending" not in table.model_fields_set:
                    notes.append(
                        f"the root of the threads is judged with notch factors of "
                        f"{table.thread_notch_bending:g} and {table.thread_notch_torsion:g}, which "
                        f"are assumed: no open standard has any; else give "
                        f"{key}.thread_notch_bending and thread_notch_torsion"
                    )
        return cls(
            name=inputs.gearset.name,
            rating_inputs=inputs,
            blanks=blanks,
            found=shafts,
            loads=loads,
            life=life,
            worm_deflection=None if bent is None else bent[0],
            worm_deflection_with_shear=None if bent is None else bent[1],
            iso_deflection=(
                None if iso is None or worm is None or worm.model.overhang else 1e3 * iso[0]
            ),
            deflection_limit=None if iso is None or worm is None else 1e3 * iso[1],
            least_life=min((each.judged_hours for each in lives), default=None),
            least_static_safety=min((each.static_safety for each in lives), default=None),
            least_fatigue_safety=_finite(min((e.fatigue_2 for e in sections), default=None)),
            least_yield_safety=_finite(min((e.yielding for e in sections), default=None)),
            notes=tuple(notes),
        )

    @property
    def rows(self) -> "tuple[Row, ...]":
        """What each part comes to of what is asked."""
        from asperity.shafts.verdict_rows import rows_of

        return rows_of(self)

    @property
    def lacking(self) -> tuple[str, ...]:
        """What is not given and so not judged, in a line; nothing where all is."""
        names = {"worm_shaft": "worm shaft", "wheel_shaft": "wheel shaft"}
        lacks = [name for key, name in names.items() if key not in self.found]
        for key, shaft in self.found.items():
            if any(place.bearing is None for place in shaft.model.places):
                lacks.append(f"bearings of the {names[key]}")
            if shaft.model.table.material is None:
                lacks.append(f"steel of the {names[key]}")
        if any(shaft.options.contamination is None for shaft in self.found.values()):
            lacks.append("oil's cleanness")
        return (f"not given: {', '.join(lacks)}",) if lacks else ()

    @property
    def holds(self) -> bool:
        """Whether everything does."""
        return all(row.holds for row in self.rows)

    @property
    def application_factor(self) -> float:
        """K_A, which the forces of the teeth have."""
        return (
            1.0 if self.rating_inputs is None else self.rating_inputs.operation.application_factor
        )

    @property
    def geometry(self) -> "Geometry":
        """What follows from the gearset's numbers."""
        assert self.rating_inputs is not None
        return self.rating_inputs.gearset.geometry

    @property
    def hand(self) -> str:
        """Of the worm."""
        assert self.rating_inputs is not None
        return self.rating_inputs.gearset.hand

    def both_views(self) -> "Views":
        """Return both views of the gearset with its shafts, each as SVG with its caption.

        Returns
        -------
        along, through : tuple of str
            Along the wheel's axis, and through it.
        """
        from asperity.shafts.drawing import views_of
        from asperity.shafts.shape import shape_of

        worm, wheel = (
            shape_of(self.found[key].model.table, self.geometry) if key in self.found else None
            for key in ("worm_shaft", "wheel_shaft")
        )
        return views_of(self.geometry, self.hand, worm, wheel, self.blanks)

    def sheets(
        self, cells: "Cells", inputs: "Inputs", iso: "Values"
    ) -> Mapping[str, list[tuple[Any, ...]]]:
        """Return the rows of a sheet for each shaft, its numbers found from traced inputs.

        Parameters
        ----------
        cells : Cells
            Of the workbook.
        inputs : Inputs
            The gearset and its operation, whose numbers may be cells.
        iso : mapping of str to object
            What ISO/TR 14521 finds from them.

        Returns
        -------
        mapping of str to list of tuple
            By the name of the sheet.
        """
        from asperity.shafts.workbook import sheets_of

        options = next(iter(self.found.values())).options
        return sheets_of(self.found, self.loads, inputs, options, cells, iso)

    def heading(self) -> str:
        """Return the gearset's name."""
        return self.name or "worm gearset"

    def headline(self) -> tuple[str, ...]:
        """Return whether all holds, and what fails."""
        failing = [row.name for row in self.rows if not row.holds]
        if not self.rows:
            return ("nothing is judged: give bearings by name, and a material",)
        if failing:
            return (f"does not hold: {', '.join(failing)}",)
        return ("shafts and bearings hold",)

    def to_json(self) -> dict[str, Any]:
        """Return everything by key; the units are part of the keys."""
        from asperity.shafts.output import shaft_json

        return {
            "name": self.name,
            **super().to_json(),
            "holds": self.holds,
            "rows": [row.to_json() for row in self.rows],
            "loads": [
                {
                    "hours_h": load.hours,
                    "output_torque_Nm": load.torque,
                    "worm_speed_rpm": load.speed,
                }
                for load in self.loads
            ],
            **{
                key: shaft_json(self.found[key]) if key in self.found else None
                for key in ("worm_shaft", "wheel_shaft")
            },
        }

    def tables(self) -> tuple[Table, ...]:
        """Return what a person reads."""
        from asperity.shafts.output import tables

        return tables(self)

    def write(self, folder: "Path", *, pictures: str = "png") -> list[str]:
        """Write JSON, netCDF, the picture, and for spreadsheets live formulas."""
        from asperity.shafts.workbook import write_shafts

        names = super().write(folder, pictures=pictures)
        assert self.rating_inputs is not None
        options = next(iter(self.found.values())).options
        file = write_shafts(
            self.found, self.loads, self.rating_inputs, options, folder / "shafts.xlsx"
        )
        return names if file is None else [*names, file.name]

    def to_dataset(self) -> "xr.Dataset":
        """Return what JSON holds, and the course of what is in each shaft in its worst case."""
        from asperity.results.nested import with_parts
        from asperity.shafts.output import courses

        along = courses(self.found)
        own = {entry.key for entry in self.entries() if entry.variable not in along}
        parts = {key: part for key, part in self.to_json().items() if key not in own | {"notes"}}
        return with_parts(super().to_dataset().assign(along), parts, over=("cases",))


def _finite(value: float | None) -> float | None:
    return value if value is not None and math.isfinite(value) else None
