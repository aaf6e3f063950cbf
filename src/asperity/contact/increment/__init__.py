"""One implicit increment of a body in contact, solved at its contact nodes."""

from asperity.contact.increment.problem import ContactState, IncrementProblem, IncrementResult
from asperity.contact.increment.solver import IncrementSolver

__all__ = ["ContactState", "IncrementProblem", "IncrementResult", "IncrementSolver"]
