"""How much efficiency a higher permissible torque costs, and the other way round.

The highest efficiency is sought for one required torque after the other (epsilon-constraint), from
that of the most efficient design of all to the highest torque that any design within the bounds
bears. The permissible torque is the lower of those for wear and strength by BS 721.
"""

import dataclasses
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from asperity.arrays import FloatArray
from asperity.errors import InputError
from asperity.gearset.parameters import Gearset
from asperity.rating.parameters import Operation, RatingOptions
from asperity.results import Result
from asperity.results.dataset import described
from asperity.results.table import Table
from asperity.studies.climb import Hill, Top, climb, climb_together, spread
from asperity.studies.design import VARIABLES, Bounds, Space
from asperity.studies.layout import percent
from asperity.studies.quantities import varied_quantity
from asperity.studies.requirements import Requirements

if TYPE_CHECKING:
    import xarray as xr

POINTS = 11
"""Required torques on the curve."""

_STARTS = 4
_MOST = 10.0
"""Torque that no design is expected to reach, over that of the gearset as it is."""
_FLAT = 1e-6
_ROOM = 1e-8


class TradeOff(Result):
    """The most efficient designs for rising permissible torques.

    Attributes
    ----------
    name : str
        Of the gearset.
    torque : ndarray, shape (points,)
        Permissible torque, N m, rising.
    efficiency : ndarray, shape (points,)
        Highest efficiency of the teeth with it.
    numbers : dict of str to ndarray, shape (points,)
        The designs: what is free, profile shift, h*, torques permitted by wear and strength; the
        units are part of the keys.
    given : dict of str to float
        The same of the gearset as it is.
    required_torque : float
        Rated torque times the application factor, N m.
    """

    title: ClassVar[str] = "Efficiency and permissible torque"
    stem: ClassVar[str] = "trade-off"
    drawings: ClassVar[Mapping[str, str]] = {"trade-off": "asperity.studies.plots:plot_trade_off"}

    name: str
    torque: FloatArray
    efficiency: FloatArray
    numbers: dict[str, FloatArray]
    given: dict[str, float]
    required_torque: float

    def to_json(self) -> dict[str, Any]:
        """Return the curve by key; the units are part of the keys."""
        return {
            "M_permissible_Nm": self.torque.tolist(),
            "eta_z1_2": self.efficiency.tolist(),
            **{key: values.tolist() for key, values in self.numbers.items()},
            "required_torque_Nm": self.required_torque,
        }

    def to_dataset(self) -> "xr.Dataset":
        """Return the designs over the permissible torque."""
        over = ("torque",)
        dataset = described(
            f"Efficiency and permissible torque of {self.name or 'a worm gearset'}",
            torque=(over, self.torque, "N m", "permissible torque, by wear and strength"),
            eta_z1_2=(over, self.efficiency, "1", "highest efficiency of the teeth"),
            h_star=(over, self.numbers["h_star"], "1", "parameter of the lubricant film"),
            M_w=(over, self.numbers["M_w_Nm"], "N m", "torque permitted by wear"),
            M_s=(over, self.numbers["M_s_Nm"], "N m", "torque permitted by strength"),
            **{
                what.name: (over, self.numbers[what.key], what.unit or "1", what.meaning)
                for what in map(varied_quantity, (*VARIABLES, "profile_shift"))
            },
        )
        given = {f"given.{key}": value for key, value in self.given.items()}
        dataset.attrs |= given | {"required_torque_Nm": self.required_torque}
        return dataset

    def table(self) -> Table:
        """Return the most efficient designs for rising permissible torques."""
        keys = ("pressure_angle_deg", "diameter_factor", "axial_module_mm", "worm_roughness_um")
        columns = [self.numbers[key] for key in (*keys, "profile_shift")]
        rows = [
            [
                f"{torque:.4g}",
                percent(self.efficiency[place]),
                *(f"{column[place]:.4g}" for column in columns),
            ]
            for place, torque in enumerate(self.torque)
        ]
        return Table.of(
            ("M_p (N m)", "eta_z (%)", "alpha_n (deg)", "q_1", "m_x1 (mm)", "Ra_1 (um)", "x_2"),
            rows,
            title="Most efficient designs for a permissible torque",
            left=0,
        )

    def tables(self) -> tuple[Table, ...]:
        """Return the designs as a table."""
        return (self.table(),)


