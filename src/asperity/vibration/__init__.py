"""How a base is shaken: waveform, amplitude in any of its forms, direction, start.

:Entry: `Vibration`.
:Data: `[vibration]` (`shaking`); a sampled waveform from a file.
:Where: `waveform` (sine, triangle, square, trapezium, sampled, as kernels read them).
:Tests: `unit/test_vibration`.
"""

from asperity.vibration.shaking import Vibration

__all__ = ["Vibration"]
