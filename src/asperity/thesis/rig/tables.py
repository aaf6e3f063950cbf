"""Tables 6.1, 6.3, 6.8 and 6.10: what survives of the rig's tables, and what follows from it."""

import numpy as np

from asperity.thesis.exhibits import table
from asperity.thesis.products import Cell, Grid
from asperity.thesis.rig import measured as m
from asperity.thesis.rig.readings import friction, velocities
from asperity.thesis.rig.rig import pair

_DISCS = "asperity.tribometer.discs, on rig-preliminary"
_CROSSED, _TICKED = "left out", "tested"


@table("6.1")
def _roughness() -> Grid:
    rows = [
        (disc, place, *readings, float(np.mean(readings)), float(values.mean()))
        for disc, values in m.ROUGHNESS.items()
        for place, readings in enumerate(values.tolist(), start=1)
    ]
    columns = ("disc", "place", "Ra 1", "Ra 2", "Ra 3", "mean of place", "mean of disc")
    return Grid(columns, tuple(rows), ("the mean of three and of nine readings",))


@table("6.3")
def _dry_runs() -> Grid:
    sliding, rolling, ratio = velocities()
    loads = m.LOADS_LB * m.POUND_FORCE
    mu = ["", *friction(loads).tolist()]
    return Grid.of(
        range(m.LOADS_LB.size),
        {
            "F_N, lb": lambda row: float(m.LOADS_LB[row]),
            "printed, N": lambda row: float(m.PRINTED_LOADS[row]),
            "F_N, N": lambda row: float(loads[row]),
            "S_s, rpm": lambda row: float(m.STEEL_RPM[row]),
            "i_ms, A": lambda row: float(m.STEEL_CURRENT[row]),
            "S_a, rpm": lambda row: float(m.BRONZE_RPM[row]),
            "i_ma, A": lambda row: float(m.BRONZE_CURRENT[row]),
            "v_sl printed, mm/s": lambda row: float(m.PRINTED_SLIDING[row]),
            "v_sl, mm/s": lambda row: float(1e3 * sliding[row]),
            "v_ro printed, mm/s": lambda row: float(m.PRINTED_ROLLING[row]),
            "v_ro, mm/s": lambda row: float(1e3 * rolling[row]),
            "R printed": lambda row: float(m.PRINTED_RATIO[row]),
            "R": lambda row: float(ratio[row]),
            "mu": lambda row: mu[row],
        },
        _DISCS,
    )


@table("6.8")
def _hertz() -> Grid:
    rig = pair()
    stated, chosen, follows = "stated", "chosen to give p_max", "follows"
    rows: list[tuple[Cell, ...]] = [
        ("m_r", "platform", "kg", m.PLATFORM, rig.rig.platform_mass, stated),
        ("m_w", "dead mass", "kg", m.PRINTED_DEAD_MASS, rig.rig.dead_mass, "stated, in pounds"),
        ("F_N", "normal force", "N", 141.6, rig.rig.load, follows),
        ("d_s", "steel disc", "mm", 60.0, 1e3 * rig.steel.diameter, stated),
        ("d_a", "bronze disc", "mm", 45.0, 1e3 * rig.bronze.diameter, stated),
        ("D", "length of the contact", "mm", 8.0, 1e3 * rig.length, stated),
        ("E_s", "modulus, steel", "GPa", "", 1e-9 * rig.steel.young_modulus, chosen),
        ("E_a", "modulus, bronze", "GPa", "", 1e-9 * rig.bronze.young_modulus, chosen),
        ("epsilon_s", "Poisson's ratio, steel", "", "", rig.steel.poisson_ratio, "assumed"),
        ("epsilon_a", "Poisson's ratio, bronze", "", "", rig.bronze.poisson_ratio, "assumed"),
        ("b", "half width (71)", "mm", "", 1e3 * rig.half_width, follows),
        ("p_max", "pressure (70)", "N/mm2", 194.3, 1e-6 * rig.pressure, follows),
    ]
    columns = ("symbol", "quantity", "unit", "thesis", "here", "which is")
    return Grid(columns, tuple(rows), ("asperity.tribometer.discs, on rig-final",))


@table("6.10")
def _matrix() -> Grid:
    tested = {("sine", mode, "oil") for mode in m.AMPLITUDES}
    tested |= {("triangle", mode, "oil") for mode in m.AMPLITUDES} | {
        ("sine", "transverse", "grease")
    }
    return Grid.of(
        [(wave, mode, oil) for mode in m.AMPLITUDES for oil in ("grease", "oil")
         for wave in ("sine", "triangle")],
        {
            "mode": lambda row: row[1],
            "lubricant": lambda row: row[2],
            "wave": lambda row: row[0],
            "": lambda row: _TICKED if row in tested else _CROSSED,
            "f, Hz": lambda row: ", ".join(f"{f:g}" for f in m.FREQUENCIES),
            "V_ms, V": lambda row: ", ".join(f"{v:g}" for v in m.SUPPLIES),
            "cells": lambda row: len(m.FREQUENCIES) * len(m.SUPPLIES) if row in tested else 0,
        },
        "asperity rig plan rig-final",
    )  # fmt: skip
