"""A data file of rolling bearings, begun for whoever has a maker's table at hand."""

from collections.abc import Iterator

from asperity.casefile.schema import Key, keys_of
from asperity.shafts.bearing import RollingBearing
from asperity.start.write import comment

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
    lines = [line for remark in _REMARKS for line in (*comment(remark), "")]
    lines += [
        "[source.maker]",
        'name = "catalogue of the maker, edition"',
        'confidence = "one source"',
        "",
        f'[bearing."{NAME}"]',
    ]
    for key in keys_of(RollingBearing):
        lines += _of(key)
    lines.append('from = { "*" = "maker" }')
    return "\n".join(lines) + "\n"


def _of(key: Key) -> Iterator[str]:
    if key.name == "name":
        return
    yield from comment(key.meaning)
    given = _GIVEN.get(key.name)
    yield f"{key.name} = {given}" if given else f"#{key.name} ="
    yield ""
