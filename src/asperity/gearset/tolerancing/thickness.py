"""By how much a thread or tooth may be thinner where nothing else is said."""

from asperity.sources import Source

SOURCE = Source(
    "DIN 3967:1978, table 2, series 25", "one source", "made for cylindrical gears"
)  # fmt: skip
"""Where the tolerances come from."""

TOLERANCES = (
    (10.0, 0.02), (50.0, 0.03), (125.0, 0.04), (280.0, 0.05), (560.0, 0.06), (1000.0, 0.08),
    (1600.0, 0.1), (2500.0, 0.13), (4000.0, 0.16), (6300.0, 0.2), (10000.0, 0.25),
)  # fmt: skip
"""Tolerance of the normal thickness by diameter up to which it holds, mm: series 25."""


def thickness_tolerance(diameter: float) -> float:
    """Return the tolerance of the normal thickness at a diameter, both mm."""
    found = (tolerance for most, tolerance in TOLERANCES if diameter <= most)
    return next(found, TOLERANCES[-1][1])
