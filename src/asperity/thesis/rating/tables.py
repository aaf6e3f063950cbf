"""Tables 3.2 to 3.7, as far as their inputs survive, each row with what the thesis says of it."""

import dataclasses
import math
from typing import NamedTuple

from asperity.rating import Rated
from asperity.rating.result import Entry
from asperity.thesis.exhibits import Cell, Grid
from asperity.thesis.rating.rated import (
    GEARSET_2,
    GEARSETS,
    comparison_of,
    methods_of_thesis,
    optimum_of,
    sensitivity_of,
)

_BY = {"agma6034": ", AGMA 6034", "bs721": ", BS 721"}


class _Row(NamedTuple):
    """A number of a rating, what survives of it in the thesis, and where the one here is from."""

    standard: str
    key: str
    thesis: str = "lost"
    here: str = "computed"

    def entry(self, rated: Rated) -> Entry:
        entry = rated.found[self.standard].entry(self.key)
        by = _BY.get(self.standard, "")
        return dataclasses.replace(entry, meaning=f"{entry.meaning}{by}")


_FROM_ETA = "inferred from eta_z, with the other two of q_1, m_x1 and a"
_STAND_IN = "assumed: Table 6.9 is lost; without influence on efficiency"

_TABLE_3_2 = (
    _Row("iso14521", "centre_distance_mm", here=_FROM_ETA),
    _Row("iso14521", "gear_ratio", here="inferred from where the calculation fails (3.2.3)"),
    _Row("iso14521", "starts", "1 (3.2.3)", "stated"),
    _Row("iso14521", "wheel_teeth", here="inferred with the ratio"),
    _Row("iso14521", "diameter_factor", here=_FROM_ETA),
    _Row("iso14521", "axial_module_mm", here=_FROM_ETA),
    _Row("iso14521", "pressure_angle_deg", here="assumed: the guideline of BS 721 (3.2.1)"),
    _Row("iso14521", "worm_speed_rpm", here="assumed: that of gearset 3 (7.2.4)"),
    _Row("iso14521", "worm_roughness_um", here="inferred for gearset 3, equal for all (3.3.4)"),
    _Row("iso14521", "output_torque_Nm", here="inferred from eta_ges"),
    _Row("iso14521", "nu_40_mm2_s", here=_STAND_IN),
    _Row("iso14521", "nu_100_mm2_s", here=_STAND_IN),
    _Row("iso14521", "Y_W", here="inferred: aluminium bronze (7.2.2), equal for all (3.3.4)"),
    _Row("iso14521", "lead_angle_deg"),
    _Row("iso14521", "profile_shift"),
    _Row("iso14521", "sliding_velocity_m_s"),
    _Row("iso14521", "mu_0T", "0.0715 (3.2.2)"),
    _Row("iso14521", "Y_S"),
    _Row("iso14521", "h_star"),
    _Row("iso14521", "Y_G"),
    _Row("iso14521", "Y_R"),
    _Row("iso14521", "mu_zm"),
    _Row("iso14521", "eta_z1_2", "38 % (3.2.1)"),
    _Row("iso14521", "output_power_W"),
    _Row("iso14521", "loss_meshing_W"),
    _Row("iso14521", "loss_idle_W"),
    _Row("iso14521", "loss_bearing_W"),
    _Row("iso14521", "loss_seal_W"),
    _Row("iso14521", "eta_ges", "31 % (3.2.1)"),
)


def table_3_3() -> Grid:
    """Friction and efficiency of gearset 2 with each way to less friction."""
    study = comparison_of(GEARSET_2)
    quoted = {method.key: method for method in methods_of_thesis()}
    rows = []
    for row in study.rows:
        method, thesis = quoted.get(row.key), "not in the thesis"
        if row is study.rows[0]:
            thesis = "0.0715"
        elif method is not None and method.reduction is not None:
            thesis = f"{100.0 * method.reduction:.0f} % less"
        elif method is not None:
            thesis = f"{method.base_friction:.4f}"
        moved = row.vibration
        rows.append(
            (
                row.name,
                row.kind,
                thesis,
                row.base_friction,
                row.friction,
                row.efficiency,
                100.0 * row.gain,
                "" if moved is None else moved.velocity_ratio,
                "" if moved is None else row.efficiency_with_vibration,
                str(row.source),
            )
        )
    columns = (
        "method", "kind", "mu_0T by the thesis", "mu_0T", "mu_zm", "eta_z", "gain, points",
        "v_a over v_g",
        "eta_z with the vibration's power", "source",
    )  # fmt: skip
    return Grid(columns, tuple(rows), (GEARSET_2.command("methods"),))


