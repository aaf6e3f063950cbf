"""Something of another room, named by its place and imported when it is used."""

import importlib
from typing import Any


def loaded(place: str) -> Any:
    """Return what stands at ``"module:name"``."""
    module, _, name = place.partition(":")
    return getattr(importlib.import_module(module), name)
