"""Tables 3.2 to 3.7, as far as their inputs survive, each row with what the thesis says of it."""

import functools
import math
from collections.abc import Callable
from typing import Any, NamedTuple

from asperity.rating import Rated
from asperity.rating.result import Entry
from asperity.studies.limits import Limit
from asperity.thesis.exhibits import table
from asperity.thesis.products import Grid
from asperity.thesis.rating.rated import GEARSET_2, GEARSETS, OPTIMISED, quoted_methods

_BY = {"agma6034": ", AGMA 6034", "bs721": ", BS 721"}


class _Row(NamedTuple):
    """A number of a rating, what survives of it in the thesis, and where the one here is from."""

    key: str
    thesis: str = "lost"
    here: str = "computed"
    standard: str = "iso14521"

    def entry(self, rated: Rated) -> Entry:
        return rated.found[self.standard].entry(self.key)

    def meaning(self, rated: Rated) -> str:
        return f"{self.entry(rated).meaning}{_BY.get(self.standard, '')}"


_FROM_ETA = "inferred from eta_z, with the other two of q_1, m_x1 and a"
_STAND_IN = "assumed: Table 6.9 is lost; without influence on efficiency"

_TABLE_3_2 = (
    _Row("centre_distance_mm", here=_FROM_ETA),
    _Row("gear_ratio", here="inferred from where the calculation fails (3.2.3)"),
    _Row("starts", "1 (3.2.3)", "stated"),
    _Row("wheel_teeth", here="inferred with the ratio"),
    _Row("diameter_factor", here=_FROM_ETA),
    _Row("axial_module_mm", here=_FROM_ETA),
    _Row("pressure_angle_deg", here="assumed: the guideline of BS 721 (3.2.1)"),
    _Row("worm_speed_rpm", here="assumed: that of gearset 3 (7.2.4)"),
    _Row("worm_roughness_um", here="inferred for gearset 3, equal for all (3.3.4)"),
    _Row("output_torque_Nm", here="inferred from eta_ges"),
    _Row("nu_40_mm2_s", here=_STAND_IN),
    _Row("nu_100_mm2_s", here=_STAND_IN),
    _Row("Y_W", here="inferred: aluminium bronze (7.2.2), equal for all (3.3.4)"),
    _Row("lead_angle_deg"),
    _Row("profile_shift"),
    _Row("sliding_velocity_m_s"),
    _Row("mu_0T", "0.0715 (3.2.2)"),
    _Row("Y_S"),
    _Row("h_star"),
    _Row("Y_G"),
    _Row("Y_R"),
    _Row("mu_zm"),
    _Row("eta_z1_2", "38 % (3.2.1)"),
    _Row("output_power_W"),
    _Row("loss_meshing_W"),
    _Row("loss_idle_W"),
    _Row("loss_bearing_W"),
    _Row("loss_seal_W"),
    _Row("eta_ges", "31 % (3.2.1)"),
)


@table("3.2")
def _efficiency() -> Grid:
    rated = GEARSET_2.rated
    return Grid.of(
        _TABLE_3_2,
        {
            "symbol": lambda row: row.entry(rated).symbol,
            "quantity": lambda row: row.meaning(rated),
            "value": lambda row: row.entry(rated).value,
            "unit": lambda row: row.entry(rated).unit,
            "thesis": lambda row: row.thesis,
            "here": lambda row: row.here,
        },
        GEARSET_2,
    )


@table("3.3")
def _methods() -> Grid:
    study = GEARSET_2.comparison
    quoted = {study.rows[0].key: "0.0715"}
    for method in quoted_methods():
        less = method.reduction
        number = f"{method.base_friction:.4f}" if less is None else f"{100.0 * less:.0f} % less"
        quoted.setdefault(method.key, number)
    return Grid.of(
        study.rows,
        {
            "method": lambda row: row.name,
            "kind": lambda row: row.kind,
            "mu_0T by the thesis": lambda row: quoted.get(row.key, "not in the thesis"),
            "mu_0T": lambda row: row.base_friction,
            "mu_zm": lambda row: row.friction,
            "eta_z": lambda row: row.efficiency,
            "gain, points": lambda row: 100.0 * row.gain,
            "v_a over v_g": lambda row: row.vibration and row.vibration.velocity_ratio,
            "eta_z with the vibration's power": lambda row: (
                row.vibration and row.efficiency_with_vibration
            ),
            "source": lambda row: str(row.source),
        },
        GEARSET_2.command("methods"),
    )


_EFFECTS = {
    "pressure_angle": "raises, small",
    "centre_distance": "raises, most of all",
    "worm_speed": "raises",
    "gear_ratio": "lowers; fails above 27 %",
    "diameter_factor": "lowers",
    "axial_module": "lowers; fails above 37 %",
    "worm_roughness": "lowers, small",
}


@table("3.4")
def _influences() -> Grid:
    return Grid.of(
        GEARSET_2.sensitivity.influences,
        {
            "symbol": lambda found: found.quantity.symbol,
            "quantity": lambda found: found.quantity.meaning,
            "value": lambda found: float(found.values[0]),
            "unit": lambda found: found.quantity.unit,
            "effect": lambda found: found.effect,
            "size": lambda found: found.size,
            "elasticity": lambda found: found.elasticity,
            "eta_z at +40 %": lambda found: _number(float(found.efficiency[-1])),
            "fails above, %": lambda found: found.fails_above and 100.0 * found.fails_above,
            "thesis": lambda found: _EFFECTS[found.quantity.name],
        },
        GEARSET_2.command("sensitivity"),
    )


def _number(value: float) -> float | None:
    return None if math.isnan(value) else value


