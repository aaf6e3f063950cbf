"""What solids and views in space need beyond the package itself."""

import functools
import importlib

from asperity.errors import MissingExtraError


def _require(module: str, extra: str, what: str) -> None:
    try:
        importlib.import_module(module)
    except ImportError as error:
        raise MissingExtraError(
            f"{what} the {extra} extra ({error}): pip install asperity[{extra}]"
        ) from error


require_cad = functools.partial(_require, "OCP.Geom", "cad", "STEP needs")
"""Raise MissingExtraError unless the ``cad`` extra is installed."""

require_view = functools.partial(_require, "pyvista", "view", "pictures in space need")
"""Raise MissingExtraError unless the ``view`` extra is installed."""

require_draw = functools.partial(_require, "ezdxf", "draw", "DXF needs")
"""Raise MissingExtraError unless the ``draw`` extra is installed."""
