"""Grids of cases over this machine's cores or a Dask cluster: cached, resumable.

:Entry: `run`, `asperity sweep`; `branches` along one axis.
:Data: any case; axes as text (`axes`) or a table of points.
:Where: `subject` (what is swept), `grid`, `tasks` and `pools` (where it is solved), `bodies` and
    `gearsets`, `plots` and `maps`.
:Tests: `unit/test_sweep_*`, `unit/test_gear_sweep`, `property/test_sweep_axes`,
    `acceptance/test_cli_sweep`.
"""

from asperity.sweep.axes import parse_axes, read_grid
from asperity.sweep.axis import Axis
from asperity.sweep.result import SweepResult
from asperity.sweep.run import run

__all__ = ["Axis", "SweepResult", "parse_axes", "read_grid", "run"]
