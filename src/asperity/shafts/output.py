"""Shafts as JSON, as tables and as the arrays that are drawn."""

import math
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

import numpy as np

from asperity.results.table import Column, Table
from asperity.results.words import Number, Sentence, text_of
from asperity.shafts.shaft import ShaftFound
from asperity.shafts.verdict_rows import NAMES

Study = Any
"""A `asperity.shafts.result.ShaftStudy`, whose module imports this one."""

_ENDS = ("A", "B")
_BETWEEN = 12
_LOAD, _OIL = ("radial_N", "axial_N"), ("kappa", "a_ISO", "Lnmh_h")
_OF_SECTION = (
    "diameter_mm", "bending_moment_Nm", "torque_Nm", "sigma_v_MPa", "S_D_case_1", "S_D_case_2",
    "S_F", "n_goodman", "n_gerber",
)  # fmt: skip
_OF_ALL = (
    "F_r and F_a are those of the load with the greatest equivalent load, P is the mean of all "
    "loads that gives the same life, s_0 the least of all"
)


def shaft_json(found: ShaftFound) -> dict[str, Any]:
    """Return a shaft by key: its bearings by case, and its sections."""
    model = found.model
    return {
        "length_mm": model.length,
        "cases": {
            condition.key: {
                "axial_N": each.carried.axial,
                "torque_Nm": 1e-3 * each.carried.torque,
                "deflection_um": each.at_mesh[0],
                "deflection_with_shear_um": each.at_mesh[1],
                "mesh_shift_y_um": each.mesh_shift[0],
                "mesh_shift_z_um": each.mesh_shift[1],
                "bearings": [
                    {
                        "y_N": across[0],
                        "z_N": across[1],
                        "radial_N": math.hypot(*across),
                        "axial_N": axial,
                    }
                    for across, axial in zip(
                        (each.carried.first, each.carried.second), each.axial.loads, strict=True
                    )
                ],
            }
            for condition, each in zip(found.cases, found.hardest, strict=True)
        },
        "bearings": [
            {
                "at_mm": at,
                "bearing": place.bearing.name if place.bearing is not None else None,
                "arrangement": place.arrangement,
                "cases": None
                if lives is None
                else {
                    condition.key: {
                        "radial_N": life.radial,
                        "axial_N": life.axial,
                        "P_N": life.equivalent,
                        "L10h_h": life.rating_life,
                        "Lnmh_h": life.modified,
                        "kappa": life.kappa,
                        "a_ISO": life.a_iso,
                        "static_safety": life.static_safety,
                        "damage": list(life.damage),
                    }
                    for condition, life in lives.items()
                },
            }
            for at, place, lives in zip(model.bearings, model.places, found.lives, strict=True)
        ],
        "sections": [
            {
                "name": each.detail.name,
                "at_mm": each.detail.at,
                "diameter_mm": each.detail.diameter,
                "case": each.condition.key,
                "load": each.load + 1,
                "bending_moment_Nm": each.actions.bending,
                "torque_Nm": each.actions.torque,
                "axial_N": each.actions.axial,
                "sigma_b_MPa": each.judged.bending,
                "sigma_zd_MPa": each.judged.axial,
                "tau_t_MPa": each.judged.torsion,
                "sigma_v_MPa": each.judged.mises,
                "S_D_case_1": _known(each.judged.fatigue_1),
                "S_D_case_2": _known(each.judged.fatigue_2),
                "S_F": _known(each.judged.yielding),
                "n_goodman": _known(each.judged.goodman),
                "n_gerber": _known(each.judged.gerber),
            }
            for each in found.sections
        ],
    }


def tables(study: Study) -> tuple[Table, ...]:
    """Return what a person reads: what is asked, reactions, lives, sections."""
    made = []
    if study.rows:
        rows = [
            (
                row.name, row.standard,
                _shown(row.value, f"rows.{place}.{'life_h' if row.unit else 'safety'}", row.unit),
                _shown(row.asked, f"rows.{place}.asked{'_h' if row.unit else ''}", row.unit),
                "" if row.holds else "FAILS", row.by,
            )
            for place, row in enumerate(study.rows)
        ]  # fmt: skip
        columns = (
            Column(""), Column("standard"), Column("is", right=True),
            Column("asked", right=True), Column(""), Column("by", folds=True),
        )  # fmt: skip
        made.append(Table(columns, tuple(rows), "Shafts and bearings"))
    for key, found in study.found.items():
        made += _of_shaft(key, found)
    if study.worm_deflection is not None:
        made.append(_deflection(study))
    if study.notes:
        made.append(Table((), (), remarks=study.notes))
    return tuple(made)


