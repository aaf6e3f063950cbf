"""Which gearsets gain most from vibration: those of low efficiency, by closed form."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from asperity.arrays import FloatArray
from asperity.drive.point import MeshPoint
from asperity.drive.studies.closed_form import frictionless_ratio, screw_ratio
from asperity.errors import InputError
from asperity.gearset.parameters import Gearset
from asperity.rating.parameters import Operation, RatingOptions
from asperity.rating.rate import rate
from asperity.results import Result, quantity

if TYPE_CHECKING:
    import xarray as xr

VELOCITY_RATIO = 2.0
_GEARS = ("gearset",)


class Gains(Result):
    """Gearsets by what a screw vibration far above their resonances saves."""

    title: ClassVar[str] = "What vibration saves in which gearset"
    stem: ClassVar[str] = "gains"
    drawings: ClassVar[Mapping[str, str]] = {"gains": "asperity.drive.studies.plots:plot_gains"}

    names: tuple[str, ...]
    velocity_ratio: float = quantity("k_w", "", "peak velocity of the screw over the sliding")
    gear_ratio: FloatArray = quantity("i", "", "gear ratio", dims=_GEARS)
    centre_distance: FloatArray = quantity("a", "m", "centre distance", dims=_GEARS)
    lead_angle: FloatArray = quantity("gamma_m1", "rad", "lead angle", dims=_GEARS)
    friction: FloatArray = quantity("mu_zm", "", "mean tooth friction", dims=_GEARS)
    efficiency: FloatArray = quantity(
        "eta", "", "efficiency of the teeth, and the ratio without any friction", dims=_GEARS
    )
    shaken_ratio: FloatArray = quantity(
        "T_Bv/T_Bs", "", "ratio under the screw, by closed form, in balance", dims=_GEARS
    )
    locks: FloatArray = quantity("", "", "1 where it locks itself without vibration", dims=_GEARS)
    locks_shaken: FloatArray = quantity("", "", "1 where it does so under it", dims=_GEARS)

    @property
    def inputs(self) -> Mapping[str, Any]:
        """What was asked."""
        return {"velocity_ratio": self.velocity_ratio}

    def to_dataset(self) -> "xr.Dataset":
        """Return everything over the gearsets, the most saved first."""
        described = {"units": "1", "long_name": "name of the gearset"}
        names = np.array(self.names, dtype=object)
        return super().to_dataset().assign_coords(gearset=("gearset", names, described))


def gains(
    gearsets: Sequence[Gearset],
    operation: Operation,
    options: RatingOptions | None = None,
    velocity_ratio: float = VELOCITY_RATIO,
) -> Gains:
    """Return what a screw vibration saves in each of some gearsets, the most saved first.

    Parameters
    ----------
    gearsets : sequence of Gearset
        Such as `asperity.studies.catalogue` proposes.
    operation : Operation
        How each is run.
    options : RatingOptions, optional
        How each is rated: friction is that of ISO/TR 14521.
    velocity_ratio : float
        Peak velocity of the screw over the sliding, 1.05 or more.

    Raises
    ------
    InputError
        No gearset is given, one cannot be rated, or the ratio is outside the closed form.
    """
    if not gearsets:
        raise InputError("no gearset is given; give one or more")
    if velocity_ratio < 1.05:
        raise InputError(
            f"velocity_ratio is {velocity_ratio:g}; the closed form holds from 1.05 on"
        )
    rows = []
    for gearset in gearsets:
        rated = rate(gearset, operation, options, ("iso14521",)).iso14521
        if rated is None:
            raise InputError(f"{gearset.name or 'a gearset'} cannot be rated by ISO/TR 14521")
        g, mu = gearset.geometry, float(rated["mu_zm"])
        point = MeshPoint.of(g, 0.5e-3 * g.worm_pitch_diameter)
        ratio = float(screw_ratio(point, mu, velocity_ratio))
        left = ratio_of_friction(velocity_ratio) * mu
        rows.append(
            (
                g.gear_ratio, 1e-3 * g.centre_distance, g.lead_angle, mu,
                frictionless_ratio(point, mu), ratio,
                float(point.holding_share(mu) < 1.0), float(point.holding_share(left) < 1.0),
            )
        )  # fmt: skip
    order = sorted(range(len(rows)), key=lambda n: rows[n][5])
    columns = np.array([rows[n] for n in order]).T
    names = tuple(gearsets[n].name or f"gearset {n + 1}" for n in order)
    return Gains(
        names=names,
        velocity_ratio=velocity_ratio,
        gear_ratio=columns[0],
        centre_distance=columns[1],
        lead_angle=columns[2],
        friction=columns[3],
        efficiency=columns[4],
        shaken_ratio=columns[5],
        locks=columns[6],
        locks_shaken=columns[7],
        notes=(
            "a screw far above the resonances of worm and wheel, touching at the reference circle; "
            "in balance with the load by construction",
        ),
    )


def ratio_of_friction(velocity_ratio: float) -> float:
    """Mean friction along the sliding under a vibration along it, over that without."""
    from asperity.slider.closed_forms import longitudinal_ratio

    return float(longitudinal_ratio(velocity_ratio))
