"""The command line: made from the list of commands, and those that are of the terminal alone.

:Entry: `main.main`, where `asperity` begins; `command_line.built` builds one command or all, each
    with the signature that `registry_commands` makes of its entry in the list.
:Data: `asperity.commands.listed`.
:Where: `on_terminal` (a command on a terminal), `show` (tables, JSON, notes), `outcome` (one line
    about what went wrong), `helped` (help).
:Tests: `acceptance/test_cli*`.
"""
