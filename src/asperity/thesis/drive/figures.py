"""Figures 7.10 and 7.12 to 7.15: the shaken gearset, read as the thesis does and in balance."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from asperity.arrays import FloatArray
from asperity.results.dataset import described
from asperity.slider.closed_forms import longitudinal_ratio, transverse_ratio
from asperity.thesis.drive import drawings
from asperity.thesis.drive.marches import Shaken
from asperity.thesis.drive.sets import RATIOS, SHAKEN, UNSHAKEN, conditions
from asperity.thesis.drive.simulations import (
    ACTUATOR,
    COULOMB,
    MESHES,
    Simulation,
    of_set,
    on_mesh,
    simulation,
)
from asperity.thesis.exhibits import Computed, figure

_CYCLES, _FIRST, _ROWS = 120, 10, 120


def over_ratio(groups: dict[str, Sequence[Simulation]]) -> dict[str, Any]:
    """Return the readings of some sets of simulations, as variables of a dataset."""
    found = {name: [one.shaken() for one in group] for name, group in groups.items()}
    place = ("series", "k")

    def values(of: str) -> FloatArray:
        return np.array([[getattr(one, of) for one in group] for group in found.values()])

    return {
        "series": (("series",), np.array([*found], dtype=object), "1", "what is compared"),
        "k": (("k",), np.array(RATIOS), "1", "velocity ratio v_a/v_g"),
        "ratio": (place, values("ratio"), "1", "mean torque at the end over that without"),
        "settled": (
            place, values("settled").astype(float), "1", "whether the end is periodic and balanced",
        ),
        "balance": (place, values("balance"), "1", "mean wheel torque at the end over T_R, less 1"),
        "window": (place, values("window"), "1", "torque of three first cycles over that without"),
        "window_balance": (
            place, values("window_balance"), "1", "wheel torque of these over T_R, less 1",
        ),
        "open": (place, values("open"), "1", "share of time without contact"),
        "second": (place, values("second"), "1", "share of time on the other flank"),
        "force": (place, values("force"), "N", "greatest normal force"),
    }  # fmt: skip


def floor() -> float:
    """Return the ratio with all friction reversed."""
    from asperity.thesis.drive.claims import band

    low, _, high = band()
    return low / high


def _read(groups: dict[str, Sequence[Simulation]]) -> Computed:
    dataset = described(
        **over_ratio(groups), floor=((), floor(), "1", "ratio with all friction reversed")
    )
    return dataset, [one for group in groups.values() for one in group]


@figure("7.12", drawings.ratios)
def _meshes() -> Computed:
    dataset, how = _read({name: on_mesh(name) for name in MESHES})
    point = described(thesis=((), SHAKEN / UNSHAKEN, "1", "ratio of the thesis at k_w = 20"))
    return dataset.merge(point), how


@figure("7.13", drawings.ratios)
def _slow() -> Computed:
    return _read({"set 1, 59 mm/s": of_set(1), "set 2, 87 mm/s": of_set(2)})


@figure("7.14", drawings.laws)
def _laws() -> Computed:
    from asperity.thesis.drive.laws import HOW, at_ratios

    dataset, how = _read({"Dahl": of_set(3), "Coulomb": of_set(3, COULOMB)})
    means = described(
        law=(("law",), np.array(["Appendix E", "Dahl", "Coulomb"], dtype=object), "1", "law"),
        k=(("k",), np.array(RATIOS), "1", "velocity ratio v_a/v_g"),
        friction=(
            ("law", "k"),
            np.array(at_ratios()).T,
            "1",
            "mean friction along the sliding over mu times the mean normal force",
        ),
    )
    return dataset.merge(means), [*how, HOW]


@figure("7.10", drawings.torque_over_time)
def _over_time() -> Computed:
    from asperity.thesis.drive.marches import from_load

    last = simulation(conditions(3)[-1])
    found = from_load(last.case, last.settings, _CYCLES, _ROWS)
    whole = last.shaken()
    cycles = np.arange(1, whole.cycle_torque.size + 1)
    dataset = described(
        time=(("time",), found["time"], "s", "time from the load on"),
        first=((), _FIRST / found["frequency"], "s", "the first cycles, shown alone"),
        steps=(("step",), found["steps"], "s", "begin of run-up, steady running and vibration"),
        torque=(("time",), found["torque"], "N m", "torque of the worm's shaft at B"),
        open=(("time",), found["open"], "1", "share of the time without contact"),
        load=(("time",), found["wheel"], "N m", "torque of the mesh on the wheel"),
        cycles=(("cycles",), cycles, "1", "cycles from the start"),
        worm=(
            ("cycles",), np.cumsum(whole.cycle_torque) / cycles / whole.static, "1",
            "mean torque so far over that without vibration",
        ),
        cycle=(
            ("cycles",), whole.cycle_torque / whole.static, "1",
            "mean torque of one cycle over that without vibration",
        ),
        wheel=(
            ("cycles",), np.cumsum(whole.cycle_wheel) / cycles / conditions(3)[-1].torque, "1",
            "mean torque of the mesh on the wheel so far over its load",
        ),
        static=((), whole.static, "N m", "torque without vibration"),
        ratio=((), whole.ratio, "1", "ratio at the end of the march"),
        balance=((), whole.balance, "1", "torque of the mesh on the wheel over its load, less 1"),
        settled=((), float(whole.settled), "1", "whether that is a periodic, balanced state"),
        thesis_static=((), UNSHAKEN, "N m", "torque without vibration, thesis"),
        thesis=((), SHAKEN, "N m", "mean torque with vibration, thesis"),
    )  # fmt: skip
    return dataset, [last, "asperity.thesis.drive.marches.from_load"]


def system_efficiencies(shaken: Sequence[Shaken]) -> FloatArray:
    """Return the load's power over the motor's and the actuator's electrical power."""
    return np.array([one.load / (one.drive + (one.electrical or 0.0)) for one in shaken])


