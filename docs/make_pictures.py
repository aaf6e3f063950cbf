"""Draw the pictures of the README and of the theory anew: ``python docs/make_pictures.py``."""

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from asperity.casefile import read_case
from asperity.commands import COMMANDS, case_tables
from asperity.results.figures import BLUE, VERMILION, panels
from asperity.runs import Run
from asperity.slider import TABLES, Model, solve, solve_many
from asperity.slider.closed_forms import (
    critical_velocity,
    longitudinal_ratio,
    master_curve,
    master_curve_approximated,
    normal_ratio,
    transverse_ratio,
)
from asperity.slider.plots_normal import plot_directions, plot_master_curve, plot_two_cycles
from asperity.store import write_atomically
from asperity.sweep.branches import answer, prepare
from asperity.thesis.contents import FIGURES

if TYPE_CHECKING:
    from matplotlib.figure import Figure

PICTURES = Path(__file__).parent / "_static"
SWINGS = (0.1, 0.5, 0.9)


def shaken() -> "Figure":
    """What is left of the drive force of a body on a base that is shaken along or across."""
    figure, (axes,) = panels(width=7.2, height=3.9)
    fast = np.linspace(0.0, 10.0, 401)
    shown = (
        ("along the sliding", "table-4.3", longitudinal_ratio(np.fmax(fast, 1.0)), BLUE, (3, 4)),
        ("across it", "table-4.4", transverse_ratio(fast), VERMILION, (5.4, 42)),
    )
    at = np.array([0.5, 1.0, 1.25, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0])
    for way, name, rigid, colour, place in shown:
        settings = ["solve.method=periodic", "friction.law=vector", "friction.transfer=1"]
        case = read_case(name, TABLES, settings)
        models = [Model.from_case(case.replace_values({"vibration.velocity_ratio": k})) for k in at]
        left = 100.0 * np.array([solve(model).ratio for model in models])
        axes.plot(fast, 100.0 * rigid, color=colour, linewidth=1.0, dashes=(4, 2))
        axes.plot(at, left, "o-", color=colour, markersize=5, linewidth=2.0)
        axes.annotate(f"shaken {way}", place, color=colour, fontsize=12, fontweight="bold")
    axes.axhline(100.0, color="black", linewidth=0.8)
    axes.annotate("not shaken", (10.0, 100.0), (0, 4), textcoords="offset points", ha="right")
    axes.set(
        xlabel="how fast it is shaken: peak speed of the vibration over the speed of sliding",
        ylabel="force that still pulls it (%)", xlim=(0, 10.2), ylim=(0, 112),
    )  # fmt: skip
    return figure


def one_curve() -> "Figure":
    """Sliding under normal vibration: three swings, one master curve."""
    case = read_case("normal-machine", TABLES)
    velocity, at = np.linspace(0.0, 1.2, 241), np.linspace(0.05, 1.15, 12)
    frequency, limit = case["vibration"].frequency, case["friction"].max_deflection
    points = {}
    for swing in SWINGS:
        amplitude = swing * case["normal"].penetration
        critical = critical_velocity(limit, swing, frequency, "flat")
        models = [
            Model.from_case(
                case.replace_values(
                    {
                        "slider.drive_velocity": v * critical,
                        "vibration.displacement_amplitude": amplitude,
                    }
                )
            )
            for v in at
        ]
        points[swing] = at, np.array([result.ratio for result in solve_many(models)])
    return plot_master_curve(
        velocity,
        {a: normal_ratio(velocity, a, "flat") for a in SWINGS},
        master_curve(velocity),
        master_curve_approximated(velocity),
        points,
    )


def in_space() -> "Figure":
    """Ratio over all directions of space: where a body is conveyed."""
    case = read_case("oblique", TABLES)
    elevation, azimuth = np.radians(np.linspace(0, 180, 25)), np.radians(np.linspace(0, 180, 19))
    models = [
        Model.from_case(
            case.replace_values({"vibration.elevation": e, "vibration.direction": theta})
        )
        for e in elevation
        for theta in azimuth
    ]
    ratios = np.array([result.ratio for result in solve_many(models)])
    return plot_directions(elevation, azimuth, ratios.reshape(len(elevation), len(azimuth)))


def in_flight() -> "Figure":
    """Normal force and friction of a body that is thrown, over the two cycles of its period."""
    model = Model.from_case(read_case("normal-pin", TABLES, ["vibration.velocity_ratio=20"]))
    history = solve(model).history
    assert history is not None
    return plot_two_cycles(
        history.time, history.normal_force, history.friction[:, 0],
        model.friction.mu, model.slider.normal_force,
    )  # fmt: skip


def two_states() -> "Figure":
    """States of a ball that is shaken harder and harder, and less and less again."""
    case = read_case(
        "normal-pin", TABLES, ["vibration.frequency=1.7 kHz", "vibration.elevation=90 deg"]
    )
    over = "vibration.displacement_amplitude=0.02:0.7:0.02 um"
    return answer(prepare(case, over=[over]), Run()).figure()


def of_drive(name: str, shipped: str, *settings: str) -> "Figure":
    """First picture of a command's answer to a shipped drive."""
    command = next(each for each in COMMANDS if each.name == name)
    run = Run()
    run.detailed = True
    problem = command.prepared(read_case(shipped, case_tables(), settings))
    return command.solved(problem, run).figure()


if __name__ == "__main__":
    drawn = {
        "shaken": shaken(),
        "directions": FIGURES["4.23"].make().figure,
        "master_curve": one_curve(),
        "in_space": in_space(),
        "in_flight": in_flight(),
        "two_states": two_states(),
        "drive": of_drive("drive", "drive-thesis"),
        "drive_directions": of_drive(
            "directions", "drive-screw", "vibration.frequency=20 kHz",
            "vibration.displacement_amplitude=20 um",
        ),
        "drive_locking": of_drive("locking", "drive-actuator"),
    }  # fmt: skip
    for name, figure in drawn.items():
        write_atomically(
            PICTURES / f"{name}.png", lambda path, figure=figure: figure.savefig(path, dpi=120)
        )
