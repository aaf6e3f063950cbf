"""Figures of chapter 3, each a few lines over the ratings; drawn by `drawings`."""

import numpy as np

from asperity.rating.variants import variants
from asperity.results.dataset import described
from asperity.studies.plots import plot_comparison, plot_sensitivity
from asperity.thesis.exhibits import Computed, figure
from asperity.thesis.rating import drawings
from asperity.thesis.rating.rated import GEARSET_2, GEARSETS, OPTIMISED


@figure("3.1", plot_comparison)
def _methods() -> Computed:
    return GEARSET_2.comparison.to_dataset(), [GEARSET_2.command("methods")]


@figure("3.2", plot_sensitivity)
def _inputs() -> Computed:
    return GEARSET_2.sensitivity.to_dataset(), [GEARSET_2.command("sensitivity")]


@figure("3.3", drawings.friction)
def _friction() -> Computed:
    velocity = np.geomspace(0.02, 20.0, 601)
    curves, agma, at = [], [], []
    for gear in GEARSETS.values():
        gearset, operation, options = gear.tables()
        own = gear.number("iso14521", "sliding_velocity_m_s")
        found = variants(
            gearset, operation, options, standards=("iso14521", "agma6034"), capacity=False,
            worm_speed=operation.worm_speed * velocity / own,
        )  # fmt: skip
        curves.append(found["iso14521.mu_zm"])
        agma.append(found["agma6034.mu"])
        base = found["iso14521.mu_0T"]
        at.append((own, gear.number("iso14521", "mu_zm"), gear.number("agma6034", "mu")))
    own, mean, mu_agma = np.array(at).T
    dataset = described(
        gearset=(("gearset",), np.array(list(GEARSETS), dtype=object), "1", "gearset"),
        velocity=(("velocity",), velocity, "m/s", "sliding velocity"),
        mu_0T=(("velocity",), base, "1", "base friction, ISO/TR 14521, mineral oil"),
        mu_zm=(("gearset", "velocity"), np.array(curves), "1", "tooth friction, ISO/TR 14521"),
        mu_AGMA=(("velocity",), agma[0], "1", "friction, AGMA 6034"),
        own_velocity=(("gearset",), own, "m/s", "sliding velocity of the gearset"),
        own_mu_zm=(("gearset",), mean, "1", "tooth friction of the gearset, ISO/TR 14521"),
        own_mu_AGMA=(("gearset",), mu_agma, "1", "friction of the gearset, AGMA 6034"),
    )
    return dataset, [
        f"asperity.rating.variants.variants of {gear.case}, worm_speed varied"
        for gear in GEARSETS.values()
    ]


@figure(
    "3.4",
    drawings.efficiencies,
    {
        "eta_z": ("iso14521", "eta_z1_2", "1", "efficiency of the teeth, ISO/TR 14521"),
        "eta_AGMA": ("agma6034", "eta", "1", "efficiency of the teeth, AGMA 6034"),
    },
)
@figure(
    "3.5",
    drawings.torques,
    {
        "M_26k": ("bs721", "M_26k_Nm", "N m", "permissible torque for 26000 h, BS 721"),
        "M_w": ("bs721", "M_w_Nm", "N m", "torque permitted by wear, BS 721"),
        "M_s": ("bs721", "M_s_Nm", "N m", "torque permitted by strength, BS 721"),
        "T_G_all": ("agma6034", "allowable_torque_Nm", "N m", "allowable torque, AGMA 6034"),
    },
)
def _optima(wanted: dict[str, tuple[str, str, str, str]]) -> Computed:
    """Numbers of the gearsets as they are and of their optima: standard, key, unit, meaning."""
    optima = [gear.optimum for gear in GEARSETS.values()]
    rated = [(optimum.before.found, optimum.after.found) for optimum in optima]
    both = ("gearset", "design")
    numbers = {
        name: (both, np.array([[one[by][key] for one in pair] for pair in rated]), unit, meaning)
        for name, (by, key, unit, meaning) in wanted.items()
    }
    dataset = described(
        gearset=(both[:1], np.array(list(GEARSETS), dtype=object), "1", "gearset"),
        design=(both[1:], np.array(["as it is", "optimum"], dtype=object), "1", "design"),
        **numbers,
    )
    return dataset, OPTIMISED
