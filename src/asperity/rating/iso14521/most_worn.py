"""Which load of a duty cycle wears most, in however many parts it is given."""

from typing import Any

import numpy as np

from asperity.arrays import Real
from asperity.rating.inputs import Inputs


def of_alike(inputs: Inputs, depths: list[Any]) -> list[Any]:
    """Return for each part the depth of all parts of the same load: split, it stays that."""
    plain = [getattr(depth, "value", depth) for depth in depths]
    if inputs.together:
        rows = [np.broadcast_to(np.asarray(of, dtype=float), plain[0].shape)
                for of in inputs.loads[0][1:]]  # fmt: skip
        _, place = np.unique(np.stack(rows, axis=-1), axis=0, return_inverse=True)
        return [np.bincount(place.reshape(-1), plain[0])[place.reshape(-1)]]
    keys = [tuple(map(_known, part[1:])) for part in inputs.duty]
    whole: dict[Any, Any] = {}
    for key, depth in zip(keys, plain, strict=True):
        whole[key] = whole.get(key, 0.0) + depth
    return [whole[key] for key in keys]


def _known(of: Any) -> Any:
    """Return what tells a load's number from another: its value, or which array it is."""
    value = getattr(of, "value", of)
    return value if np.ndim(value) == 0 else id(value)


def place_of_most(depths: list[Any]) -> Any:
    """Return where the greatest of some depths stands: of one gearset, or of each of many."""
    return np.argmax(np.stack(np.broadcast_arrays(*depths)), axis=0)


def chosen(most: Any, there: list[Any], values: list[Real]) -> Real:
    """Return the value of the part that is most: of one gearset, or of each of many."""
    if not there:
        return values[int(most)]
    if all(value is values[0] for value in values):
        return values[0]
    found = np.array(np.broadcast_to(values[0], np.shape(most)))
    for here, value in zip(there[1:], values[1:], strict=True):
        np.copyto(found, value, where=here)
    return found