_EFFECTS = {
    "pressure_angle": "raises, small",
    "centre_distance": "raises, most of all",
    "worm_speed": "raises",
    "gear_ratio": "lowers; fails above 27 %",
    "diameter_factor": "lowers",
    "axial_module": "lowers; fails above 37 %",
    "worm_roughness": "lowers, small",
}

_INFERRED = "inferred"
_TABLE_3_5 = (
    _Row("iso14521", "centre_distance_mm", "grows from gearset 1 to 4", _INFERRED),
    _Row("iso14521", "gear_ratio", "gearset 3: 15 (1440 and 96 rpm, 7.4.1)",
         "gearset 3: stated; 2: inferred"),
    _Row("iso14521", "starts", "gearset 2: 1", "gearset 2: stated; 3: from ratio and teeth"),
    _Row("iso14521", "wheel_teeth", "gearset 3: 60 (7.2.2)", "gearset 3: stated; 2: inferred"),
    _Row("iso14521", "diameter_factor", here=_INFERRED),
    _Row("iso14521", "axial_module_mm", here=_INFERRED),
    _Row("iso14521", "pressure_angle_deg", here="assumed: the guideline of BS 721 (3.2.1)"),
    _Row("iso14521", "worm_speed_rpm", "gearset 3: 1440 (7.2.4)",
         "gearset 3: stated; 2: assumed"),
    _Row("iso14521", "worm_roughness_um", "the same for all", _INFERRED),
    _Row("iso14521", "Y_W", "the same for all", "inferred from the alloy"),
    _Row("iso14521", "output_torque_Nm", "gearset 3: 366 (7.2.4)",
         "gearset 3: stated; 2: inferred"),
    _Row("iso14521", "through_travel_torque_Nm", "usually a third of T_R (3.2.1)", "a third"),
    _Row("iso14521", "sliding_velocity_m_s", "grows; gearset 3: 1.5108 (7.2.4)"),
    _Row("iso14521", "mu_0T", "gearset 2: 0.0715"),
    _Row("iso14521", "mu_zm", "gearset 3: 0.1344 (7.2.4)"),
    _Row("iso14521", "eta_z1_2", "38 %; 73 % (7.4.1)"),
    _Row("iso14521", "eta_ges", "gearset 2: 31 %; below eta_z"),
    _Row("agma6034", "mu"),
    _Row("agma6034", "eta", "much higher than eta_z"),
    _Row("bs721", "M_26k_Nm", "below T_G,all"),
    _Row("bs721", "M_w_Nm", "above M_26k and T_2"),
    _Row("bs721", "M_s_Nm", "above M_26k and T_R"),
    _Row("agma6034", "allowable_torque_Nm", "above M_26k"),
    _Row(
        "agma6034",
        "bending_stress_MPa",
        "does not grow with T_R (3.3.4)",
        "computed; grows here from 2 to 3, with the inferred torque of gearset 2",
    ),
    _Row("iso14521", "sigma_line_MPa", "gearset 3: 778 (7.2.4)",
         "computed as a Hertz line contact"),
    _Row("iso14521", "sigma_Hm_MPa", here="computed by ISO/TR 14521"),
)  # fmt: skip


def table_3_2() -> Grid:
    """Inputs and results of the efficiency of gearset 2."""
    rows = []
    for row in _TABLE_3_2:
        entry = row.entry(GEARSET_2.rated())
        rows.append((entry.symbol, entry.meaning, entry.value, entry.unit, row.thesis, row.here))
    columns = ("symbol", "quantity", "value", "unit", "thesis", "here")
    return Grid(columns, tuple(rows), (GEARSET_2.command(),))


def table_3_4() -> Grid:
    """What each input does to the efficiency of gearset 2."""
    rows = []
    for found in sensitivity_of(GEARSET_2).influences:
        what = found.quantity
        last = float(found.efficiency[-1])
        rows.append(
            (
                what.symbol,
                what.meaning,
                float(found.values[0]),
                what.unit,
                found.effect,
                found.size,
                found.elasticity,
                "" if math.isnan(last) else last,
                "" if found.fails_above is None else 100.0 * found.fails_above,
                _EFFECTS[what.name],
            )
        )
    columns = (
        "symbol", "quantity", "value", "unit", "effect", "size", "elasticity",
        "eta_z at +40 %", "fails above, %", "thesis",
    )  # fmt: skip
    return Grid(columns, tuple(rows), (GEARSET_2.command("sensitivity"),))


