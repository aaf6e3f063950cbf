"""Rate many variants of a worm gearset at once, on arrays."""

import dataclasses
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np
import numpy.typing as npt

from asperity.errors import InputError, nearest, shown
from asperity.formulas import Mask, Reasons, masking
from asperity.gearset.parameters import Gearset
from asperity.rating.agma6034.rating import rated as rated_agma6034
from asperity.rating.bs721.rating import rated as rated_bs721
from asperity.rating.bs721.tables import Tables
from asperity.rating.driven import driven
from asperity.rating.inputs import Inputs, Values
from asperity.rating.iso14521.calculation import rated_capacity, rated_efficiency
from asperity.rating.parameters import Operation, RatingOptions
from asperity.rating.standards import STANDARDS, known_standards, tables_of
from asperity.rating.variation import BLOCK, varied


@dataclasses.dataclass(frozen=True, eq=False)
class Variants:
    """Ratings of many variants: an array for each number, by standard and key.

    ``variants["iso14521.eta_z1_2"]`` has the numbers that `asperity.rating.rate` gives for each
    variant alone; NaN where there is none, and `reason` says why.

    Attributes
    ----------
    shape : tuple of int
        Of all arrays.
    rating_inputs : Inputs
        What the formulas started from, in the units of the standards; stand-ins where a variant
        is impossible.
    notes : tuple of str
        Why a standard could not be applied at all.
    """

    shape: tuple[int, ...]
    rating_inputs: Inputs
    notes: tuple[str, ...]
    _impossible: npt.NDArray[np.bool_]
    _values: Mapping[str, Any]
    _masks: Mapping[str, Mask]

    def __getitem__(self, key: str) -> npt.NDArray[np.float64]:
        if key not in self:
            raise InputError(f"{shown(key)} is not part of the result{self._why(key)}")
        everywhere = np.broadcast_to(self._values[key], self._impossible.shape).astype(np.float64)
        everywhere[self._impossible] = np.nan
        return everywhere.reshape(self.shape)

    def __contains__(self, key: object) -> bool:
        return isinstance(key, str) and key in self._values

    def __iter__(self) -> Iterator[str]:
        return iter(self._values)

    def __len__(self) -> int:
        return len(self._values)

    def reason(self, key: str) -> Reasons:
        """Return 0 where there is a number, else the code of the reason why not.

        Parameters
        ----------
        key : str
            Of an array, or the name of a standard: then it is 0 where none of its formulas failed.
            The reason is the first formula of the standard that failed for a variant.

        Returns
        -------
        ndarray of int16, shape of the variants
            Codes of `legend`.
        """
        standard, _, number = key.partition(".")
        reason = self._mask(standard).reason.reshape(self.shape)
        return np.where(np.isnan(self[key]), reason, 0).astype(np.int16) if number else reason

    def legend(self, standard: str) -> Mapping[int, str]:
        """Return the codes of a standard as sentences.

        Parameters
        ----------
        standard : str
            Its key, such as ``iso14521``.

        Returns
        -------
        mapping of int to str
            A sentence by code.
        """
        return MappingProxyType(self._mask(standard).legend)

    def _mask(self, standard: str) -> Mask:
        if not isinstance(standard, str) or standard not in self._masks:
            raise InputError(f"{shown(standard)} is not part of the result{self._why(standard)}")
        return self._masks[standard]

    def _why(self, key: str) -> str:
        standard = str(key).partition(".")[0]
        notes = [note for note in self.notes if note.startswith(f"{standard}:")]
        return f": {notes[0]}" if notes else nearest(key, (*self._masks, *self))


def variants(
    gearset: Gearset,
    operation: Operation,
    options: RatingOptions | None = None,
    standards: Sequence[str] = STANDARDS,
    *,
    capacity: bool = True,
    loads: bool = True,
    folder: Path | None = None,
    **values: npt.ArrayLike,
) -> Variants:
    """Rate variants of a worm gearset.

    Parameters
    ----------
    gearset, operation, options
        As in `asperity.rating.rate`; what is not varied.
    standards : sequence of {'iso14521', 'bs721', 'agma6034'}
        Which to apply.
    capacity : bool
        Whether stresses and safeties by ISO/TR 14521 are wanted beside the efficiency.
    loads : bool
        Whether forces, root stress, powers and the sump by AGMA 6034 are wanted beside its
        friction, efficiency and torque.
    folder : path, optional
        Where a relative file name among the options starts.
    **values : array_like
        What is varied, in SI, by the names of the case file: ``starts``, ``wheel_teeth``,
        ``centre_distance``, ``axial_module``, ``diameter_factor``, ``profile_shift``,
        ``pressure_angle``, ``worm_roughness``; ``worm_speed``, ``output_torque``;
        ``base_friction``, ``friction``, ``friction_factor``; and ``gear_ratio``, which varies the
        teeth of the wheel without rounding them. Shapes broadcast. See `asperity.rating.variation`
        for which of the geometry's numbers follows.

    Returns
    -------
    Variants
        Arrays by standard and key, with NaN where a formula has no answer, and the reasons. A
        standard that cannot be applied to any variant is left out, and the notes say why.

    Raises
    ------
    InputError
        Names and shapes that do not fit, or the only standard asked for cannot be applied at all.
    """
    options = options or RatingOptions()
    operation = driven(gearset, operation, options)
    inputs, impossible, shape = varied(gearset, operation, options, values)
    wanted = known_standards(standards)
    found: dict[str, Any] = {}
    masks, notes = {}, []
    tables = tables_of(options, folder) if "bs721" in wanted else None
    for name in wanted:
        mask = impossible.copy()
        try:
            numbers = _calculate(name, inputs, mask, tables, capacity=capacity, loads=loads)
        except InputError as error:
            if len(wanted) == 1:
                raise
            notes.append(f"{name}: {error}")
            continue
        masks[name] = mask
        found |= {f"{name}.{key}": value for key, value in numbers.items()}
    return Variants(shape, inputs, tuple(notes), impossible.reason != 0, found, masks)


def _calculate(
    name: str, inputs: Inputs, mask: Mask, tables: Tables | None, *, capacity: bool, loads: bool
) -> Values:
    """Return the numbers of a standard, block by block."""
    found: Values = {}
    count = mask.reason.size
    fields = {field.name: getattr(inputs, field.name) for field in dataclasses.fields(inputs)}
    arrays = {key: value for key, value in fields.items() if np.ndim(value)}
    for start in range(0, max(count, 1), BLOCK) if count > BLOCK else (None,):
        part = ... if start is None else slice(start, start + BLOCK)
        here = dataclasses.replace(inputs, **{key: array[part] for key, array in arrays.items()})
        with masking(mask.part(part)):
            if name == "iso14521":
                numbers = rated_efficiency(here)
                numbers = rated_capacity(here, numbers) if capacity else numbers
            elif name == "bs721" and tables is not None:
                numbers = rated_bs721(here, tables)[0]
            else:
                numbers = rated_agma6034(here, loads=loads)
        # What leads to the numbers of a duty cycle would take more room than the numbers.
        numbers = {key: one for key, one in numbers.items() if not key.startswith("part_")}
        if start is None:
            return numbers
        for key, value in numbers.items():
            found.setdefault(key, np.empty(count))[part] = value
    return found