_INFERRED = "inferred"
_GROWS = "computed; grows here from 2 to 3, with the inferred torque of gearset 2"
_TABLE_3_5 = (
    _Row("centre_distance_mm", "grows from gearset 1 to 4", _INFERRED),
    _Row("gear_ratio", "gearset 3: 15 (1440 and 96 rpm, 7.4.1)", "gearset 3: stated; 2: inferred"),
    _Row("starts", "gearset 2: 1", "gearset 2: stated; 3: from ratio and teeth"),
    _Row("wheel_teeth", "gearset 3: 60 (7.2.2)", "gearset 3: stated; 2: inferred"),
    _Row("diameter_factor", here=_INFERRED),
    _Row("axial_module_mm", here=_INFERRED),
    _Row("pressure_angle_deg", here="assumed: the guideline of BS 721 (3.2.1)"),
    _Row("worm_speed_rpm", "gearset 3: 1440 (7.2.4)", "gearset 3: stated; 2: assumed"),
    _Row("worm_roughness_um", "the same for all", _INFERRED),
    _Row("Y_W", "the same for all", "inferred from the alloy"),
    _Row("output_torque_Nm", "gearset 3: 366 (7.2.4)", "gearset 3: stated; 2: inferred"),
    _Row("through_travel_torque_Nm", "usually a third of T_R (3.2.1)", "a third"),
    _Row("sliding_velocity_m_s", "grows; gearset 3: 1.5108 (7.2.4)"),
    _Row("mu_0T", "gearset 2: 0.0715"),
    _Row("mu_zm", "gearset 3: 0.1344 (7.2.4)"),
    _Row("eta_z1_2", "38 %; 73 % (7.4.1)"),
    _Row("eta_ges", "gearset 2: 31 %; below eta_z"),
    _Row("mu", standard="agma6034"),
    _Row("eta", standard="agma6034", thesis="much higher than eta_z"),
    _Row("M_26k_Nm", standard="bs721", thesis="below T_G,all"),
    _Row("M_w_Nm", standard="bs721", thesis="above M_26k and T_2"),
    _Row("M_s_Nm", standard="bs721", thesis="above M_26k and T_R"),
    _Row("allowable_torque_Nm", standard="agma6034", thesis="above M_26k"),
    _Row("bending_stress_MPa", "does not grow with T_R (3.3.4)", _GROWS, "agma6034"),
    _Row("sigma_line_MPa", "gearset 3: 778 (7.2.4)", "computed as a Hertz line contact"),
    _Row("sigma_Hm_MPa", here="computed by ISO/TR 14521"),
)


@table("3.5")
def _as_they_are() -> Grid:
    rated = {name: gear.rated for name, gear in GEARSETS.items()}
    columns = _beside(rated) | {"here": lambda row: row.here}
    return Grid.of(_TABLE_3_5, columns, *GEARSETS.values())


def _beside(rated: dict[str, Rated]) -> dict[str, Callable[[_Row], Any]]:
    """Columns of gearsets beside each other."""
    first = next(iter(rated.values()))
    return {
        "symbol": lambda row: row.entry(first).symbol,
        "quantity": lambda row: row.meaning(first),
        "unit": lambda row: row.entry(first).unit,
        **{name: functools.partial(_value, one) for name, one in rated.items()},
        "thesis": lambda row: row.thesis,
    }


def _value(rated: Rated, row: _Row) -> Any:
    return row.entry(rated).value


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


@table("3.6")
def _constraints() -> Grid:
    limits: dict[tuple[str, str], list[Limit]] = {}
    for name, gear in GEARSETS.items():
        for limit in gear.optimum.limits:
            limits.setdefault((name, limit.symbol), []).append(limit)

    def bound(own: list[Limit], *, above: bool) -> float | None:
        return next((one.bound for one in own if (one.relation == "<=") is above), None)

    return Grid.of(
        limits,
        {
            "gearset": lambda at: at[0],
            "symbol": lambda at: at[1],
            "at least": lambda at: bound(limits[at], above=False),
            "at most": lambda at: bound(limits[at], above=True),
            "optimum": lambda at: limits[at][0].value,
            "unit": lambda at: _BOUNDS[at[1]][0],
            "effect": lambda at: "holds it back" if any(one.active for one in limits[at]) else "",
            "thesis": lambda at: _BOUNDS[at[1]][1],
            "bounds here": lambda at: _BOUNDS[at[1]][2],
        },
        *OPTIMISED,
    )


_TABLE_3_7 = (
    _Row("pressure_angle_deg", "30 for all"),
    _Row("diameter_factor", "rises for gearset 3 only"),
    _Row("axial_module_mm", "changes are small"),
    _Row("worm_roughness_um", "0.8"),
    _Row("profile_shift"),
    _Row("mu_zm"),
    _Row("eta_z1_2", "rises for all; 7 % more, to 45 % (3.4)"),
    _Row("eta_ges"),
    _Row("mu", standard="agma6034"),
    _Row("eta", standard="agma6034", thesis="does not rise for all"),
    _Row("M_26k_Nm", standard="bs721", thesis="close to T_G,all"),
    _Row("M_w_Nm", standard="bs721", thesis="rises slightly"),
    _Row("M_s_Nm", standard="bs721", thesis="unchanged"),
    _Row("allowable_torque_Nm", standard="agma6034"),
    _Row("bending_stress_MPa", standard="agma6034", thesis="rises for gearset 3 only"),
    _Row("sigma_line_MPa"),
)


@table("3.7")
def _at_the_optimum() -> Grid:
    designs: dict[str, Rated] = {}
    for name, gear in GEARSETS.items():
        optimum = gear.optimum
        designs |= {name: optimum.before, f"{name}, optimum": optimum.after}
    return Grid.of(_TABLE_3_7, _beside(designs), *OPTIMISED)
