"""The thesis reproduced: its claims as a ledger, its figures, and a page that shows both."""

from asperity.thesis.reproduce import FigureFiles, ThesisResult, run

__all__ = ["FigureFiles", "ThesisResult", "run"]
