"""A case as it goes from one process to another: as it would be written."""

import json
from pathlib import Path
from typing import Any

from asperity.casefile import Case
from asperity.tribometer.tables import TABLES


def packed(case: Case) -> dict[str, Any]:
    """Return the tables of a rig, for JSON."""
    raw = {name: dict(entries) for name, entries in case.raw.items() if name in TABLES}
    return {
        "source": case.source,
        "folder": str(case.folder),
        "raw": json.loads(json.dumps(raw, default=str)),
    }


def cased(told: dict[str, Any]) -> Case:
    """Return the case of what :func:`packed` gave."""
    return Case(told["source"], Path(told["folder"]), {}, told["raw"], TABLES).replace([])
