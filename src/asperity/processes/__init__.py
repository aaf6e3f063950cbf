"""Processes beside this one, and the signals that reach them.

:Entry: `alone.alone` (what one process holds), `sessions.begun` and `sessions.end`.
:Data: none.
:Where: `interrupts` (no Ctrl-C is lost while something is imported), `began` (when a command was
    given).
:Tests: `unit/test_processes`, `unit/test_interrupts`.
"""
