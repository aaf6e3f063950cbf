"""A data file of plastics for wheels, begun for whoever has a strength table of his own."""

from asperity.gearset.plastics import Plastic
from asperity.start.data_file import data_text

KIND = "plastic"
"""The name that ``asperity new`` takes."""

NAME = "my POM"
_GIVEN = {
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
}
_REMARKS = (
    "Plastics of wheels with a strength table of your own, begun by asperity new.",
    "No standard covers them: asperity rate judges a wheel by this table alone, and says so. "
    "Stresses are nominal ones by the formulas of ISO/TR 14521 (tau_F at the root, sigma_Hm on "
    "the flank): turn your tests into these. What is given here is invented.",
    "asperity --materials FILE rate CASE takes it, where gearset.wheel_material names it and "
    "operation.oil_temperature is the temperature of the teeth.",
    "Every key that stands behind a # may be given as well.",
)


def plastic_text() -> str:
    """Return a commented data file with one plastic."""
    return data_text(_REMARKS, ("tests", "our tests, date"), ("plastic", NAME), Plastic, _GIVEN)
