"""A drawing of where a gearbox's power goes: a band for each part, as wide as it is large."""

from asperity.rating.result import Rating
from asperity.results.svg import Drawing
from asperity.results.words import text_of

_LOSSES = (("teeth", "meshing"), ("idling", "idle"), ("bearings", "bearing"), ("seals", "seal"))
_BAND, _LENGTH, _LEAST = 26.0, 98.0, 0.3


def power_flow(iso: Rating) -> str:
    """Return the flow of power from worm to wheel by ISO/TR 14521, as SVG."""
    drawing = Drawing("Flow of power from the worm to the wheel")
    n = {entry.key: float(entry.value) for entry in iso if isinstance(entry.value, float)}
    whole = n["input_power_W"]
    scale = _BAND / whole
    left = max(scale * n["output_power_W"], 0.0)
    bottom, start = _BAND, 0.0
    drawing.text((0.0, -2.0), ("worm P_1 ", _watts(n, "input_power_W"), " W"), anchor="start")
    drawing.line([(0.0, 0.0), (_LENGTH, 0.0)])
    drawing.line([(0.0, 0.0), (4.0, _BAND / 2.0), (0.0, _BAND)])
    for place, (name, key) in enumerate(_LOSSES):
        loss = scale * n[f"loss_{key}_W"]
        x, wide = start + 6.0, max(loss, _LEAST)
        depth = _BAND + 5.0 + 6.0 * (len(_LOSSES) - place)
        drawing.line([(start, bottom), (x, bottom), (x, depth)])
        bottom -= loss
        start = x + wide
        drawing.line([(start, bottom), (start, depth)])
        middle = x + wide / 2.0
        drawing.line([(x, depth), (middle, depth + 2.5), (start, depth)])
        words = f"{name} ", _watts(n, f"loss_{key}_W"), " W"
        drawing.text((start + 1.5, depth + 1.0), words, anchor="start")
    end = max(_LENGTH, start + 8.0)
    drawing.line([(start, bottom), (end, bottom)])
    drawing.line([(end, 0.0), (end + 4.0, left / 2.0), (end, bottom)])
    drawing.text((end, -2.0), ("wheel P_2 ", _watts(n, "output_power_W"), " W"), anchor="end")
    return drawing.svg()


def _watts(n: dict[str, float], key: str) -> str:
    return text_of(n[key], key=f"iso14521.{key}")
