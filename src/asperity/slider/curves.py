"""The ratio of a body over how its vibration points, or how strong it is, beside a closed form."""

import dataclasses
import math
from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from asperity.arrays import BoolArray, FloatArray
from asperity.errors import ConvergenceError, InputError, one_of, shown
from asperity.formulas.formula import Formula
from asperity.results.dataset import rounded
from asperity.slider.closed_forms.ratios import directed_ratio, triangle_directed_ratio
from asperity.slider.continuation import follow
from asperity.slider.model import Model

OVER = ("direction", "k", "elevation", "phase")
"""What a curve goes over."""

# By what a curve goes over: the key of the vibration, and from where to where, rad.
_ANGLES = {
    "direction": ("direction", 0.0, math.pi / 2.0),
    "elevation": ("elevation", 0.0, math.pi),
    "phase": ("normal_phase", -math.pi, math.pi),
}
_LEAST, _MOST = 0.1, 10.0
_MOST_POINTS = 400
_FORMS: Mapping[str, Formula[Any]] = {"sine": directed_ratio, "triangle": triangle_directed_ratio}


class Curve(NamedTuple):
    """A curve of periodic states, each sought from the one before.

    Attributes
    ----------
    x : ndarray, shape (n,)
        Direction, elevation or phase of the normal part, deg, or peak velocity of the vibration
        over that of the drive.
    unit : str
        Of `x`.
    ratio : ndarray, shape (n,)
        Mean drive force over mu F_N; NaN where there is no state.
    closed : ndarray, shape (n,), or None
        That of rigid Coulomb friction and a rigid drive; None where there is no closed form.
    unstable : ndarray of bool, shape (n,)
        Where no stable state was found.
    """

    x: FloatArray
    unit: str
    ratio: FloatArray
    closed: FloatArray | None
    unstable: BoolArray

    def to_json(self) -> dict[str, Any]:
        """Return it by name, with the digits that a picture shows."""
        return {
            "x": rounded(self.x),
            "unit": self.unit,
            "ratio": rounded(self.ratio),
            "closed": None if self.closed is None else rounded(self.closed),
            "unstable": self.unstable.tolist(),
        }


def curve(model: Model, over: str = OVER[0], points: int = 37) -> Curve:
    """Follow a body's periodic state over what may be chosen of its vibration.

    Parameters
    ----------
    model : Model
        A body that is shaken.
    over : {'direction', 'k', 'elevation', 'phase'}
        From along to across the drive; from weak to strong; from along the plane through its normal
        to the plane again; by how much the normal part leads the part in the plane.
    points : int
        How many states, 2 to 400.

    Returns
    -------
    Curve
        The ratio over it.

    Raises
    ------
    InputError
        Nothing is shaken, the body knows no motion normal to the plane, or over something else or
        by too many points.
    """
    if over not in OVER:
        raise InputError(f"over is {shown(over)}; {one_of(OVER, over)}")
    if type(points) is not int or not 2 <= points <= _MOST_POINTS:
        raise InputError(f"points is {shown(points)}; it must be from 2 to {_MOST_POINTS}")
    if model.vibration is None or model.shape is None:
        raise InputError("nothing is shaken; give the case a table [vibration]")
    if over in _ANGLES:
        key, low, high = _ANGLES[over]
        if over != "direction" and model.normal is None:
            raise InputError(f"over is {over!r}; the case has no table [normal], which that needs")
        values = np.linspace(low, high, points)
    else:
        now = model.peak_velocity / model.slider.drive_velocity
        values, key = np.geomspace(_LEAST, max(_MOST, 2.0 * now), points), "velocity_ratio"
    solve = model.solve.model_copy(update={"method": "periodic"})
    models = [
        dataclasses.replace(
            model, solve=solve, vibration=model.vibration.model_copy(update={key: v}, units="SI")
        )
        for v in values.tolist()
    ]
    found = list(follow(models))
    closed = [_closed(each) for each in models]
    return Curve(
        np.degrees(values) if over in _ANGLES else values,
        "deg" if over in _ANGLES else "",
        np.array([math.nan if isinstance(f, ConvergenceError) else f.ratio for f in found]),
        None if None in closed else np.array(closed),
        np.array([
            isinstance(f, ConvergenceError)
            or not f.settled
            for f in found
        ]),
    )  # fmt: skip


def _closed(model: Model) -> float | None:
    """Return the ratio of rigid Coulomb friction on a rigid drive, where it has a closed form."""
    form = _FORMS.get(model.vibration.waveform) if model.vibration else None
    if form is None or model.normal is not None or model.elevation:
        return None
    k = model.peak_velocity / model.slider.drive_velocity
    along, across, _ = model.unit_direction
    across *= model.friction.transfer
    return float(form(k * math.hypot(along, across), math.atan2(across, along)))
