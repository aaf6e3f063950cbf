"""Old place of `asperity.slider.methods`."""

from asperity.slider.methods import solve

__all__ = ["solve"]
