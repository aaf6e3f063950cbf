"""Claim 4.7: the LuGre equations of Appendix A, (44) to (47), step by step as they stand."""

import dataclasses
import math

import numpy as np

from asperity.arrays import FloatArray
from asperity.friction.two_phase import phases
from asperity.thesis.exhibits import claim
from asperity.thesis.products import ARITHMETIC, Finding
from asperity.thesis.sliding.bodies import DIRECTION, PERIODIC, RATIO, Sweep
from asperity.thesis.sliding.claims import ALL_AROUND, LUGRE

_STEPS = 400


@dataclasses.dataclass(frozen=True)
class LuGre:
    """What (42) to (47) take; SI.

    Attributes
    ----------
    stiffness : float
        k_t, N/m.
    full : float
        mu F_N, N.
    stiction : float
        F_S, N; without a Stribeck velocity it is not asked for.
    stribeck : float
        v_s, m/s; 0 for none.
    damping, viscous : float
        h_t and h_v, N s/m.
    """

    stiffness: float
    full: float
    stiction: float = 0.0
    stribeck: float = 0.0
    damping: float = 0.0
    viscous: float = 0.0

    def limit(self, velocity: float) -> float:
        """Kinetic friction at a velocity, N: the denominator of (43), its exponent squared."""
        if self.stribeck == 0.0:
            return self.full
        return self.full + (self.stiction - self.full) * math.exp(
            -((velocity / self.stribeck) ** 2)
        )

    def along(self, size: float, reach: float, step: float) -> float:
        """Deflection by (44) or (45) where an end has moved so that it would be ``reach``, m."""
        velocity = (reach - size) / step
        rate = velocity - self.stiffness * abs(velocity) / self.limit(velocity) * size
        return size + rate * step


def phases_of(
    law: LuGre,
    size: float,
    direction: FloatArray,
    first: FloatArray,
    second: FloatArray,
    step: float,
) -> tuple[float, FloatArray]:
    """Return deflection and friction after a step of both phases, (44) to (47).

    Parameters
    ----------
    law : LuGre
        Properties.
    size : float
        Deflection before, m.
    direction : ndarray, shape (2,)
        Its direction, of length 1.
    first, second : ndarray, shape (2,)
        Slip of each phase, m.
    step : float
        s.

    Returns
    -------
    size : float
        Deflection after, m.
    friction : ndarray, shape (2,)
        F_x and F_y, N.
    """
    way = size * direction + first
    reach = float(np.hypot(*way))
    middle = law.along(size, reach, step)
    way = middle * way / reach + second
    reach = float(np.hypot(*way))
    last = law.along(middle, reach, step)
    # (46), (47): the velocity of h_v is that of the asperity's whole reach.
    force = (
        law.stiffness * last + (law.damping * (last - size) + law.viscous * (reach - size)) / step
    )
    return last, force * way / reach


def step_differences() -> FloatArray:
    """Return how far (44) to (47) without LuGre's terms are off Dahl's two phases, over s_max."""
    random = np.random.default_rng(5)
    law = LuGre(stiffness=67.29e6, full=5.08)
    s_max = law.full / law.stiffness
    off = []
    for _ in range(_STEPS):
        size = random.uniform(0.05, 0.95)
        angle = random.uniform(0.0, 2.0 * np.pi)
        direction = np.array([np.cos(angle), np.sin(angle)])
        first, second = random.uniform(-0.2, 0.2, (2, 2))
        found, _ = phases_of(law, size * s_max, direction, first * s_max, second * s_max, 1e-6)
        dahl, *_ = phases(size, *direction, *first, *second, 1.0, False)
        off.append(found / s_max - dahl)
    return np.abs(off)


def steady_viscous() -> float:
    """Return what (46) has of viscous friction in steady sliding along x, over h_v v_r."""
    velocity, step, viscous = 0.5e-3, 1e-6, 40.0
    plain = LuGre(stiffness=67.29e6, full=5.08)
    forces = []
    for law in (plain, dataclasses.replace(plain, viscous=viscous)):
        size, force = 1e-12, np.zeros(2)
        for _ in range(2000):
            size, force = phases_of(
                law, size, np.array([1.0, 0.0]), np.array([velocity * step, 0.0]), np.zeros(2), step
            )
        forces.append(float(force[0]))
    return (forces[1] - forces[0]) / (viscous * velocity)


@claim("4.7")
def _lugre() -> Finding:
    axes = ((RATIO, "2,20"), (DIRECTION, ALL_AROUND))
    dahl = Sweep("table-4.4", axes, (PERIODIC,))
    lugre = Sweep("table-4.4", axes, LUGRE)
    apart = float(np.abs(dahl.ratios() - lugre.ratios()).max())
    steps = float(step_differences().max())
    return Finding.judged(
        {"exact": apart < 1e-12, "(44) to (47) give each step of Dahl's two phases": steps < 1e-12},
        f"{f'differ by up to {apart:.0e}' if apart else 'the same to the last bit'}, in "
        f"{dahl.values(1).size} directions at k = 2 and 20; steps of (44) to (47) by {steps:.0e}",
        "Without damping and Stribeck terms LuGre's equation is Dahl's, and so are the updates "
        "compared here: an identity, which could not have come out otherwise. Zeros put into (43) "
        "as the text has it make it 0/0 where the body stands, and its exponent has no bound for "
        "a negative slip "
        "velocity; the square that is used here is more likely lost in the reading than in the "
        "thesis, for the boxes of (44) and (45) beside it were read as roots. Nothing is claimed "
        "of "
        "non-zero terms; as they stand (46) and (47) leave "
        f"{abs(steady_viscous()):.0%} of the viscous friction in steady sliding along x, since "
        f"their "
        "velocity is taken after the first phase has let the asperity follow.",
        {
            "largest_difference": apart,
            "largest_difference_of_a_step": steps,
            "viscous_share_in_steady_sliding": steady_viscous(),
        },
        [
            dahl,
            lugre,
            "asperity.thesis.sliding.appendix_a.step_differences(), steady_viscous()",
        ],
        verdict=ARITHMETIC,
    )
