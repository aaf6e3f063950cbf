"""What asperity can do: each command's name, what it reads, how it refuses and how it solves.

The command line and the axes of sweeps are made from this list. A room offers two functions:
``prepare(case, **options)`` returns a problem, or refuses it at no cost; ``answer(problem, run)``
returns a :class:`asperity.results.Result`.

:Entry: `listed.COMMANDS`; `execution`, the one order of read, prepare, folder, solve, show, write.
:Data: `tables.case_tables`: every room's tables by name.
:Where: `command` (options, and what rooms above add), `request` (what a program asks, as JSON).
:Tests: `unit/test_commands`, `unit/test_command_options`, `acceptance/test_cli*`.
"""

from asperity.commands.command import Argument, Command, Option
from asperity.commands.listed import COMMANDS, GROUPS
from asperity.commands.tables import case_tables

__all__ = ["COMMANDS", "GROUPS", "Argument", "Command", "Option", "case_tables"]
