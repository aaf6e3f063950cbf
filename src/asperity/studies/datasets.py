"""The studies as labelled datasets, every variable with ``units`` and ``long_name``."""

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

from asperity.studies.design import VARIABLES
from asperity.studies.quantities import varied_quantity

if TYPE_CHECKING:
    import xarray as xr

    from asperity.studies.catalogue import Catalogue
    from asperity.studies.comparison import Compared, Comparison
    from asperity.studies.sensitivity import Sensitivity
    from asperity.studies.shaken import Shaken
    from asperity.studies.tradeoff import TradeOff

_CATALOGUE = {
    "starts": ("1", "threads of the worm"),
    "wheel_teeth": ("1", "teeth of the wheel"),
    "diameter_factor": ("1", "diameter factor"),
    "axial_module_mm": ("mm", "axial module"),
    "profile_shift": ("1", "profile shift of the wheel"),
    "mu_zm": ("1", "mean coefficient of tooth friction"),
    "eta_z1_2": ("1", "efficiency of the teeth"),
    "eta_ges": ("1", "efficiency of the gearbox"),
    "M_w_Nm": ("N m", "torque permitted by wear"),
    "M_s_Nm": ("N m", "torque permitted by strength"),
    "safety_wear": ("1", "permitted torque over the one required, wear"),
    "safety_strength": ("1", "permitted torque over the one required, strength"),
}

Labelled = tuple[tuple[str, ...], Any, str, str]


def labelled(title: str, coordinates: dict[str, Labelled], **variables: Labelled) -> "xr.Dataset":
    """Return a dataset of variables given as (dimensions, values, units, long name)."""
    import xarray as xr

    def named(group: dict[str, Labelled]) -> dict[str, Any]:
        return {
            name: (dims, values, {"units": units, "long_name": long_name})
            for name, (dims, values, units, long_name) in group.items()
        }

    return xr.Dataset(named(variables), named(coordinates), {"title": title})


def words(values: Any) -> Any:
    """Return texts as an array that a dataset holds."""
    return np.array(list(values), dtype=object)


def sensitivity_dataset(study: "Sensitivity") -> "xr.Dataset":
    """Return efficiencies over input and rise, what ends them, and the elasticities."""
    found = study.influences
    both = ("input", "rise")
    ends = [np.nan if i.fails_above is None else 100.0 * i.fails_above for i in found]
    dataset = labelled(
        f"Sensitivity of the efficiency of {study.name or 'a worm gearset'}",
        {
            "input": (
                ("input",), words(i.quantity.name for i in found), "1", "input that is raised",
            ),
            "rise": (("rise",), 100.0 * study.rises, "percent", "rise of the input"),
        },
        symbol=(("input",), words(i.quantity.symbol for i in found), "1", "symbol of the input"),
        eta_z1_2=(
            both, np.array([i.efficiency for i in found]), "1", "efficiency of the teeth",
        ),
        reason=(
            both,
            np.array([[i.legend.get(int(code), "") for code in i.reason] for i in found], object),
            "1",
            "why there is no efficiency",
        ),
        elasticity=(
            ("input",), np.array([i.elasticity for i in found]), "1",
            "relative change of the efficiency over that of the input",
        ),
        fails_above=(
            ("input",), np.array(ends), "percent", "rise above which there is no efficiency",
        ),
        **{
            i.quantity.name: (("rise",), i.values, i.quantity.unit or "1", i.quantity.meaning)
            for i in found
        },
    )  # fmt: skip
    dataset.attrs["eta_z1_2"] = study.efficiency
    return dataset


def trade_off_dataset(curve: "TradeOff") -> "xr.Dataset":
    """Return the designs over the permissible torque."""
    over = ("torque",)
    dataset = labelled(
        f"Efficiency and permissible torque of {curve.name or 'a worm gearset'}",
        {"torque": (over, curve.torque, "N m", "permissible torque, by wear and strength")},
        eta_z1_2=(over, curve.efficiency, "1", "highest efficiency of the teeth"),
        h_star=(over, curve.numbers["h_star"], "1", "parameter of the lubricant film"),
        M_w=(over, curve.numbers["M_w_Nm"], "N m", "torque permitted by wear"),
        M_s=(over, curve.numbers["M_s_Nm"], "N m", "torque permitted by strength"),
        **{
            what.name: (over, curve.numbers[what.key], what.unit or "1", what.meaning)
            for what in map(varied_quantity, (*VARIABLES, "profile_shift"))
        },
    )
    given = {f"given.{key}": value for key, value in curve.given.items()}
    dataset.attrs |= given | {"required_torque_Nm": curve.required_torque}
    return dataset


def comparison_dataset(comparison: "Comparison") -> "xr.Dataset":
    """Return friction, efficiencies and vibrations over the methods."""
    rows, over = comparison.rows, ("way",)

    def column(get: Callable[["Compared"], float]) -> Any:
        return np.array([get(row) for row in rows])

    def imposed(get: Callable[["Shaken"], float]) -> Any:
        return np.array([np.nan if r.vibration is None else get(r.vibration) for r in rows])

    dataset = labelled(
        f"Ways to less friction in {comparison.name or 'a worm gearset'}",
        {"way": (over, words(r.key for r in rows), "1", "way to less friction")},
        name=(over, words(r.name for r in rows), "1", "what it is"),
        kind=(over, words(r.kind for r in rows), "1", "family"),
        source=(over, words(str(r.source) for r in rows), "1", "who reports its friction"),
        mu_0T=(over, column(lambda r: r.base_friction), "1", "base coefficient of friction"),
        mu_zm=(over, column(lambda r: r.friction), "1", "mean coefficient of tooth friction"),
        eta_z1_2=(over, column(lambda r: r.efficiency), "1", "efficiency of the teeth"),
        eta_ges=(over, column(lambda r: r.total_efficiency), "1", "efficiency of the gearbox"),
        eta_z2_1=(
            over, column(lambda r: r.back_driving_efficiency), "1",
            "efficiency of the teeth, wheel driving",
        ),
        velocity_ratio=(
            over, imposed(lambda v: v.velocity_ratio), "1",
            "peak velocity of the vibration over the sliding velocity",
        ),
        velocity_amplitude=(
            over, imposed(lambda v: v.velocity), "m/s", "peak velocity of the vibration",
        ),
        vibration_power=(
            over, column(lambda r: r.vibration_power), "W", "power of the vibration",
        ),
        eta_z1_2_with_power=(
            over, column(lambda r: r.efficiency_with_vibration), "1",
            "efficiency of the teeth with the power of the vibration counted",
        ),
    )  # fmt: skip
    dataset.attrs |= {
        "sliding_velocity_m_s": comparison.sliding_velocity,
        "output_power_W": comparison.output_power,
        "notes": "; ".join(comparison.notes),
    }
    return dataset


def catalogue_dataset(catalogue: "Catalogue") -> "xr.Dataset":
    """Return the proposals over ratio and centre distance."""
    both = ("ratio", "centre_distance")
    named = {key: (both, values, *_CATALOGUE[key]) for key, values in catalogue.numbers.items()}
    return labelled(
        "Most efficient worm gearsets of a catalogue",
        {
            "ratio": (("ratio",), catalogue.ratios, "1", "gear ratio asked for"),
            "centre_distance": (
                ("centre_distance",), catalogue.centre_distances, "m", "centre distance",
            ),
        },
        candidates=(both, catalogue.candidates, "1", "gearsets that were rated"),
        reason=(both, catalogue.reason, "1", "why there is no proposal"),
        **{key.removesuffix("_Nm").removesuffix("_mm"): value for key, value in named.items()},
    )  # fmt: skip
