r"""The transmission error of a loaded mesh by its orders, beside that of rigid flanks.

Over a pitch of the worm, from one tooth to the next, the wheel is ahead of the ratio's angle by

.. math:: e(\theta) = \bar e + \sum_n a_n\cos(2\pi n\,\theta/\theta_p - \psi_n) .

Without load it is that of the exact flanks, which `asperity flank` has. Points of the mesh find the
first touch a little late: what is between both is the mesh's own without load. Under load it is
what the wheel turns further as patches of the resolved pressures bear, which are wherever worm and
wheel touch, in place of the points of the mesh. No harmonic that is not above the mesh's own tells
of the gearset.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Sequence

import numpy as np

from asperity.arrays import FloatArray, IntArray
from asperity.drive.static.sweep import PitchSweep
from asperity.errors import ConvergenceError
from asperity.flanks.meshing.transmission import ToothSearch
from asperity.flanks.wheel.enveloped import Wheel

_STEPS = 30
# To which the worm's angle is met, rad: a wheel's angle to a millionth of a microradian.
_CLOSE = 1e-12
# Amplitudes below it are rounding, rad: they and their phases are 0.
_ROUNDING = 1e-13


def harmonics(error: FloatArray) -> tuple[FloatArray, FloatArray]:
    r"""Return amplitudes and phases of the orders of a function over its period.

    Parameters
    ----------
    error : ndarray, shape (p,)
        At places that divide the period evenly.

    Returns
    -------
    amplitude, phase : ndarray, shape (n,)
        Of the orders 1, 2 .. (p - 1) // 2, of which p places tell both; the phase in rad, from 0 to
        :math:`2\pi`.
    """
    count = len(error)
    turned = np.fft.rfft(error)[1 : (count - 1) // 2 + 1] * (2.0 / count)
    turned[np.abs(turned) < _ROUNDING] = 0.0
    phase = np.mod(-np.angle(turned), 2.0 * math.pi)
    return np.abs(turned), np.asarray(np.where(turned == 0.0, 0.0, phase))


def exact_error(wheel: Wheel, worm_angle: FloatArray) -> FloatArray:
    """Return the transmission error of the rigid, exact flanks at angles of the worm, rad.

    Parameters
    ----------
    wheel : Wheel
        As it is cut and mounted; its flank ``s = 1`` bears.
    worm_angle : ndarray, shape (p,)
        rad.

    Raises
    ------
    ConvergenceError
        The worm reaches no tooth.
    """
    search = ToothSearch(wheel.pair, wheel.flank(1))
    ratio = wheel.pair.ratio
    found = np.empty(len(worm_angle))
    lead = 0.0
    for place, angle in enumerate(worm_angle):
        # The lead changes by little from place to place.
        beta = (angle - lead) / ratio
        for _ in range(_STEPS):
            lead = search.least_lead(beta)
            off = ratio * beta + lead - angle
            if not abs(off) > _CLOSE:
                break
            beta -= off / ratio
        if not math.isfinite(lead):
            raise ConvergenceError(
                "the worm reaches no tooth of the wheel in a part of the pitch: look at "
                "mount.centre_distance_error and mount.axial_offset"
            )
        found[place] = -lead / ratio
    return found


@dataclasses.dataclass(frozen=True, eq=False)
class ErrorHarmonics:
    """The error by its orders at several loads."""

    torque: FloatArray  #: (t,): Of the wheel, N m, the first 0: rigid flanks
    order: IntArray  #: (n,): Times in a pitch
    amplitude: FloatArray  #: (t, n): rad
    phase: FloatArray  #: (t, n): rad
    unloaded: FloatArray  #: (p,): Error of the exact flanks at the phases, rad
    noise: FloatArray  #: (t, n): Amplitudes of what the mesh's points make of it, rad
    noise_range: FloatArray  #: (t,): The same, peak to peak, rad

    @classmethod
    def of(
        cls, wheel: Wheel, sweeps: Sequence[PitchSweep], of_mesh: Sequence[FloatArray]
    ) -> ErrorHarmonics:
        """Return it of courses over the same phases under rising loads.

        Parameters
        ----------
        wheel : Wheel
            As it is cut and mounted.
        sweeps : sequence of PitchSweep
            Under rising loads.
        of_mesh : sequence of ndarray
            For each of them what the points of the mesh hold the wheel ahead by, (p,), rad.
        """
        first = sweeps[0]
        unloaded = exact_error(wheel, first.worm_angle)
        off = first.touching - unloaded, *of_mesh
        found = [harmonics(error) for error in (unloaded, *(each.error for each in sweeps))]
        amplitude, phase = (np.array(part) for part in zip(*found, strict=True))
        return cls(
            np.array([0.0, *(each.torque for each in sweeps)]),
            np.arange(1, amplitude.shape[1] + 1, dtype=np.int64), amplitude, phase, unloaded,
            np.array([harmonics(each)[0] for each in off]), np.ptp(off, axis=1),
        )  # fmt: skip
