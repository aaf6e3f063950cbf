"""Draw the walks of ``built.rst``: the steps of each over the floors of the rooms they stand in."""

import re
from pathlib import Path
from typing import NamedTuple

from draw_tower import floors

from asperity.results.figures import BLUE, axes_grid

DOCS = Path(__file__).parent
PACKAGE = DOCS.parent / "src" / "asperity"
MARGIN = 0.7


class Walk(NamedTuple):
    """A walk: the name of its picture, what is asked, and the place of each step."""

    picture: str
    title: str
    steps: list[str]


def walks(text: str) -> list[Walk]:
    """Return the walks of a page: each a picture's name below a title, then numbered steps."""
    found = []
    parts = re.split(r"^(.+)\n[~-]{3,}\n", text, flags=re.MULTILINE)
    for title, body in zip(parts[1::2], parts[2::2], strict=True):
        picture = re.search(r"_static/(walk-\w+)\.png", body)
        if picture:
            steps = re.findall(r"^\d+\. ``([^`]+)``", body, re.MULTILINE)
            found.append(Walk(picture[1], title, steps))
    return found


def parted(place: str) -> tuple[str, str]:
    """Return the folder that a dotted name or a file stands in, and its name there."""
    steps = re.split(r"[./]", place.removesuffix(".js"))
    deep = 1
    while deep < min(2, len(steps) - 1) and PACKAGE.joinpath(*steps[: deep + 1]).is_dir():
        deep += 1
    return ".".join(steps[:deep]), "\n".join(steps[-min(2, len(steps) - deep) :])


def draw(walk: Walk, target: Path) -> None:
    """Draw the folders that a walk touches by their floors, and its steps from left to right."""
    order = [name for floor in floors() for name in floor]
    folders = [parted(step)[0] for step in walk.steps]
    rows = sorted(dict.fromkeys(folders), key=lambda name: order.index(name.partition(".")[0]))
    figure, (axes,) = axes_grid(width=9.0, height=0.9 + 0.75 * len(rows))
    at = [(number, rows.index(folder)) for number, folder in enumerate(folders, 1)]
    axes.plot(*zip(*at, strict=True), color=BLUE, linewidth=1.2, zorder=2)
    for (x, y), step in zip(at, walk.steps, strict=True):
        axes.plot(x, y, "o", markersize=15, color=BLUE, zorder=4)
        axes.text(x, y, str(x), color="white", ha="center", va="center", zorder=5, fontsize=9)
        axes.text(
            x, y + 0.24, parted(step)[1], ha="center", va="top", fontsize=8, zorder=3,
            bbox={"facecolor": "white", "edgecolor": "none", "pad": 1.0},
        )  # fmt: skip
    axes.set_xticks([])
    axes.set_yticks(range(len(rows)), rows)
    axes.set_xlim(1.0 - MARGIN, len(at) + MARGIN)
    axes.set_ylim(len(rows) - 0.15, -0.5)
    axes.grid(axis="y", color="#dddddd")
    axes.set_xlabel("steps, in their order")
    axes.set_ylabel("folder, the upper floors above")
    figure.savefig(target, dpi=120)


def draw_all(page: Path = DOCS / "built.rst", folder: Path = DOCS / "_static") -> None:
    """Draw every walk of the page."""
    for walk in walks(page.read_text("utf-8")):
        draw(walk, folder / f"{walk.picture}.png")


if __name__ == "__main__":
    draw_all()
