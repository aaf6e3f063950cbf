"""Figures of chapter 3, each a few lines over the ratings; drawn by `drawings_rating`."""

from typing import TYPE_CHECKING

import numpy as np

from asperity.rating.variants import variants
from asperity.thesis.exhibits import Drawn, labelled
from asperity.thesis.rating import drawings
from asperity.thesis.rating.rated import (
    GEARSET_2,
    GEARSETS,
    comparison_of,
    optimum_of,
    sensitivity_of,
)

if TYPE_CHECKING:
    import xarray as xr

_CASES = tuple(gear.case for gear in GEARSETS.values())


def figure_3_1() -> Drawn:
    """Efficiency of gearset 2 with each way to less friction."""
    study = comparison_of(GEARSET_2)
    return Drawn(study.plot(), study.to_dataset(), [GEARSET_2.command("methods")])


def figure_3_2() -> Drawn:
    """Efficiency over each input of gearset 2."""
    study = sensitivity_of(GEARSET_2)
    return Drawn(study.plot(), study.to_dataset(), [GEARSET_2.command("sensitivity")])


def figure_3_3() -> Drawn:
    """Friction by two standards."""
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
    dataset = labelled(
        gearset=(("gearset",), np.array(list(GEARSETS), dtype=object), "1", "gearset"),
        velocity=(("velocity",), velocity, "m/s", "sliding velocity"),
        mu_0T=(("velocity",), base, "1", "base friction, ISO/TR 14521, mineral oil"),
        mu_zm=(("gearset", "velocity"), np.array(curves), "1", "tooth friction, ISO/TR 14521"),
        mu_AGMA=(("velocity",), agma[0], "1", "friction, AGMA 6034"),
        own_velocity=(("gearset",), own, "m/s", "sliding velocity of the gearset"),
        own_mu_zm=(("gearset",), mean, "1", "tooth friction of the gearset, ISO/TR 14521"),
        own_mu_AGMA=(("gearset",), mu_agma, "1", "friction of the gearset, AGMA 6034"),
    )
    how = [f"asperity.rating.variants.variants of {case}, worm_speed varied" for case in _CASES]
    return Drawn(drawings.friction(dataset), dataset, how)


def _optima(**keys: tuple[str, str, str, str]) -> "xr.Dataset":
    """Numbers of the gearsets as they are and of their optima: standard, key, unit, meaning."""
    optima = [optimum_of(gear) for gear in GEARSETS.values()]
    both = ("gearset", "design")
    dimensions = {
        "gearset": (both[:1], np.array(list(GEARSETS), dtype=object), "1", "gearset"),
        "design": (both[1:], np.array(["as it is", "optimum"], dtype=object), "1", "design"),
    }
    numbers = {
        name: (
            both,
            np.array(
                [[o.before.found[standard][key], o.after.found[standard][key]] for o in optima]
            ),
            unit,
            meaning,
        )
        for name, (standard, key, unit, meaning) in keys.items()
    }
    return labelled(**dimensions, **numbers)


def figure_3_4() -> Drawn:
    """Efficiencies as they are and at the optimum."""
    dataset = _optima(
        eta_z=("iso14521", "eta_z1_2", "1", "efficiency of the teeth, ISO/TR 14521"),
        eta_AGMA=("agma6034", "eta", "1", "efficiency of the teeth, AGMA 6034"),
    )
    return Drawn(drawings.efficiencies(dataset), dataset, _OPTIMISED)


def figure_3_5() -> Drawn:
    """Permissible torques as they are and at the optimum."""
    dataset = _optima(
        M_26k=("bs721", "M_26k_Nm", "N m", "permissible torque for 26000 h, BS 721"),
        M_w=("bs721", "M_w_Nm", "N m", "torque permitted by wear, BS 721"),
        M_s=("bs721", "M_s_Nm", "N m", "torque permitted by strength, BS 721"),
        T_G_all=("agma6034", "allowable_torque_Nm", "N m", "allowable torque, AGMA 6034"),
    )
    return Drawn(drawings.torques(dataset), dataset, _OPTIMISED)


_OPTIMISED = tuple(gear.command("optimise") for gear in GEARSETS.values())
