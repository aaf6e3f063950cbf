"""Grids of cases over this machine's cores or a Dask cluster: cached, resumable."""

from asperity.sweep.axes import Axis, parse_axes, read_grid
from asperity.sweep.result import SweepResult
from asperity.sweep.run import run

__all__ = ["Axis", "SweepResult", "parse_axes", "read_grid", "run"]
