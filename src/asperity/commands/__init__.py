"""What asperity can do: each command's name, what it reads, how it refuses and how it solves.

The command line and the axes of sweeps are made from this list. A room offers two functions:
``prepare(case, **options)`` returns a problem, or refuses it at no cost; ``solve(problem, run)``
returns a :class:`asperity.results.Result`.
"""

from asperity.commands.command import Argument, Command, Option
from asperity.commands.listed import COMMANDS, GROUPS
from asperity.commands.tables import case_tables

__all__ = ["COMMANDS", "GROUPS", "Argument", "Command", "Option", "case_tables"]
