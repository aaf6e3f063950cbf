"""The `[requirements]` table: what a gearset that is sized has to keep beside its safeties."""

import math
from collections.abc import Mapping
from typing import Annotated, Any, ClassVar, Literal

import numpy as np

from asperity.arrays import FloatArray
from asperity.casefile import Table
from asperity.rating.variants import Variants
from asperity.studies.series import RATIO_OFF
from asperity.units import Quantity

Length = Annotated[float, Quantity("m", what="a length", example="125 mm", gt=0)]


class Requirements(Table):
    """What sizing keeps.

    Parameters
    ----------
    ratio_tolerance : float or str
        By how much the teeth may miss the ratio, "2 %" in a file; 3 % if left out.
    self_locking : {'any', 'wanted', 'avoided'}
        Whether the worm must lock itself at rest by every standard that rates it, or must not by
        any.
    locking_margin : float
        By how much: friction at rest over that from which on it locks at least so many times as
        much where that is wanted, and so many times as little where it is avoided. 1 if left out.
    centre_distance : float or str, optional
        At most, m.
    wheel_diameter : float or str, optional
        Tip diameter of the wheel, d_a2 with an addendum of one module, at most, m.
    safety : float
        Times what each standard asks for, at least. 1 if left out.
    """

    table: ClassVar[str] = "requirements"

    ratio_tolerance: Annotated[
        float, Quantity("", what="a share", example="0.02", ge=0, le=0.2)
    ] = RATIO_OFF
    self_locking: Literal["any", "wanted", "avoided"] = "any"
    locking_margin: Annotated[float, Quantity("", what="a factor", example="1.1", ge=1, le=100)] = (
        1.0
    )
    centre_distance: Length | None = None
    wheel_diameter: Length | None = None
    safety: Annotated[float, Quantity("", what="a factor", example="1.2", ge=1, le=100)] = 1.0

    def kept(self, rated: Variants, at_rest: Mapping[str, FloatArray]) -> Any:
        """Return which designs keep what is asked beside their safeties.

        Parameters
        ----------
        rated : Variants
            The designs.
        at_rest : mapping of str to ndarray
            By standard, by how much the friction at rest is above that which locks; infinite where
            the standard has no say.
        """
        kept = np.ones(rated.shape, dtype=bool)
        given = rated.given
        for margin in at_rest.values():
            says = np.isfinite(margin)
            ratio = np.where(says, margin, 0.0) + 1.0
            if self.self_locking == "wanted":
                kept &= ~says | (ratio >= self.locking_margin)
            elif self.self_locking == "avoided":
                kept &= ~says | (ratio * self.locking_margin < 1.0)
        if self.centre_distance is not None:
            kept &= given.centre_distance <= 1e3 * self.centre_distance * (1.0 + 1e-12)
        if self.wheel_diameter is not None:
            teeth = given.wheel_teeth + 2.0 * given.profile_shift + 2.0
            kept &= given.axial_module * teeth <= 1e3 * self.wheel_diameter * (1.0 + 1e-12)
        return kept

    @property
    def said(self) -> str:
        """What is kept, for notes and messages."""
        parts = []
        if self.self_locking != "any":
            margin = "" if self.locking_margin == 1.0 else f" by {self.locking_margin:g} times"
            parts.append(f"self-locking {self.self_locking}{margin}")
        if self.centre_distance is not None:
            parts.append(f"centre distance at most {1e3 * self.centre_distance:g} mm")
        if self.wheel_diameter is not None:
            parts.append(f"wheel at most {1e3 * self.wheel_diameter:g} mm")
        if self.safety != 1.0:
            parts.append(f"safeties {self.safety:g} times what is asked")
        if not math.isclose(self.ratio_tolerance, RATIO_OFF):
            parts.append(f"ratio within {100.0 * self.ratio_tolerance:g} %")
        return ", ".join(parts)
