"""The thesis reproduced: its claims as a ledger, figures, tables, and a page that shows them.

:Entry: `run`, `asperity thesis`; `contents` lists all that is made.
:Data: cases that ship (`cases`).
:Where: a folder a subject: `sliding`, `contact`, `rating`, `flanks`, `drive`, `rig`; `exhibits`
    (what a claim, figure or table is), `products` (a verdict, a dataset), `reproduce` (a run).
:Tests: `unit/test_thesis_*`, `acceptance/test_thesis`.
"""

from asperity.thesis.reproduce.files import Shown
from asperity.thesis.reproduce.run import ThesisResult, run

__all__ = ["Shown", "ThesisResult", "run"]
