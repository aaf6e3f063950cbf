"""A gearset by one standard, named by a word, and what a rating by it always has."""

from asperity.gearset.parameters import Gearset
from asperity.rating.agma6034.rating import rate as rate_agma6034
from asperity.rating.bs721.rating import rate as rate_bs721
from asperity.rating.bs721.tables import Tables
from asperity.rating.demands import Demand
from asperity.rating.inputs import Inputs, inputs
from asperity.rating.iso14521.rating import rate as rate_iso14521
from asperity.rating.levers import Judge
from asperity.rating.parameters import Operation, RatingOptions
from asperity.rating.result import Rating

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
        rating = rate_by(demand.standard, inputs(gearset, operation, options), tables)
        return float(rating[demand.key])

    return judge


def rate_by(name: str, given: Inputs, tables: Tables) -> Rating:
    """Return the rating by a standard; raises InputError where it cannot be applied."""
    if name == "iso14521":
        return rate_iso14521(given)
    if name == "bs721":
        return rate_bs721(given, tables)
    return rate_agma6034(given)
