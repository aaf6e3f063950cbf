"""The `[requirements]` table: what a proposed gearset has to keep beside its safeties."""

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal

import numpy as np
import numpy.typing as npt

from asperity.arrays import FloatArray, Real
from asperity.casefile import Table
from asperity.formulas import masking
from asperity.gearset.relations import worm_reach
from asperity.rating.demands import DEMANDS
from asperity.rating.self_locking import locking_margins
from asperity.units import Quantity

if TYPE_CHECKING:
    from asperity.rating.bs721.tables import Tables
    from asperity.rating.inputs import Inputs
    from asperity.rating.variants import Variants

RATIO_OFF = 0.03
"""By how much the teeth may miss a ratio."""

HOBS = {"standard": "hobs of DIN 3976's pairs (from memory)", "own": "hobs of the shelf"}

_SAME = 1e-12
_OF_HOBS = 20.0  # deg; 14.5, 15, 25 and 30 are made by some

Length = Annotated[float, Quantity("m", what="a length", example="125 mm", gt=0)]


class Requirements(Table):
    """What sizing and optimising keep.

    Parameters
    ----------
    ratio : float, optional
        Of the speeds: what ``size`` proposes for where ``--ratio`` is left out, and what the teeth
        of a gearset must have that is optimised.
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
    worm_length : float or str, optional
        Length of the worm that such a wheel can touch, b_1 where it is left out, at most, m.
    hobs : {'any', 'standard', 'own'}
        What the wheel is cut with: any hob, one for a pair of module and diameter of DIN 3976, or
        one that a data file has (``asperity hobs``).
    bearings : {'given', 'own'}
        Whether the shafts of a duty name their bearings, or ``size`` puts the smallest of data
        files that does (``asperity bearings``) where one names none.
    safety : float
        Times what each standard asks for, at least. 1 if left out.
    """

    table: ClassVar[str] = "requirements"

    ratio: Annotated[float, Quantity("", what="a ratio", example="50", ge=3, le=100)] | None = None
    ratio_tolerance: Annotated[
        float, Quantity("", what="a share", example="0.02", ge=0, le=0.2)
    ] = RATIO_OFF
    self_locking: Literal["any", "wanted", "avoided"] = "any"
    locking_margin: Annotated[float, Quantity("", what="a factor", example="1.1", ge=1, le=100)] = (
        1.0
    )
    centre_distance: Length | None = None
    wheel_diameter: Length | None = None
    worm_length: Length | None = None
    hobs: Literal["any", "standard", "own"] = "any"
    bearings: Literal["given", "own"] = "given"
    safety: Annotated[float, Quantity("", what="a factor", example="1.2", ge=1, le=100)] = 1.0

    def room(self, inputs: "Inputs", at_rest: Mapping[str, Real]) -> dict[str, Any]:
        """Return by name how much room is left of what is asked beside the safeties.

        Parameters
        ----------
        inputs : Inputs
            The designs.
        at_rest : mapping of str to ndarray
            By standard, by how much the friction at rest is above that which locks; infinite where
            the standard has no say.

        Returns
        -------
        dict of str to float or ndarray
            In parts of what is asked; below zero where it is not kept.
        """
        room: dict[str, Any] = {}
        if self.ratio is not None:
            off = np.abs(inputs.wheel_teeth / inputs.starts / self.ratio - 1.0)
            room["ratio"] = self.ratio_tolerance * (1.0 + _SAME) + _SAME - off
        if self.centre_distance is not None:
            room["centre_distance"] = _below(inputs.centre_distance, self.centre_distance)
        throat = inputs.axial_module * (inputs.wheel_teeth + 2.0 * inputs.profile_shift + 2.0)
        if self.wheel_diameter is not None:
            room["wheel_diameter"] = _below(throat, self.wheel_diameter)
        if self.worm_length is not None:
            outside = throat + inputs.axial_module
            reach = worm_reach(outside, inputs.centre_distance, inputs.worm_tip_diameter)
            room["worm_length"] = _below(reach, self.worm_length)
        for name, margin in at_rest.items() if self.self_locking != "any" else ():
            says = np.isfinite(margin)
            ratio = np.where(says, margin, 0.0) + 1.0
            if self.self_locking == "wanted":
                over = ratio / self.locking_margin - 1.0
            else:
                # What locks itself just so is not avoided.
                over = 1.0 - ratio * self.locking_margin - _SAME
            room[f"self_locking.{name}"] = np.where(says, over, 1.0)
        return room

    def kept(self, rated: "Variants", at_rest: Mapping[str, FloatArray]) -> Any:
        """Return which designs keep what is asked beside their safeties, as `room` has it."""
        kept = np.ones(rated.shape, dtype=bool)
        for room in self.room(rated.rating_inputs, at_rest).values():
            kept &= room >= 0.0
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
        if self.worm_length is not None:
            parts.append(f"worm at most {1e3 * self.worm_length:g} mm")
        if self.hobs != "any":
            parts.append(HOBS[self.hobs])
        if self.safety != 1.0:
            parts.append(f"safeties {self.safety:g} times what is asked")
        if self.ratio is not None or not math.isclose(self.ratio_tolerance, RATIO_OFF):
            of = "" if self.ratio is None else f" {self.ratio:g}"
            parts.append(f"ratio{of} within {100.0 * self.ratio_tolerance:g} %")
        return ", ".join(parts)


def special_hob(pressure_angle: float) -> tuple[str, ...]:
    """Return what is to be said of a pressure angle, rad, that hobs do not have by standard.

    Parameters
    ----------
    pressure_angle : float
        Normal, rad.
    """
    degrees = math.degrees(pressure_angle)
    if math.isclose(degrees, _OF_HOBS, rel_tol=1e-6):
        return ()
    return (
        f"a pressure angle of {degrees:.4g} deg takes a special hob: the series is of "
        f"{_OF_HOBS:g} deg",
    )


def _below(size: Any, most: float) -> Any:
    """Return what is left of a most in m by a size in mm, in parts of the most."""
    return 1.0 - size / (1e3 * most) + _SAME


def broken_by(
    requirements: Requirements, variants: "Variants", tables: "Tables | None"
) -> dict[str, npt.NDArray[np.bool_]]:
    """Return by what is asked which designs do not keep it; no answer breaks nothing.

    Parameters
    ----------
    requirements : Requirements
        What is asked.
    variants : Variants
        The designs, rated with their load capacity.
    tables : Tables or None
        Of BS 721.
    """
    with masking(variants.shape):
        margins = locking_margins(variants.rating_inputs, variants, tables)
    at_rest = {
        name: np.where(variants.reason(name) == 0, margin, math.inf)
        for (name, state), margin in margins.items()
        if state == "static"
    }
    broken = {
        name: np.broadcast_to(np.asarray(room) < 0.0, variants.shape)
        for name, room in requirements.room(variants.rating_inputs, at_rest).items()
    }
    if requirements.safety > 1.0:
        safeties = [variants[d.path] / d.asked for d in DEMANDS if d.path in variants]
        least = np.min(np.nan_to_num(safeties, nan=math.inf), axis=0)
        broken["safety"] = least < requirements.safety
    return broken
