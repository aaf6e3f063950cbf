"""The command line: made from the list of commands, and those that are of the terminal alone.

:Entry: `main.main`, where `asperity` begins; `made` builds one command or all.
:Data: `asperity.commands.listed`.
:Where: `execute` (a command on a terminal), `show` (tables, JSON, notes), `outcome` (exit status,
    one line), `helped` (help).
:Tests: `acceptance/test_cli*`.
"""
