"""How warm a housing gets by its own heat balance, beside the sump formula of the standard."""

from asperity.arrays import Real
from asperity.rating.inputs import Inputs, Values
from asperity.rating.iso14521 import balance


def uncounted(inputs: Inputs) -> str:
    """Return what is to be said of a duty other than S1 that cannot count; empty where it does."""
    spectrum, housing = inputs.operation.spectrum, inputs.operation.housing
    if spectrum is None or inputs.how.kind == "S1" or inputs.oil_temperature is not None:
        return ""
    if housing is not None and housing.capacity is not None:
        return ""
    duty = " ".join(spectrum.duty.split())
    return (
        f"{duty} does not count yet, temperature is judged as of S1: give [housing] with "
        "heat_capacity or masses"
    )


def housing_of(inputs: Inputs, v: Values) -> Real:
    """Find how warm the housing gets by its heat balance; returns the highest temperature, degC."""
    housing, spectrum = inputs.operation.housing, inputs.operation.spectrum
    assert housing is not None
    v["A_h_m2"] = housing.area
    if housing.area is None:
        v["A_h_m2"] = balance.AREAS[housing.area_rule](inputs.centre_distance)
    v["k_h_W_m2K"] = housing.heat_transfer
    v["K_h_W_K"] = balance.conductance(v["k_h_W_m2K"], v["A_h_m2"], housing.base)
    v["loss_heating_W"] = v.get("loss_max_W", v["loss_total_W"])
    if spectrum is not None and spectrum.oil == "mean" and inputs.duty:
        v["loss_heating_W"] = v["loss_mean_W"]
    v["rise_h_K"] = balance.steady_rise(v["loss_heating_W"], v["K_h_W_K"])
    # What the standard's own formula would ask the housing to give off.
    if inputs.oil_temperature is None:
        sump: Real = v.get("theta_S_max_degC", v["theta_S_degC"])
        by_formula = sump - inputs.ambient_temperature
        v["k_S_W_m2K"] = v["loss_heating_W"] / (by_formula * v["A_h_m2"])
    top = v["rise_h_K"]
    capacity = housing.capacity
    how = inputs.how
    if capacity is not None:
        v["tau_s"] = balance.time_constant(capacity, v["K_h_W_K"])
        if how.kind == "S2":
            top = v["rise_top_K"] = balance.rise_after(v["rise_h_K"], how.time, v["tau_s"])
        elif how.kind == "S3":
            rest = v["tau_s"]
            if housing.at_rest is not None:
                cooled = balance.conductance(housing.at_rest, v["A_h_m2"], housing.base)
                rest = balance.time_constant(capacity, cooled)
            cycle = inputs.cycle
            top = v["rise_top_K"] = balance.rise_in_cycles(
                v["rise_h_K"], how.share, cycle, v["tau_s"], rest
            )
            v["rise_low_K"] = balance.rise_before_load(top, how.share, cycle, rest)
    v["theta_h_degC"] = inputs.ambient_temperature + top
    return v["theta_h_degC"]
