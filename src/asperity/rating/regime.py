r"""The regime of lubrication: the film between the teeth over how rough they are.

.. math:: \lambda = \frac{h}{\sqrt{R_{q1}^2 + R_{q2}^2}}

Below 1 asperities carry the load on what additives leave between them, from 3 on the film carries
it alone, and both do between (Hamrock's regimes begin there). Heights are taken as normally
distributed, for which :math:`R_q = \sqrt{\pi/2}\,R_a`, and the wheel's flanks as being as rough as
the worm's, to which they run in.
"""

import math
from typing import Any, NamedTuple

from asperity.rating.result import Rating
from asperity.results.words import Number, Sentence
from asperity.sources import Source

LIMITS = 1.0, 3.0
"""From where the film is mixed, and from where it is full."""

LIMITS_SOURCE = Source("exercises on Hamrock's text", "one source", "lower ends of two regimes")

_MIXED, _FULL = LIMITS
_RMS = math.sqrt(math.pi / 2.0)  # over the arithmetic mean, of heights normally distributed


class Film(NamedTuple):
    """A lubricant film between two flanks.

    Attributes
    ----------
    thickness : float
        Its least thickness, um.
    worm_roughness : float
        :math:`R_a` of the worm's flanks, um.
    """

    thickness: float
    worm_roughness: float

    @classmethod
    def of(cls, iso14521: Rating) -> "Film":
        """Return the film of a rating by ISO/TR 14521, under the torque that wear goes by."""
        thickness, roughness = iso14521["h_min_um"], iso14521["worm_roughness_um"]
        return cls(float(thickness), float(roughness))

    @property
    def ratio(self) -> float:
        r""":math:`\lambda`."""
        return self.thickness / (math.sqrt(2.0) * _RMS * self.worm_roughness)

    @property
    def regime(self) -> str:
        """``boundary``, ``mixed`` or ``full film``.

        Examples
        --------
        >>> Film(0.3, 0.5).regime, Film(1.5, 0.5).regime, Film(3.0, 0.5).regime
        ('boundary', 'mixed', 'full film')
        """
        if self.ratio < _MIXED:
            return "boundary"
        return "mixed" if self.ratio < _FULL else "full film"

    def to_json(self) -> dict[str, Any]:
        """Return it by key."""
        return {"thickness_um": self.thickness, "lambda": self.ratio, "regime": self.regime}

    def sentence(self, key: str = "") -> Sentence:
        """Return it in words, the numbers by where they stand in JSON if it is there."""
        kind = self.regime if self.regime == "full film" else f"{self.regime} lubrication"
        thickness, ratio = (f"{key}.thickness_um", f"{key}.lambda") if key else ("", "")
        return Sentence(
            f"{kind}: film ",
            Number.of(self.thickness, ".2g", thickness),
            " um, lambda ",
            Number.of(self.ratio, ".2g", ratio),
            " (wheel as rough as the worm)",
        )
