"""Elastic teeth as the kernels take them."""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from asperity.arrays import FloatArray, IntArray
from asperity.contact.candidates.records import Answer, Body, Candidates, Kept, Laws, Work
from asperity.contact.interface.records import Committed
from asperity.drive.elastic.friction import Sliding
from asperity.drive.elastic.rim import Rim
from asperity.drive.interface import POSES
from asperity.drive.teeth.placing import Stand

GATHERED = np.dtype(
    [
        ("tooth", np.float64),
        ("poses", np.float64, (POSES,)),
        ("least_gap", np.float64),
        ("reach", np.float64),
        ("way", np.float64),
    ]
)
"""Where a tooth's candidates were gathered: which tooth it was, poses, least distance, how far they
reach; and the elastic way since."""


class Mesh(NamedTuple):
    """Elastic teeth on both flanks: what stays, and room to work in.

    With K teeth looked at, a tooth ``m`` has the place ``m mod K`` on the driving flank and K more
    on the other.
    """

    body: Body
    stand: Stand
    rim: Rim
    laws: Laws  #: With the worm's flank 1
    back: Laws  #: With the worm's flank -1
    teeth: int  #: K
    flanks: int  #: 1 or 2
    ahead: float  #: Angle of the wheel at which the driving flank touches at pose 0, rad
    damping: float  #: c of the contact, s/m
    sliding: Sliding  #: Friction over the speed
    friction_stiffness: float  #: Of the asperities, Pa/m
    stiffness: float  #: Of the flanks' surfaces, Pa/m
    candidates: Candidates
    answer: Answer
    kept: Kept
    history: Committed
    earlier: FloatArray  #: (4k, 3): Committed forces, N
    work: Work
    gathered: npt.NDArray[np.void]  #: (2K,) of `GATHERED`
    shape: FloatArray  #: (2K, 3n): Displacement of the nodes when they were
    rotation: FloatArray  #: (2, 3, 3): Of the worm before and after the step
    translation: FloatArray  #: (2, 3)
    vectors: FloatArray  #: (2, 3): Force and moment
    wrench: FloatArray  #: (6,)
    drift: FloatArray  #: (3, 3)
    shift: FloatArray  #: (3,)
    nothing: FloatArray  #: (3, 3): Zeros
    still: FloatArray  #: (3,): Zeros
    moved: FloatArray  #: (3,): Shift of the worm
    one: FloatArray  #: (3, 3)
    damped: FloatArray  #: (5,): Generalised forces of the damping
    amplitude: FloatArray  #: (r,): Of the rim's shapes
    numbers: IntArray  #: (2K,): Teeth looked at, as they follow one another in their flank's frame
    counted: IntArray  #: (1,): Evaluations of teeth so far
