"""The standards by which a gearset is rated, by name: their tables, and a rating by each."""

import math
from collections.abc import Sequence
from pathlib import Path

from asperity.errors import InputError, choices, one_of
from asperity.gearset.parameters import Gearset
from asperity.rating.agma6034.rating import rate as rate_agma6034
from asperity.rating.agma6034.rating import rated as rated_agma6034
from asperity.rating.bs721.rating import rate as rate_bs721
from asperity.rating.bs721.rating import rated as rated_bs721
from asperity.rating.bs721.tables import Tables, read_tables
from asperity.rating.demands import Demand
from asperity.rating.inputs import Inputs, Values, inputs
from asperity.rating.iso14521.rating import rate as rate_iso14521
from asperity.rating.iso14521.rating import rated as rated_iso14521
from asperity.rating.levers import Judge
from asperity.rating.parameters import Operation, RatingOptions
from asperity.rating.result import Rating

STANDARDS = ("iso14521", "bs721", "agma6034")
"""The standards, by the name they have in results."""

ALL = "all"


def tables_of(options: RatingOptions, folder: Path | None) -> Tables:
    """Return the tables of BS 721 that are asked for."""
    own = options.bs721_tables
    return read_tables(None if own is None else (folder or Path()) / own)


def known_standards(standards: Sequence[str]) -> tuple[str, ...]:
    """Return the standards in their order; raises InputError for one that is not known."""
    for name in standards:
        if name not in STANDARDS:
            raise InputError(f"standard is {name!r}; {one_of(STANDARDS, name)}")
    if not standards:
        raise InputError(f"no standard is asked for; give one of {choices(STANDARDS)}")
    return tuple(name for name in STANDARDS if name in standards)


# Keys a reader of the JSON may count on: null where the number could not be had.
PROMISED = {
    "iso14521": (
        "sliding_velocity_m_s", "mu_0T", "mu_zm", "Y_S", "Y_G", "Y_W", "Y_R", "h_star",
        "p_m_star", "s_star", "eta_z1_2", "eta_z2_1", "eta_ges", "input_power_W",
        "input_torque_Nm", "loss_meshing_W", "loss_idle_W", "loss_bearing_W", "loss_seal_W",
        "sigma_Hm_MPa", "safety_wear", "safety_pitting", "safety_deflection", "safety_root",
        "safety_temperature",
    ),
    "bs721": ("M_26k_Nm", "M_w_Nm", "M_s_Nm"),
    "agma6034": (
        "mu", "eta", "allowable_torque_Nm", "bending_stress_MPa", "C_s", "C_m", "C_v",
    ),
}  # fmt: skip


def judge_of(demand: Demand, options: RatingOptions, tables: Tables) -> Judge:
    """Return what finds a safety of a gearset and its operation."""

    def judge(gearset: Gearset, operation: Operation) -> float:
        given = inputs(gearset, operation, options)
        safety = float(_numbers(demand.standard, given, tables).get(demand.key, math.nan))
        if math.isfinite(safety):
            return safety
        # A whole rating says why there is none.
        return float(rate_by(demand.standard, given, tables)[demand.key])

    return judge


def _numbers(name: str, inputs: Inputs, tables: Tables) -> Values:
    """Return the numbers of a rating by key, without what is told of them."""
    if name == "iso14521":
        return rated_iso14521(inputs)[0]
    if name == "bs721":
        return rated_bs721(inputs, tables)[0]
    return rated_agma6034(inputs)


def rate_by(name: str, inputs: Inputs, tables: Tables) -> Rating:
    """Return the rating by a standard; raises InputError where it cannot be applied."""
    if name == "iso14521":
        return rate_iso14521(inputs)
    if name == "bs721":
        return rate_bs721(inputs, tables)
    return rate_agma6034(inputs)
