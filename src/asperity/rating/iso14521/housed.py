"""How warm a housing gets by its own heat balance, beside the sump formula of the standard."""

from asperity.arrays import Real
from asperity.rating.inputs import Inputs, Values
from asperity.rating.iso14521 import balance


def housing_of(given: Inputs, v: Values) -> Real:
    """Find how warm the housing gets by its heat balance; returns the highest temperature, degC."""
    housing, spectrum = given.operation.housing, given.operation.spectrum
    assert housing is not None
    v["A_h_m2"] = housing.area
    if housing.area is None:
        v["A_h_m2"] = balance.AREAS[housing.area_rule](given.centre_distance)
    v["k_h_W_m2K"] = housing.heat_transfer
    v["K_h_W_K"] = balance.conductance(v["k_h_W_m2K"], v["A_h_m2"], housing.base)
    v["loss_heating_W"] = v.get("loss_max_W", v["loss_total_W"])
    if spectrum is not None and spectrum.oil_temperature == "mean" and given.duty:
        v["loss_heating_W"] = v["loss_mean_W"]
    v["rise_h_K"] = balance.steady_rise(v["loss_heating_W"], v["K_h_W_K"])
    # What the standard's own formula would ask the housing to give off.
    if given.oil_temperature is None:
        sump: Real = v.get("theta_S_max_degC", v["theta_S_degC"])
        by_formula = sump - given.ambient_temperature
        v["k_S_W_m2K"] = v["loss_heating_W"] / (by_formula * v["A_h_m2"])
    top = v["rise_h_K"]
    capacity = housing.capacity
    how = spectrum.how if spectrum is not None else None
    if capacity is not None:
        v["tau_s"] = balance.time_constant(capacity, v["K_h_W_K"])
        if how is not None and how.kind == "S2":
            top = v["rise_top_K"] = balance.rise_after(v["rise_h_K"], how.time, v["tau_s"])
        elif how is not None and how.kind == "S3":
            rest = v["tau_s"]
            if housing.at_rest is not None:
                cooled = balance.conductance(housing.at_rest, v["A_h_m2"], housing.base)
                rest = balance.time_constant(capacity, cooled)
            cycle = given.cycle
            top = v["rise_top_K"] = balance.rise_in_cycles(
                v["rise_h_K"], how.share, cycle, v["tau_s"], rest
            )
            v["rise_low_K"] = balance.rise_before_load(top, how.share, cycle, rest)
    v["theta_h_degC"] = given.ambient_temperature + top
    return v["theta_h_degC"]
