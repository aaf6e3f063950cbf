"""The way in: a case file of one's own, begun from what is known.

:Entry: `write` (`asperity new`), `check` (`asperity check`), `compare`.
:Data: what is asked about each kind of case (`kinds`).
:Where: `gear` (a gearset from ratio, torque and speed), `openable` (cases that can be opened),
    `received` (files handed over).
:Tests: `acceptance/test_cli_start`.
"""
