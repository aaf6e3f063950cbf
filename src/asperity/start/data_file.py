"""Data files with one entry, begun for whoever has a table at hand: bearings, plastics."""

import dataclasses
from collections.abc import Iterator, Mapping, Sequence

from asperity.casefile.schema import Key, keys_of
from asperity.casefile.table import Table
from asperity.gearset.plastics import Plastic
from asperity.shafts.bearing import RollingBearing
from asperity.start.write import comment

_MORE = "Every key that stands behind a # may be given as well."


@dataclasses.dataclass(frozen=True)
class DataFile:
    """What a data file is begun with."""

    table: type[Table]  #: Whose keys its entry has
    name: str  #: Of the entry
    source: tuple[str, str]  #: Key and name of the source of all numbers
    listed: str  #: The command that lists what it holds
    given: Mapping[str, str]  #: Values as they are written; other keys stand behind a #
    remarks: Sequence[str]  #: What stands at its head

    def text(self, kind: str) -> str:
        """Return a commented data file of a kind."""
        key, name = self.source
        lines = [line for remark in (*self.remarks, _MORE) for line in (*comment(remark), "")]
        lines += [
            f"[source.{key}]",
            f'name = "{name}"',
            'confidence = "one source"',
            "",
            f'[{kind}."{self.name}"]',
        ]
        for each in keys_of(self.table):
            lines += _of(each, self.given)
        lines.append(f'from = {{ "*" = "{key}" }}')
        return "\n".join(lines) + "\n"


def _of(key: Key, values: Mapping[str, str]) -> Iterator[str]:
    if key.name == "name":
        return
    yield from comment(key.meaning)
    value = values.get(key.name)
    yield f"{key.name} = {value}" if value else f"#{key.name} ="
    yield ""


DATA_FILES = {
    "bearing": DataFile(
        RollingBearing,
        "my 7206-B",
        ("maker", "catalogue of the maker, edition"),
        "bearings",
        {
            "kind": '"angular contact"',
            "series": '"02"',
            "bore": '"30 mm"',
            "dynamic_rating": '"20 kN"',
            "static_rating": '"13 kN"',
            "contact_angle": '"40 deg"',
        },
        (
            "Rolling bearings of your own, begun by asperity new.",
            "Ratings of makers differ by 5 to 10 percent: take them from the table of the one "
            "you buy from, and name it below. What is given here is invented.",
            "asperity --materials FILE bearings lists what the file holds; asperity --materials "
            "FILE shafts CASE takes it, where [worm_shaft] or [wheel_shaft] names it.",
        ),
    ),
    "plastic": DataFile(
        Plastic,
        "my POM",
        ("tests", "our tests, date"),
        "materials",
        {
            "youngs_modulus": '"2.6 GPa"',
            "poisson_ratio": "0.4",
            "friction": "0.12",
            "temperatures": '["23 degC", "60 degC", "90 degC"]',
            "cycles": "[1e5, 1e6, 1e7]",
            "root": """[
  ["30 MPa", "25 MPa", "20 MPa"],  # at 23 degC, for each of cycles
  ["22 MPa", "18 MPa", "14 MPa"],
  ["14 MPa", "11 MPa", "8 MPa"],
]""",
            "flank": """[
  ["60 MPa", "48 MPa", "38 MPa"],
  ["45 MPa", "36 MPa", "28 MPa"],
  ["30 MPa", "24 MPa", "18 MPa"],
]""",
            "wear_coefficient": '"1e-6 mm^3/(N*m)"',
            "wear_depth": '"0.3 mm"',
        },
        (
            "Plastics of wheels with a strength table of your own, begun by asperity new.",
            "No standard covers them: asperity rate judges a wheel by this table alone, and "
            "says so. Stresses are nominal ones by the formulas of ISO/TR 14521 (tau_F at the "
            "root, sigma_Hm on the flank): turn your tests into these. What is given here is "
            "invented.",
            "asperity --materials FILE rate CASE takes it, where gearset.wheel_material names "
            "it and operation.oil_temperature is the temperature of the teeth.",
        ),
    ),
}
"""By the name that ``asperity new`` takes."""
