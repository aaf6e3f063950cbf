"""Figures of chapter 3, each a few lines over the ratings; drawn by `drawings_rating`."""

import numpy as np

from asperity.rating.variants import variants
from asperity.thesis import drawings_rating as drawings
from asperity.thesis.exhibits import Drawn, FigureOf, labelled
from asperity.thesis.gearsets import GEARSET_2, GEARSETS, sensitivity_of

_CASES = tuple(gear.case for gear in GEARSETS.values())


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


FIGURES = (
    FigureOf(
        "3.2", "Efficiency of gearset 2 over each of its inputs",
        "By ISO/TR 14521; one input is raised at a time, in steps of 5 %, with the centre distance "
        "as it is. Crosses: above these the film parameter h* is not above zero, and there is no "
        "answer.",
        (GEARSET_2.case,), figure_3_2,
    ),
    FigureOf(
        "3.3", "Friction by two standards",
        "Base friction by ISO/TR 14521 in mineral oil, tooth friction of gearsets 2 and 3 with its "
        "size, geometry, material and roughness factors, and friction by AGMA 6034, which knows "
        "the sliding velocity alone; markers: the gearsets at 1440 rpm.",
        _CASES, figure_3_3,
    ),
)  # fmt: skip
