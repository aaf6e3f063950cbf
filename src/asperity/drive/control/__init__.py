"""A stroke whose vibration comes and goes: controller, its sensor and filter, or a clutch.

:Entry: `study` (`asperity control`).
:Data: `[control]` (`parameters`) beside what a drive reads.
:Where: `sensor` (filter, alias), `switching` (thresholds, what is watched), `machine` (drive,
    sensor and controller on their way), `stroke` (seat to seat, and after), `result`, `plots`.
:Tests: `unit/test_drive_control`.
"""
