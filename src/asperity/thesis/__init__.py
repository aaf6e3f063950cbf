"""The thesis reproduced: its claims as a ledger, figures, tables, and a page that shows them."""

from asperity.thesis.reproduce.files import Shown
from asperity.thesis.reproduce.run import ThesisResult, run

__all__ = ["Shown", "ThesisResult", "run"]
