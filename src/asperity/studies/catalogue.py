"""The best gearset for every ratio and centre distance of a catalogue, in one call.

For each pair all sensible wheels, diameter factors and modules of ISO 54 are rated at once, and
the most efficient is proposed of those that BS 721 permits the required torques. Materials,
pressure angle, roughness and operation are those of the gearset given.
"""

import dataclasses
import itertools
import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from asperity.arrays import FloatArray
from asperity.errors import InputError
from asperity.gearset import relations
from asperity.gearset.parameters import Gearset
from asperity.gearset.sizing import MODULES, MOST_STARTS, MOST_TEETH, least_teeth, possible_starts
from asperity.rating.parameters import Operation, RatingOptions
from asperity.rating.variants import Variants, variants
from asperity.studies.design import NEEDED, Bounds
from asperity.studies.layout import labelled

if TYPE_CHECKING:
    import xarray as xr

DIAMETER_FACTOR_STEP = 0.25
"""Between the diameter factors that are tried."""

NUMBERS = {
    "starts": "",
    "wheel_teeth": "",
    "diameter_factor": "",
    "axial_module_mm": "",
    "profile_shift": "",
    "mu_zm": "iso14521.mu_zm",
    "eta_z1_2": "iso14521.eta_z1_2",
    "eta_ges": "iso14521.eta_ges",
    "M_w_Nm": "bs721.M_w_Nm",
    "M_s_Nm": "bs721.M_s_Nm",
    "safety_wear": "bs721.safety_wear",
    "safety_strength": "bs721.safety_strength",
}
"""What a proposal says, and where it is found among variants."""

_OWN_SIZE = ("worm_face_width", "wheel_face_width", "rim_thickness")
_SIZE = ("centre_distance", "axial_module", "diameter_factor", "worm_pitch_diameter")


_CATALOGUE = {
    "starts": ("1", "threads of the worm"),
    "wheel_teeth": ("1", "teeth of the wheel"),
    "diameter_factor": ("1", "diameter factor"),
    "axial_module_mm": ("mm", "axial module"),
    "profile_shift": ("1", "profile shift of the wheel"),
    "mu_zm": ("1", "mean coefficient of tooth friction"),
    "eta_z1_2": ("1", "efficiency of the teeth"),
    "eta_ges": ("1", "efficiency of the gearbox"),
    "M_w_Nm": ("N m", "torque permitted by wear"),
    "M_s_Nm": ("N m", "torque permitted by strength"),
    "safety_wear": ("1", "permitted torque over the one required, wear"),
    "safety_strength": ("1", "permitted torque over the one required, strength"),
}


@dataclasses.dataclass(frozen=True, eq=False)
class Catalogue:
    """The best gearsets over ratio and centre distance.

    Attributes
    ----------
    gearset : Gearset
        Whose materials, pressure angle and roughness the proposals have.
    ratios, centre_distances : ndarray, shape (n,)
        What was asked for; m.
    numbers : dict of str to ndarray, shape (ratios, centre distances)
        The proposals, by the keys in `NUMBERS`; NaN where there is none.
    candidates : ndarray of int, shape (ratios, centre distances)
        How many gearsets were rated for each.
    reason : ndarray of str, shape (ratios, centre distances)
        Why there is no proposal; empty where there is one.
    """

    gearset: Gearset
    ratios: FloatArray
    centre_distances: FloatArray
    numbers: dict[str, FloatArray]
    candidates: npt.NDArray[np.int64]
    reason: npt.NDArray[Any]

    def gearset_at(self, ratio: int, distance: int) -> Gearset:
        """Return a proposal as a gearset, by its places in `ratios` and `centre_distances`.

        Parameters
        ----------
        ratio, distance : int
            Places in `ratios` and `centre_distances`.

        Returns
        -------
        Gearset
            The proposal.

        Raises
        ------
        InputError
            There is none.
        """
        if self.reason[ratio, distance]:
            raise InputError(
                f"a gear ratio of {self.ratios[ratio]:g} at a centre distance of "
                f"{1e3 * self.centre_distances[distance]:g} mm: {self.reason[ratio, distance]}"
            )
        at = {key: float(values[ratio, distance]) for key, values in self.numbers.items()}
        return Gearset.model_validate(
            {
                **_common(self.gearset),
                "starts": int(at["starts"]),
                "wheel_teeth": int(at["wheel_teeth"]),
                "centre_distance": float(self.centre_distances[distance]),
                "axial_module": 1e-3 * at["axial_module_mm"],
                "diameter_factor": at["diameter_factor"],
            }
        )

    def to_json(self) -> dict[str, Any]:
        """Return proposals, and what is impossible with its reason; units are part of the keys."""
        proposals, impossible = [], []
        for i, j in np.ndindex(self.reason.shape):
            asked: dict[str, Any] = {
                "ratio": float(self.ratios[i]),
                "centre_distance_mm": float(f"{1e3 * self.centre_distances[j]:.14g}"),
                "candidates": int(self.candidates[i, j]),
            }
            if self.reason[i, j]:
                impossible.append(asked | {"reason": str(self.reason[i, j])})
                continue
            found = {key: float(values[i, j]) for key, values in self.numbers.items()}
            teeth = {key: int(found[key]) for key in ("starts", "wheel_teeth")}
            proposals.append(asked | found | teeth)
        return {"proposals": proposals, "impossible": impossible}

    def to_dataset(self) -> "xr.Dataset":
        """Return the proposals over ratio and centre distance."""
        both = ("ratio", "centre_distance")
        named = {key: (both, values, *_CATALOGUE[key]) for key, values in self.numbers.items()}
        return labelled(
            "Most efficient worm gearsets of a catalogue",
            {
                "ratio": (("ratio",), self.ratios, "1", "gear ratio asked for"),
                "centre_distance": (
                    ("centre_distance",), self.centre_distances, "m", "centre distance",
                ),
            },
            candidates=(both, self.candidates, "1", "gearsets that were rated"),
            reason=(both, self.reason, "1", "why there is no proposal"),
            **{key.removesuffix("_Nm").removesuffix("_mm"): value for key, value in named.items()},
        )  # fmt: skip


