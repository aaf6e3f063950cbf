"""How a base is shaken: the table ``[vibration]``, and its waveforms."""

from asperity.vibration.shaking import Vibration

__all__ = ["Vibration"]
