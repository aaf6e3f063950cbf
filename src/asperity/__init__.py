"""What imposed vibration does to friction between sliding surfaces."""

__version__ = "0.1.0"
