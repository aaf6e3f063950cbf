"""Processes beside this one, and the signals that reach them.

:Entry: `alone.alone` (what one process holds), `sessions.begun` and `sessions.end`.
:Data: none.
:Where: `began` (when the command was given), `interrupts` (no Ctrl-C is lost while something is imported).
:Tests: `unit/test_processes`, `unit/test_interrupts`.
"""