def search(
    gearset: Gearset,
    operation: Operation,
    options: RatingOptions | None = None,
    *,
    ratios: npt.ArrayLike,
    centre_distances: npt.ArrayLike,
    bounds: Bounds | None = None,
    folder: Path | None = None,
) -> Catalogue:
    """Propose the most efficient gearset for every ratio and centre distance.

    Parameters
    ----------
    gearset : Gearset
        Materials, flank, pressure angle, roughness and rules; its size and teeth do not matter.
    operation, options : Operation, RatingOptions
        As in `asperity.rating.rate`; the torques are those that every proposal must bear.
    ratios : array_like
        Ratios of the speeds, above 1. A wheel gets the nearest whole number of teeth.
    centre_distances : array_like
        m.
    bounds : Bounds, optional
        Of diameter factor and profile shift.
    folder : path, optional
        Where a relative file name among the options starts.

    Returns
    -------
    Catalogue
        A design, or the reason why there is none, for each ratio and centre distance.

    Raises
    ------
    InputError
        A ratio or centre distance that cannot be, or a standard that cannot be applied at all.
    """
    bounds = bounds or Bounds()
    wanted = _positive("ratios", ratios, 1.0), _positive("centre_distances", centre_distances, 0.0)
    shape = len(wanted[0]), len(wanted[1])
    reason = np.full(shape, "", dtype=object)
    parts: list[FloatArray] = []
    sizes = np.zeros(shape, dtype=np.int64)
    for i, j in np.ndindex(shape):
        ratio, distance = float(wanted[0][i]), float(f"{1e3 * wanted[1][j]:.14g}")
        starts = possible_starts(distance, ratio)
        found = _candidates(distance, ratio, starts, bounds)
        parts.append(found)
        sizes[i, j] = found.shape[1]
        if not starts:
            reason[i, j] = (
                f"no worm of 1 to {MOST_STARTS} starts gives a wheel of "
                f"{math.ceil(least_teeth(distance))} to {MOST_TEETH} teeth"
            )
        elif not sizes[i, j]:
            low, high = bounds.profile_shift
            reason[i, j] = f"no module of ISO 54 gives a profile shift within {low:g} and {high:g}"
    numbers = {key: np.full(shape, np.nan) for key in NUMBERS}
    columns = np.concatenate(parts, axis=1)
    if columns.shape[1]:
        rated = _rated(gearset, operation, options, columns, folder)
        values = _values(rated, columns)
        ends = np.cumsum(sizes).reshape(shape)
        for i, j in np.argwhere(sizes > 0):
            own = slice(ends[i, j] - sizes[i, j], ends[i, j])
            best, why = _best(rated, values, own)
            reason[i, j] = why
            if best is not None:
                for key, column in values.items():
                    numbers[key][i, j] = column[best]
    return Catalogue(gearset, *wanted, numbers, sizes, reason)


