"""Numbers as they stand on a screen, or in a file that was shared of it."""

import re

PREFIXES = {"": 1.0, "G": 1e9, "M": 1e6, "k": 1e3, "m": 1e-3, "µ": 1e-6, "n": 1e-9}
SUPERSCRIPT = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")
EVERY = """(place) => [...document.querySelectorAll(`${place} .num [data-key]`)].map((one) => ({
  key: one.dataset.key, value: one.dataset.value, of: one.dataset.unit,
  text: one.querySelector("b").textContent,
  unit: (one.querySelector("i")?.textContent.trim() ?? "")
    .replace(/^°$/, "deg").replace(/^°/, "deg").replaceAll("²", "2").replaceAll("³", "3")
    .replace(/^µm$/, one.dataset.unit === "um" ? "um" : "µm"),
}))"""


def numbers(page, place="main"):
    """Return every number of a place that opens: its key, what it is, how it is shown."""
    found = [
        one
        for one in page.evaluate(EVERY, place)
        if re.fullmatch(r"-?\d+(\.\d+)?(e[-+]?\d+)?", one["value"])
    ]
    return {f"{n} {one['key']}": one for n, one in enumerate(found)}


def read(text):
    """Return a number as it is printed, 3.1·10⁻⁵ too."""
    mantissa, _, power = text.replace("−", "-").partition("·10")
    return float(mantissa) * 10.0 ** float(power.translate(SUPERSCRIPT) or 0)


def in_si(text, shown, unit):
    """Return what is shown in SI in the unit of its entry."""
    if shown == unit:
        return read(text)
    if unit == "rad":
        return read(text) * {"deg": 0.017453292519943295, "µrad": 1e-6}[shown]
    return read(text) * PREFIXES[shown.removesuffix(unit)]
