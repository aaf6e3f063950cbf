"""Draw the rooms of the package by floors, and who imports whom, from the imports themselves."""

import tomllib
from pathlib import Path

import grimp
import numpy as np

from asperity.results.figures import BLUE, axes_grid

ROOT = Path(__file__).parents[1]


def floors() -> list[list[str]]:
    """Return the floors of the tower from the top, as the import contract has them."""
    contracts = tomllib.loads((ROOT / "pyproject.toml").read_text())["tool"]["importlinter"]
    layers = next(c["layers"] for c in contracts["contracts"] if c["type"] == "layers")
    return [[name.strip(" ()") for name in layer.split("|")] for layer in layers]


def draw(target: Path) -> None:
    """Draw a row and a column a room; a dot where the room of the row imports that of the column.

    All dots lie to the right of the diagonal: no room imports from one above it.
    """
    graph = grimp.build_graph("asperity")
    there = {module.partition(".")[2] for module in graph.find_children("asperity")}
    rooms = [room for floor in floors() for room in floor if room in there]
    count = np.zeros((len(rooms), len(rooms)))
    place = {room: number for number, room in enumerate(rooms)}
    for module in graph.modules:
        for imported in graph.find_modules_directly_imported_by(module):
            names = [name.split(".")[1:2] for name in (module, imported)]
            if all(names) and all(name[0] in place for name in names):
                row, column = (place[name[0]] for name in names)
                count[row, column] += row != column
    figure, (axes,) = axes_grid(width=8.0, height=8.0)
    rows, columns = np.nonzero(count)
    sizes = 14.0 * np.sqrt(count[rows, columns])
    axes.scatter(columns, rows, s=sizes, color=BLUE, zorder=3)
    axes.plot([-0.5, len(rooms) - 0.5], [-0.5, len(rooms) - 0.5], color="#888888", linewidth=0.8)
    axes.set_xticks(range(len(rooms)), rooms, rotation=90)
    axes.set_yticks(range(len(rooms)), rooms)
    axes.set_xlabel("is imported")
    axes.set_ylabel("imports; each room stands on those below it")
    axes.set_xlim(-0.6, len(rooms) - 0.4)
    axes.set_ylim(len(rooms) - 0.4, -0.6)
    axes.set_aspect("equal")
    figure.savefig(target, dpi=120)


if __name__ == "__main__":
    draw(ROOT / "docs" / "_static" / "tower.png")
