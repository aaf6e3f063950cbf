"""The teeth of gearset 3 on the fine mesh, reduced once and kept with the package.

They take half a minute to be condensed, which a run of the whole thesis has not. ``python -m
asperity.thesis.drive.fine`` writes them anew, as lines of TOML.
"""

import functools
import tomllib
from importlib.resources import files
from typing import TYPE_CHECKING

from asperity.thesis.drive.sets import BASE

if TYPE_CHECKING:
    from asperity.drive.reduced.reduction import Reduction

_KEPT = "fine.toml"


def computed() -> "Reduction":
    """Return the teeth as ``drive.density = 'fine'`` reduces them."""
    from asperity.casefile import read_case
    from asperity.commands import case_tables
    from asperity.drive.reduced.reduction import reduction
    from asperity.drive.solve import prepare
    from asperity.runs import Run

    return reduction(prepare(read_case(BASE, case_tables(), ("drive.density=fine",))), Run())


def lines(reduction: "Reduction") -> list[str]:
    """Return teeth as settings of ``[drive]``, as they are kept."""
    pairs = ", ".join(
        f'["{torque:.10g} N m", "{1e6 * turn:.10g} urad"]' for torque, turn in reduction.deflection
    )
    radius = reduction.radius or 0.0
    return [
        f"deflection = [{pairs}]",
        f'effective_radius = "{1e3 * radius:.10g} mm"',
        f'tangential_compliance = "{1e9 * reduction.compliance:.10g} nm/N"',
    ]


@functools.cache
def given() -> tuple[str, ...]:
    """Return the settings that put the kept teeth into a drive."""
    text = files("asperity.thesis.drive").joinpath(_KEPT).read_text("utf-8")
    tables = tomllib.loads(text)
    return (
        "drive.deflection=["
        + ", ".join(f'["{torque}", "{turn}"]' for torque, turn in tables["deflection"])
        + "]",
        *(f"drive.{key}={tables[key]}" for key in ("effective_radius", "tangential_compliance")),
    )


if __name__ == "__main__":
    print("\n".join(lines(computed())))
