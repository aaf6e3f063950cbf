"""A case as it goes from one process to another: as it would be written."""

import json
from pathlib import Path
from typing import Any

from asperity.casefile import Case
from asperity.tribometer.tables import tables_of


def packed(case: Case) -> dict[str, Any]:
    """Return the tables of a rig, for JSON."""
    known = tables_of(case.raw)
    raw = {name: dict(entries) for name, entries in case.raw.items() if name in known}
    return {
        "source": case.source,
        "folder": str(case.folder),
        "raw": json.loads(json.dumps(raw, default=str)),
    }


def cased(told: dict[str, Any]) -> Case:
    """Return the case of what :func:`packed` gave."""
    raw = told["raw"]
    return Case(told["source"], Path(told["folder"]), {}, raw, tables_of(raw)).replace([])