def table_3_5() -> Grid:
    """Inputs and results of gearsets 2 and 3 as they are."""
    rows = []
    for row in _TABLE_3_5:
        entries = [row.entry(gear.rated()) for gear in GEARSETS.values()]
        first, values = entries[0], [entry.value for entry in entries]
        rows.append((first.symbol, first.meaning, first.unit, *values, row.thesis, row.here))
    columns = ("symbol", "quantity", "unit", *GEARSETS, "thesis", "here")
    return Grid(columns, tuple(rows), tuple(gear.command() for gear in GEARSETS.values()))


_BOUNDS = {
    "M_w": ("N m", "not lower than before (3.3.5)", "stated"),
    "M_s": ("N m", "not lower than before (3.3.5)", "stated"),
    "h*": ("", "lost", "the standard's own"),
    "alpha_n": ("deg", "30 deg reached (3.3.5)", "assumed"),
    "q_1": ("", "6 to 12 advised (3.2.1)", "assumed"),
    "m_x1": ("mm", "changes are small (3.3.5)", "assumed: 5 %"),
    "Ra_1": ("um", "0.8 um reached (3.3.5)", "assumed"),
    "x_2": ("", "lost", "assumed"),
}


def table_3_6() -> Grid:
    """Constraints of the optimum."""
    rows = []
    for name, gear in GEARSETS.items():
        limits = optimum_of(gear).limits
        for symbol in dict.fromkeys(limit.symbol for limit in limits):
            own = [limit for limit in limits if limit.symbol == symbol]
            below: list[Cell] = [limit.bound for limit in own if limit.relation != "<="]
            above: list[Cell] = [limit.bound for limit in own if limit.relation == "<="]
            active = [limit for limit in own if limit.active]
            unit, thesis, here = _BOUNDS[symbol]
            rows.append(
                (
                    name,
                    symbol,
                    *(below or [""]),
                    *(above or [""]),
                    own[0].value,
                    unit,
                    "holds it back" if active else "",
                    thesis,
                    here,
                )
            )
    columns = (
        "gearset", "symbol", "at least", "at most", "optimum", "unit", "effect", "thesis",
        "bounds here",
    )  # fmt: skip
    return Grid(columns, tuple(rows), _OPTIMISED)


_TABLE_3_7 = (
    _Row("iso14521", "pressure_angle_deg", "30 for all"),
    _Row("iso14521", "diameter_factor", "rises for gearset 3 only"),
    _Row("iso14521", "axial_module_mm", "changes are small"),
    _Row("iso14521", "worm_roughness_um", "0.8"),
    _Row("iso14521", "profile_shift"),
    _Row("iso14521", "mu_zm"),
    _Row("iso14521", "eta_z1_2", "rises for all; 7 % more, to 45 % (3.4)"),
    _Row("iso14521", "eta_ges"),
    _Row("agma6034", "mu"),
    _Row("agma6034", "eta", "does not rise for all"),
    _Row("bs721", "M_26k_Nm", "close to T_G,all"),
    _Row("bs721", "M_w_Nm", "rises slightly"),
    _Row("bs721", "M_s_Nm", "unchanged"),
    _Row("agma6034", "allowable_torque_Nm"),
    _Row("agma6034", "bending_stress_MPa", "rises for gearset 3 only"),
    _Row("iso14521", "sigma_line_MPa"),
)


def table_3_7() -> Grid:
    """Gearsets 2 and 3 as they are and at the optimum."""
    designs: dict[str, Rated] = {}
    for name, gear in GEARSETS.items():
        optimum = optimum_of(gear)
        designs |= {name: optimum.before, f"{name}, optimum": optimum.after}
    rows = []
    for row in _TABLE_3_7:
        entries = [row.entry(rated) for rated in designs.values()]
        first, values = entries[0], [entry.value for entry in entries]
        rows.append((first.symbol, first.meaning, first.unit, *values, row.thesis))
    return Grid(("symbol", "quantity", "unit", *designs, "thesis"), tuple(rows), _OPTIMISED)


_OPTIMISED = tuple(gear.command("optimise") for gear in GEARSETS.values())
