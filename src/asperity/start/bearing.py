"""A data file of rolling bearings, begun for whoever has a maker's table at hand."""

from asperity.shafts.bearing import RollingBearing
from asperity.start.data_file import data_text

KIND = "bearing"
"""The name that ``asperity new`` takes."""

NAME = "my 7206-B"
_GIVEN = {
    "kind": '"angular contact"',
    "series": '"02"',
    "bore": '"30 mm"',
    "dynamic_rating": '"20 kN"',
    "static_rating": '"13 kN"',
    "contact_angle": '"40 deg"',
}
_REMARKS = (
    "Rolling bearings of your own, begun by asperity new.",
    "Ratings of makers differ by 5 to 10 percent: take them from the table of the one you buy "
    "from, and name it below. What is given here is invented.",
    "asperity --materials FILE bearings lists what the file holds; asperity --materials FILE "
    "shafts CASE takes it, where [worm_shaft] or [wheel_shaft] names it.",
    "Every key that stands behind a # may be given as well.",
)


def bearing_text() -> str:
    """Return a commented data file with one bearing."""
    return data_text(
        _REMARKS,
        ("maker", "catalogue of the maker, edition"),
        ("bearing", NAME),
        RollingBearing,
        _GIVEN,
    )
