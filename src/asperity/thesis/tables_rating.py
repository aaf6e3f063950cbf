"""Tables 3.2 to 3.7, as far as their inputs survive, each row with what the thesis says of it."""

from collections.abc import Mapping
from typing import NamedTuple

from asperity.rating.result import Rating
from asperity.thesis.exhibits import Cell, Grid, TableOf
from asperity.thesis.gearsets import GEARSET_2

_STATED = "stated"
_LOST = "lost"


class _Row(NamedTuple):
    """A row: the standard and key of its number, what the thesis says, and where it is from."""

    standard: str
    key: str
    thesis: str
    origin: str


def _cells(ratings: Mapping[str, Rating], row: _Row) -> tuple[Cell, ...]:
    entry = ratings[row.standard].entry(row.key)
    return entry.symbol, entry.meaning, entry.value, entry.unit


_COMPUTED = "computed"
_FROM_ETA = "inferred from eta_z, with the other two of q1, m_x1 and c"

_TABLE_3_2 = (
    _Row("iso14521", "centre_distance_mm", _LOST, _FROM_ETA),
    _Row("iso14521", "gear_ratio", _LOST,
         "inferred from where the calculation fails (3.2.3)"),
    _Row("iso14521", "starts", "1", "stated (3.2.3)"),
    _Row("iso14521", "wheel_teeth", _LOST, "inferred with the ratio"),
    _Row("iso14521", "diameter_factor", _LOST, _FROM_ETA),
    _Row("iso14521", "axial_module_mm", _LOST, _FROM_ETA),
    _Row("iso14521", "pressure_angle_deg", _LOST, "assumed: the guideline of BS 721 (3.2.1)"),
    _Row("iso14521", "worm_speed_rpm", _LOST, "assumed: that of gearset 3 (7.4.1)"),
    _Row("iso14521", "worm_roughness_um", _LOST, "inferred for gearset 3, equal for all (3.3.4)"),
    _Row("iso14521", "output_torque_Nm", _LOST, "inferred from eta_ges"),
    _Row("iso14521", "nu_40_mm2_s", _LOST,
         "assumed: a stand-in, Table 6.9 is lost; without influence on efficiency"),
    _Row("iso14521", "nu_100_mm2_s", _LOST,
         "assumed: a stand-in, Table 6.9 is lost; without influence on efficiency"),
    _Row("iso14521", "Y_W", _LOST, "inferred: the alloy's, from the table of the standard"),
    _Row("iso14521", "lead_angle_deg", _LOST, _COMPUTED),
    _Row("iso14521", "profile_shift", _LOST, _COMPUTED),
    _Row("iso14521", "sliding_velocity_m_s", _LOST, _COMPUTED),
    _Row("iso14521", "mu_0T", "0.0715", _COMPUTED),
    _Row("iso14521", "Y_S", _LOST, _COMPUTED),
    _Row("iso14521", "h_star", _LOST, _COMPUTED),
    _Row("iso14521", "Y_G", _LOST, _COMPUTED),
    _Row("iso14521", "Y_R", _LOST, _COMPUTED),
    _Row("iso14521", "mu_zm", _LOST, _COMPUTED),
    _Row("iso14521", "eta_z1_2", "38 %", _COMPUTED),
    _Row("iso14521", "output_power_W", _LOST, _COMPUTED),
    _Row("iso14521", "loss_meshing_W", _LOST, _COMPUTED),
    _Row("iso14521", "loss_idle_W", _LOST, _COMPUTED),
    _Row("iso14521", "loss_bearing_W", _LOST, _COMPUTED),
    _Row("iso14521", "loss_seal_W", _LOST, _COMPUTED),
    _Row("iso14521", "eta_ges", "31 %", _COMPUTED),
)  # fmt: skip


def table_3_2() -> Grid:
    """Inputs and results of the efficiency of gearset 2."""
    ratings = GEARSET_2.ratings()
    return Grid(
        ("symbol", "quantity", "value", "unit", "thesis", "here"),
        tuple((*_cells(ratings, row), row.thesis, row.origin) for row in _TABLE_3_2),
        (GEARSET_2.command(),),
    )


_KEYS_3_5 = ()

TABLES = (
    TableOf(
        "3.2", "Efficiency of gearset 2: inputs and results",
        "By ISO/TR 14521. The thesis's table is lost; of its numbers the text repeats those in the "
        "column “thesis”.",
        (GEARSET_2.case,), table_3_2,
    ),
)  # fmt: skip