def _of_shaft(key: str, found: ShaftFound) -> Iterator[Table]:
    name, told = NAMES[key], shaft_json(found)
    reactions = [
        (
            condition.text,
            *(
                text
                for n, bearing in enumerate(case["bearings"])
                for text in _keyed(f"{key}.cases.{condition.key}.bearings.{n}", bearing, _LOAD)
            ),
            *_keyed(f"{key}.cases.{condition.key}", case, ("deflection_um",)),
        )
        for condition, case in zip(found.cases, told["cases"].values(), strict=True)
    ]
    a, b = found.model.bearings
    yield Table.of(
        ("", "F_r,A (N)", "F_a,A (N)", "F_r,B (N)", "F_a,B (N)", "v at the mesh (um)"),
        reactions,
        title=f"Loads of the {name}'s bearings, A at {a:.4g} mm and B at {b:.4g} mm, at "
        f"{max(each.load.torque for each in found.hardest):.4g} N m",
    )
    every = [life for own in found.lives for life in (own or {}).values()]
    oiled = bool(every) and every[0].modified is not None
    keys = (*_LOAD, "P_N", "L10h_h", *(_OIL if oiled else ()), "static_safety")
    lives = [
        (
            f"{end} {own['bearing'] or ''}, {condition.text}",
            *_keyed(f"{key}.bearings.{n}.cases.{condition.key}", own["cases"][condition.key], keys),
        )
        for n, (end, own) in enumerate(zip(_ENDS, told["bearings"], strict=True))
        for condition in found.lives[n] or {}
    ]
    if lives:
        oil = ("kappa", "a_ISO", "L_nmh (h)") if oiled else ()
        yield Table.of(
            ("", "F_r (N)", "F_a (N)", "P (N)", "L_10h (h)", *oil, "s_0"),
            lives,
            title=f"Lives of the {name}'s bearings (ISO 281, ISO 76)",
            remarks=[_OF_ALL] if any(len(life.damage) > 1 for life in every) else [],
        )
    sections = [
        (each["name"], *_keyed(f"{key}.sections.{n}", each, _OF_SECTION))
        for n, each in enumerate(told["sections"])
    ]
    if sections:
        steel = found.model.table.material
        assert steel is not None
        yield Table.of(
            ("", "d (mm)", "M (N m)", "T (N m)", "sigma_v (MPa)", "S_D,1", "S_D,2", "S_F",
             "Goodman", "Gerber"),
            sections,
            title=f"Strength of the {name}'s shaft of {steel.name} (DIN 743; distortion energy), "
            "each section in its worst case",
        )  # fmt: skip


def _deflection(study: Study) -> Table:
    return Table.of(
        ("", "deflection (um)"),
        [
            (name, text_of(value, key=key))
            for name, key, value in (
                (
                    "as a beam of its sections, bending",
                    "worm_deflection_um",
                    study.worm_deflection,
                ),
                (
                    "with shear",
                    "worm_deflection_with_shear_um",
                    study.worm_deflection_with_shear,
                ),
                ("by the formula of ISO/TR 14521", "iso_deflection_um", study.iso_deflection),
                ("may be, by ISO/TR 14521", "deflection_limit_um", study.deflection_limit),
            )
        ],
        title="Deflection of the worm at the mesh, in the worst case",
    )


def _keyed(path: str, told: Mapping[str, Any], keys: Iterable[str]) -> list[str]:
    """Return some numbers of an object of JSON, which know where they stand in it."""
    return [text_of(told[key], key=f"{path}.{key}") for key in keys]


def _shown(value: float, key: str, unit: str) -> str:
    """Return what there is, or is asked, to three digits with its unit."""
    if not math.isfinite(value):
        return f"- {unit}".strip()
    number = Number(text_of(_short(value)), value, key)
    return Sentence(number, " ", unit) if unit else number


def courses(found: Mapping[str, ShaftFound]) -> dict[str, Any]:
    """Return what runs along each shaft in the case that bends it most, as dataset variables."""
    made: dict[str, Any] = {}
    for key, shaft in found.items():
        name, worst = NAMES[key], shaft.worst
        m, v = worst.moments(_BETWEEN), worst.deflection(_BETWEEN)
        along, at = f"{name}_position", np.repeat(m.at, 2)
        bending = 1e-3 * m.bending.reshape(-1, 2)

        def put(
            what: str, dims: Any, values: Any, unit: str, meaning: str, name: str = name
        ) -> None:
            made[f"{name}_{what}"] = (dims, values, {"units": unit, "long_name": meaning})

        put("at", along, at, "mm", "position, each twice: before and behind")
        put("moment", (along, "across"), bending, "N m", "bending moment by y and z")
        put("torque", along, 1e-3 * m.torque.reshape(-1), "N m", "torque")
        put("place", f"{name}_place", v.at, "mm", "position of the deflection")
        bent = 1e3 * (v.bent + v.sheared)
        put("deflection", (f"{name}_place", "across"), bent, "um", "deflection by y and z")
        outline = np.array([(s.start, s.end) for s in shaft.model.stretches])
        put("stretch", (f"{name}_section", "end"), outline, "mm", "start and end of a section")
        put("diameter", f"{name}_section", np.array(shaft.model.drawn), "mm", "diameter drawn")
        threads = np.array([s.diameter is None for s in shaft.model.table.section])
        put("threads", f"{name}_section", threads, "", "whether it is the worm's threads")
        bearings = np.array(shaft.model.bearings)
        put("bearing", f"{name}_bearing", bearings, "mm", "position of a bearing")
        across = np.array([worst.carried.first, worst.carried.second])
        put("reaction", (f"{name}_bearing", "across"), across, "N", "load of a bearing by y and z")
        axial = np.array(worst.axial.forces)
        put("axial", f"{name}_bearing", axial, "N", "axial load of a bearing along x")
        size = np.array(
            [
                (1e3 * p.bearing.outside_diameter, 1e3 * p.bearing.width * (2 if p.pair else 1))
                if p.bearing
                else (np.nan, np.nan)
                for p in shaft.model.places
            ]
        )
        put("bearing_size", (f"{name}_bearing", "end"), size, "mm", "D and width of a bearing")
        loads = np.array([each.at for each in worst.loads])
        forces = np.array([each.force for each in worst.loads])
        put("load", f"{name}_load", loads, "mm", "position of a load, that of the teeth first")
        put("force", (f"{name}_load", "axis"), forces, "N", "load by x, y and z")
        put("case", (), worst.condition.text, "", "case that is drawn")
    return made


def _short(value: float) -> float:
    if not math.isfinite(value):
        return math.nan
    return float(f"{value:.3g}")


def _known(value: float) -> float | None:
    return value if math.isfinite(value) else None