def trade_off(
    gearset: Gearset,
    operation: Operation,
    options: RatingOptions | None = None,
    bounds: Bounds | None = None,
    *,
    points: int = POINTS,
    folder: Path | None = None,
    least: Mapping[str, float] | None = None,
    requirements: Requirements | None = None,
) -> TradeOff:
    """Find the highest efficiency for each of several permissible torques.

    Parameters
    ----------
    gearset : Gearset
        As in `asperity.studies.optimise.optimise`.
    operation : Operation
        As in `asperity.studies.optimise.optimise`.
    options : RatingOptions, optional
        As in `asperity.studies.optimise.optimise`.
    bounds : Bounds, optional
        As in `asperity.studies.optimise.optimise`.
    points : int
        Required torques on the curve, at least 2.
    folder : path, optional
        Where a relative file name among the options starts.
    least : mapping of str to float, optional
        As in `asperity.studies.optimise.optimise`.
    requirements : Requirements, optional
        As in `asperity.studies.optimise.optimise`.

    Returns
    -------
    TradeOff
        A design for each torque.

    Raises
    ------
    InputError
        The gearset cannot be rated as it is, by ISO/TR 14521 or by BS 721, or no design within the
        bounds has what is required.
    """
    if points < 2:
        raise InputError(f"points is {points}; a curve needs at least 2")
    return curve_in(Space(gearset, operation, options, bounds, folder, least, requirements), points)


def curve_in(space: Space, points: int = POINTS) -> TradeOff:
    """Return the trade-off among the designs of a space, see `trade_off`."""
    operation = space.operation
    now = space.numbers(space.start)
    unit = float(now["M_permissible_Nm"])
    begin = [space.start, *spread(space.dimensions, _STARTS)]
    (first,) = _most_efficient(space, begin, [0.0])
    strongest = _strongest(space, [first.point, *begin], unit)
    lowest, highest = _permissible(space, first.point), _permissible(space, strongest.point)
    required = np.linspace(lowest, highest, points)
    if highest - lowest <= _FLAT * unit:
        required = required[:1]
    # From both ends, because a weak design cannot always be climbed from.
    begin = [first.point, strongest.point]
    tops = [first, *_most_efficient(space, begin, required[1:] * (1.0 - _ROOM))]
    found = np.array([top.point for top in tops])
    numbers = space.numbers(found)
    designs = space.values(found)
    return TradeOff(
        name=space.gearset.name,
        torque=numbers["M_permissible_Nm"],
        efficiency=numbers["eta_z1_2"],
        numbers={
            **{varied_quantity(n).key: varied_quantity(n).from_si(designs[n]) for n in VARIABLES},
            **{key: numbers[key] for key in ("h_star", "M_w_Nm", "M_s_Nm", "profile_shift")},
        },
        given={
            **{
                varied_quantity(n).key: varied_quantity(n).shown(v)
                for n, v in space.values(space.start).items()
            },
            **{key: float(value) for key, value in now.items()},
        },
        required_torque=operation.application_factor * operation.output_torque,
    )


def _permissible(space: Space, point: FloatArray) -> float:
    return float(space.numbers(point)["M_permissible_Nm"])


def _most_efficient(space: Space, begin: list[FloatArray], torques: Iterable[float]) -> list[Top]:
    def hill(torque: float) -> Hill:
        least = dict.fromkeys(("M_w_Nm", "M_s_Nm"), torque) if torque > 0.0 else {}
        starts = begin + space.best_of_sample("eta_z1_2", M_permissible_Nm=torque)
        return lambda rows: space.merit(rows, least), starts

    tops = climb_together(space.worth, [hill(torque) for torque in torques])
    found = [top for top in tops if top]
    if len(found) < len(tops):  # one of the starts bears the torque
        raise space.nothing_keeps()
    return found


def _strongest(space: Space, begin: list[FloatArray], unit: float) -> Top:
    # The lower of two torques has a kink where they meet; a torque that both exceed has none.
    def merit(points: FloatArray) -> FloatArray:
        found = space.numbers(points[:, :-1])
        torque = _MOST * points[:, -1]
        rows = [torque, *(found[key] / unit - torque for key in ("M_w_Nm", "M_s_Nm"))]
        return np.stack([*rows, *space.room(found)], axis=-1)

    begin = begin + space.best_of_sample("M_permissible_Nm", h_star=0.0)
    shares = space.numbers(np.array(begin))["M_permissible_Nm"] / (_MOST * unit)
    top = climb(merit, [np.append(*one) for one in zip(begin, shares, strict=True)])
    assert top is not None  # the first of them bears its own torque
    return dataclasses.replace(top, point=top.point[:-1])
