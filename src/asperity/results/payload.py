"""An answer as a program shows it: its JSON, what is behind each number, and what is drawn."""

from collections.abc import Iterator
from typing import Any

from asperity.results.dataset import rounded
from asperity.results.quantity import plain
from asperity.results.result import Result

_POINTS = 97


def as_payload(result: Result) -> dict[str, Any]:
    """Return everything that is told of a result.

    Returns
    -------
    dict
        ``answer``, the JSON; ``entries``, its numbers each with symbol, unit, meaning, equation,
        source, trust and below what it is rounding; ``notes``; ``series``, numbers to draw; and
        ``svg``, drawings to scale.
    """
    traces = result.traces(_POINTS)
    return {
        "answer": result.to_json(),
        "entries": list(_entries(result)),
        "notes": list(result.notes),
        "series": {name: rounded(values) for name, values in traces.items()},
        "svg": dict(result.views()),
    }


def as_shown(result: Result) -> dict[str, Any]:
    """Return what people are told of a result.

    Returns
    -------
    dict
        ``sentences`` above the tables; and ``tables``, each with ``title``, ``columns``
        (``heading``, whether ``right`` and ``typeset``), ``rows`` of texts and ``remarks`` below.
    """
    own = () if result.heading() == result.title else (result.heading(),)
    return {
        "sentences": [str(sentence) for sentence in (*own, *result.headline())],
        "tables": [
            {
                "title": table.title,
                "columns": [
                    {"heading": one.heading, "right": one.right, "typeset": one.typeset}
                    for one in table.columns
                ],
                "rows": [[str(cell) for cell in row] for row in table.rows],
                "remarks": list(map(str, table.remarks)),
            }
            for table in result.tables()
        ],
    }


def _entries(result: Result) -> Iterator[dict[str, Any]]:
    how = result.heading()
    for key, entry in result.keyed():
        label, origin = entry.label, entry.origin
        yield {
            "key": key,
            "symbol": label.symbol,
            "value": plain(entry.value),
            "unit": label.unit,
            "meaning": label.meaning,
            "equation": origin.equation if origin else "",
            "source": str(origin.source) if origin else how,
            **({"own": str(origin.of_equation)} if origin and origin.of_equation else {}),
            "trust": origin.trust if origin else "computed",
            "resolution": entry.resolution,
        }