@figure("7.15", drawings.advantage)
def _advantage() -> Computed:
    runs = of_set(3, *ACTUATOR)
    found = [one.shaken() for one in runs]
    ratio = np.array([one.ratio for one in found])
    k = np.geomspace(0.1, 20.0, 400)
    at = ("k",)
    dataset = described(
        k=(at, np.array(RATIOS), "1", "velocity ratio v_a/v_g"),
        ratio=(at, ratio, "1", "mean torque over that without vibration"),
        balance=(at, np.array([one.balance for one in found]), "1", "wheel torque over T_R less 1"),
        settled=(
            at, np.array([float(one.settled) for one in found]), "1", "whether it is settled",
        ),
        advantage=(
            at, conditions(3)[0].torque / (ratio * found[0].static), "1", "mechanical advantage",
        ),
        efficiency=(at, system_efficiencies(found), "1", "system efficiency, with the actuator"),
        thesis_ratio=((), SHAKEN / UNSHAKEN, "1", "ratio of the thesis at k_w = 20"),
        thesis_advantage=((), conditions(3)[0].torque / SHAKEN, "1", "its advantage there"),
        thesis_efficiency=(("end",), np.array([0.09, 0.13]), "1", "its system efficiency"),
        k_v=(("k_v",), k, "1", "velocity ratio of the disc tests"),
        across=(("k_v",), transverse_ratio(k), "1", "rigid friction, vibration across"),
        along=(("k_v",), longitudinal_ratio(k), "1", "rigid friction, vibration along"),
        measured=(
            ("test",), np.array([1.0 - 0.857, 1.0 - 0.78]), "1", "least ratios of the disc tests",
        ),
        test=(("test",), np.array(["across", "along"], dtype=object), "1", "way of the tests"),
    )  # fmt: skip
    return dataset, [
        *runs, "asperity.slider.closed_forms.transverse_ratio",
        "asperity.slider.closed_forms.longitudinal_ratio",
    ]  # fmt: skip
