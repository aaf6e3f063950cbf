"""How every long work runs: under a key of all it follows from, kept, interrupted, resumed.

:Entry: `Run`: `Run.resume`, `Run.interruptible`, `Run.checkpoint`.
:Data: none; states are trees of arrays (`tree`).
:Where: `key` (what an answer is kept under), `cache` and `row_cache` (answers kept),
    `checkpoint_file` (a state kept), `interrupt` (signals between two steps), `workers`
    (processes on all cores), `asking` (a person, at a terminal).
:Tests: `unit/test_runs*`, `unit/test_asking`, `acceptance/test_killed`.
"""

from asperity.runs.interrupt import Interrupted, Stopped
from asperity.runs.run import Run

__all__ = ["Interrupted", "Run", "Stopped"]
