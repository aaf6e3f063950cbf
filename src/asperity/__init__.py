"""What imposed vibration does to friction between sliding surfaces.

What a session begins with stands here, imported when it is first used.
"""

import importlib

TYPE_CHECKING = False  # as typing has it, which takes its time at the start of a command
if TYPE_CHECKING:
    from typing import Any

    from asperity.block.parameters import Block, Contact
    from asperity.errors import AsperityError, ConvergenceError, InputError
    from asperity.flanks.parameters import Disc, Hob, Modification, Mount
    from asperity.friction import Friction
    from asperity.gearset import Gearset
    from asperity.normal import Normal
    from asperity.python import (
        check,
        compare,
        flank,
        methods,
        optimise,
        rate,
        read,
        sensitivity,
        size,
        slide,
        static,
    )
    from asperity.rating.parameters import Operation, RatingOptions
    from asperity.slider import Model, Slider, Solve, homogenise, solve, solve_many
    from asperity.slider.wear import Wear
    from asperity.vibration import Vibration

__version__ = "0.1.0"

_PLACES = {
    "asperity.block.parameters": ("Block", "Contact"),
    "asperity.errors": ("AsperityError", "ConvergenceError", "InputError"),
    "asperity.flanks.parameters": ("Disc", "Hob", "Modification", "Mount"),
    "asperity.friction": ("Friction",),
    "asperity.gearset": ("Gearset",),
    "asperity.normal": ("Normal",),
    "asperity.python": (
        "check",
        "compare",
        "flank",
        "methods",
        "optimise",
        "rate",
        "read",
        "sensitivity",
        "size",
        "slide",
        "static",
    ),
    "asperity.rating.parameters": ("Operation", "RatingOptions"),
    "asperity.slider": ("Model", "Slider", "Solve", "homogenise", "solve", "solve_many"),
    "asperity.slider.wear": ("Wear",),
    "asperity.vibration": ("Vibration",),
}
_PLACE = {name: place for place, names in _PLACES.items() for name in names}

__all__ = [
    "AsperityError",
    "Block",
    "Contact",
    "ConvergenceError",
    "Disc",
    "Friction",
    "Gearset",
    "Hob",
    "InputError",
    "Model",
    "Modification",
    "Mount",
    "Normal",
    "Operation",
    "RatingOptions",
    "Slider",
    "Solve",
    "Vibration",
    "Wear",
    "check",
    "compare",
    "flank",
    "homogenise",
    "methods",
    "optimise",
    "rate",
    "read",
    "sensitivity",
    "size",
    "slide",
    "solve",
    "solve_many",
    "static",
]


def __getattr__(name: str) -> "Any":
    if name not in _PLACE:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    found = getattr(importlib.import_module(_PLACE[name]), name)
    globals()[name] = found
    return found


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