def _positive(name: str, given: npt.ArrayLike, above: float) -> FloatArray:
    values = np.atleast_1d(np.asarray(given, dtype=np.float64))
    wrong = values[~(np.isfinite(values) & (values > above))]
    if wrong.size:
        raise InputError(f"{name} has {wrong[0]:g} among them; each must be above {above:g}")
    if values.ndim != 1 or not values.size:
        raise InputError(f"{name} is of shape {values.shape}; it must be a list of numbers")
    return values


def _candidates(
    distance: float, ratio: float, starts: tuple[int, ...], bounds: Bounds
) -> FloatArray:
    """Return rows of starts, teeth, centre distance, module, diameter factor and profile shift."""
    low, high = bounds.diameter_factor
    steps = math.floor((high - low) / DIAMETER_FACTOR_STEP + 1e-9)
    factors = low + DIAMETER_FACTOR_STEP * np.arange(steps + 1)
    grids = [
        np.array([*itertools.product([float(z1)], [float(round(z1 * ratio))], MODULES, factors)]).T
        for z1 in starts
    ]
    if not grids:
        return np.empty((6, 0))
    z1, z2, m, q = np.concatenate(grids, axis=1)
    x2 = relations.profile_shift(distance, m, q, z2)
    fits = (x2 >= bounds.profile_shift[0]) & (x2 <= bounds.profile_shift[1])
    return np.stack([z1, z2, np.full_like(m, distance), m, q, x2])[:, fits]


def _common(gearset: Gearset) -> dict[str, Any]:
    """Return what a proposal has from the gearset: all but sizes and teeth."""
    left_out = {*_OWN_SIZE, *_SIZE, "profile_shift", "starts", "wheel_teeth", "name"}
    return {key: getattr(gearset, key) for key in gearset.model_fields_set - left_out}


def _rated(
    gearset: Gearset,
    operation: Operation,
    options: RatingOptions | None,
    columns: FloatArray,
    folder: Path | None,
) -> Variants:
    z1, z2, distance, m, q, _ = columns
    # Widths of its own would be those of one size only.
    kept = gearset.model_fields_set - {*_OWN_SIZE}
    template = Gearset.model_validate({key: getattr(gearset, key) for key in kept})
    for standard in NEEDED:
        # Alone, because then one that cannot be applied at all says why.
        variants(template, operation, options, (standard,), capacity=False, folder=folder)
    return variants(
        template,
        operation,
        options,
        NEEDED,
        capacity=False,
        folder=folder,
        starts=z1,
        wheel_teeth=z2,
        centre_distance=1e-3 * distance,
        axial_module=1e-3 * m,
        diameter_factor=q,
    )


def _values(rated: Variants, columns: FloatArray) -> dict[str, FloatArray]:
    z1, z2, _, m, q, x2 = columns
    own = {
        "starts": z1,
        "wheel_teeth": z2,
        "diameter_factor": q,
        "axial_module_mm": m,
        "profile_shift": x2,
    }
    return {key: rated[path] if path else own[key] for key, path in NUMBERS.items()}


def _best(rated: Variants, values: dict[str, FloatArray], own: slice) -> tuple[int | None, str]:
    """Return the place of the best among a pair's own candidates, or why there is none."""
    efficiency = values["eta_z1_2"][own]
    safety = np.minimum(values["safety_wear"][own], values["safety_strength"][own])
    answered = ~np.isnan(efficiency) & ~np.isnan(safety)
    if not answered.any():
        for key in ("eta_z1_2", "safety_wear", "safety_strength"):
            codes = rated.reason(NUMBERS[key])[own]
            if codes.any():
                standard = NUMBERS[key].partition(".")[0]
                return None, f"{standard}: {rated.legend(standard)[int(codes[codes != 0][0])]}"
    strong = answered & (safety > 1.0)
    if strong.any():
        return own.start + int(np.argmax(np.where(strong, efficiency, -1.0))), ""
    best = own.start + int(np.argmax(np.where(answered, safety, -1.0)))
    (w, s), (safe_w, safe_s) = (
        [values[key][best] for key in keys]
        for keys in (("M_w_Nm", "M_s_Nm"), ("safety_wear", "safety_strength"))
    )
    return None, (
        f"too weak by BS 721: the strongest has M_w {w:.4g} N m for {w / safe_w:.4g} N m and M_s "
        f"{s:.4g} N m for {s / safe_s:.4g} N m"
    )
