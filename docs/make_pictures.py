"""Draw the pictures of the README and of the theory anew: ``python docs/make_pictures.py``."""

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from asperity.arrays import FloatArray
from asperity.casefile import read_case
from asperity.commands import COMMANDS, case_tables
from asperity.files.store import write_atomically
from asperity.results.figures import BLACK, BLUE, COLOURS, DASHES, VERMILION, axes_grid, legend
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
from asperity.slider.periodic import solve_periodic
from asperity.slider.plots import flight_of
from asperity.sweep.branches import answer, prepare
from asperity.thesis.contents import FIGURES

if TYPE_CHECKING:
    from matplotlib.figure import Figure

PICTURES = Path(__file__).parent / "_static"
SWINGS = (0.1, 0.5, 0.9)
MARKERS = ("o", "s", "^", "D")


def shaken() -> "Figure":
    """What is left of the drive force of a body on a base that is shaken along or across."""
    figure, (axes,) = axes_grid(width=7.2, height=3.9)
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
    history = solve_periodic(model).history
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


def of_command(
    name: str, shipped: str, *settings: str, picture: str | None = None, **options: Any
) -> "Figure":
    """A picture of a command's answer to a case that ships; the first if none is named."""
    command = next(each for each in COMMANDS if each.name == name)
    run = Run()
    run.detailed = True
    problem = command.prepared(read_case(shipped, case_tables(), settings), **options)
    return command.solved(problem, run).figure(picture)


def plot_master_curve(
    velocity: FloatArray,
    curves: Mapping[float, FloatArray],
    reduction: FloatArray,
    approximated: FloatArray,
    points: Mapping[float, tuple[FloatArray, FloatArray]],
) -> "Figure":
    """Draw the ratio for several swings, and the reduction over the swing, on which they meet.

    Parameters
    ----------
    velocity : ndarray, shape (n,)
        Over the critical velocity.
    curves : mapping of float to ndarray
        Ratio of each swing at these velocities.
    reduction, approximated : ndarray, shape (n,)
        The master curve and a polynomial for it.
    points : mapping of float to two ndarrays
        Velocities and ratios of a model, for each swing.
    """
    figure, (left, right) = axes_grid(1, 2, width=9.0, height=4.0)
    for index, (swing, ratio) in enumerate(curves.items()):
        colour, dashes = COLOURS[index % len(COLOURS)], DASHES[index % len(DASHES)]
        left.plot(velocity, ratio, color=colour, dashes=dashes, label=f"a = {swing:g}")
    right.plot(velocity, reduction, color=BLACK, label="h(V)")
    right.plot(velocity, approximated, color=BLACK, dashes=(2, 2), linewidth=1.0, label="Popov")
    for index, (swing, (at, ratio)) in enumerate(points.items()):
        style: dict[str, Any] = {
            "color": COLOURS[index % len(COLOURS)], "marker": MARKERS[index % len(MARKERS)],
            "linestyle": "", "markersize": 4.5, "fillstyle": "none",
        }  # fmt: skip
        left.plot(at, ratio, **style)
        right.plot(at, (1.0 - ratio) / swing, label=f"a = {swing:g}", **style)
    left.set_ylabel(r"friction over $\mu N_0$")
    right.set_ylabel("reduction over swing")
    for axes in (left, right):
        axes.set_xlabel("velocity over the critical velocity, V")
        axes.margins(x=0.02)
        axes.set_ylim(0.0, 1.05)
    legend(left, loc="lower right")
    legend(right, loc="upper right")
    return figure


def plot_directions(elevation: FloatArray, azimuth: FloatArray, ratio: FloatArray) -> "Figure":
    """Draw the ratio over the vibration's direction in space, and where it turns into a thrust.

    Parameters
    ----------
    elevation, azimuth : ndarray, shapes (n,), (m,)
        rad.
    ratio : ndarray, shape (n, m)
    """
    figure, (axes,) = axes_grid(width=7.4, height=4.4)
    degrees = np.degrees(azimuth), np.degrees(elevation)
    thrust = bool(ratio.min() < 0.0)
    size = max(float(np.abs(ratio).max()), 1e-12)
    # White at zero, so that a thrust has a colour of its own.
    field = axes.pcolormesh(
        *degrees, ratio, cmap="RdBu_r" if thrust else "Reds", vmin=-size if thrust else 0.0,
        vmax=size, shading="gouraud", rasterized=True,
    )  # fmt: skip
    axes.grid(visible=False)
    levels = axes.contour(*degrees, ratio, colors=BLACK, linewidths=0.7, levels=8)
    axes.clabel(levels, fontsize=8.0, fmt="%.2g")
    if thrust and ratio.max() > 0.0:
        axes.contour(*degrees, ratio, levels=[0.0], colors=BLACK, linewidths=2.0)
    figure.colorbar(field, ax=axes, label=r"drive force over $\mu W$")
    axes.set_xlabel("azimuth from the drive (deg)")
    axes.set_ylabel("elevation (deg)")
    return figure


def plot_two_cycles(
    time: FloatArray,
    load: FloatArray,
    friction: FloatArray,
    limit: float,
    static_load: float,
) -> "Figure":
    """Draw normal force and friction over time, flight shaded.

    Parameters
    ----------
    time, load, friction : ndarray, shape (n,)
        s, N, N; friction along the drive.
    limit : float
        Coefficient of friction: what friction can be at most is that of the load.
    static_load : float
        The load without vibration, N.
    """
    figure, (upper, lower) = axes_grid(2, height=5.4)
    scale, unit = (1e3, "ms") if time[-1] - time[0] > 1e-3 else (1e6, "µs")
    at = scale * (time - time[0])
    for axes in (upper, lower):
        for mark in flight_of(at, load, "in flight" if axes is upper else None):
            mark.put(axes)
        axes.margins(x=0.0)
    upper.plot(at, load, color=BLUE, label="normal force")
    upper.axhline(static_load, color=BLACK, dashes=(4, 3), linewidth=1.0, label="at rest")
    upper.axhline(mean_of(time, load), color=BLUE, dashes=(1, 1.5), linewidth=1.0, label="its mean")
    upper.set_ylabel("normal force (N)")
    for sign in (1.0, -1.0):
        lower.plot(
            at, sign * limit * load, color=BLUE, linewidth=0.8, dashes=(2, 2),
            label=r"$\pm\mu N$" if sign > 0.0 else None,
        )  # fmt: skip
    lower.plot(at, friction, color=VERMILION, label="friction")
    mean = mean_of(time, friction)
    lower.axhline(mean, color=VERMILION, dashes=(1, 1.5), linewidth=1.0, label="its mean")
    lower.set_ylabel("friction (N)")
    lower.set_xlabel(f"time ({unit})")
    for axes in (upper, lower):
        legend(axes, loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=4)
    return figure


def mean_of(time: FloatArray, values: FloatArray) -> float:
    return float(np.trapezoid(values, time) / (time[-1] - time[0]))


def catalogues() -> "Figure":
    """Torques and efficiencies of two makers' gearboxes of 63 mm, and what three standards have."""
    import gear_cases

    one, other = (
        [p for p in positions() if p.centre_distance == 63]
        for positions in (gear_cases.catalogue, gear_cases.selection)
    )
    figure, (torque, efficiency) = axes_grid(1, 2, width=8.4, height=3.9)
    shown = (
        (torque, "torque", one, "a maker", "s"),
        (torque, "torque", other, "another maker", "^"),
        (torque, "bs_wear", one, "BS 721, wear", "o-"),
        (torque, "agma_torque", one, "AGMA 6034", "D--"),
        (efficiency, "efficiency", one, "a maker", "s"),
        (efficiency, "efficiency", other, "another maker", "^"),
        (efficiency, "iso_gearbox", one, "ISO/TR 14521, gearbox", "v-"),
        (efficiency, "bs_teeth", one, "BS 721, teeth alone", "o--"),
    )
    colours = {
        "bs_wear": BLUE,
        "bs_teeth": BLUE,
        "agma_torque": VERMILION,
        "iso_gearbox": VERMILION,
    }
    for axes, name, positions, label, style in shown:
        points = [(p.ratio, getattr(p, name)) for p in positions if getattr(p, name) is not None]
        axes.plot(*zip(*points, strict=True), style, label=label, color=colours.get(name, BLACK),
                  markersize=6, markerfacecolor="none" if name in colours else BLACK)  # fmt: skip
    torque.set(xlabel="ratio", ylabel="torque of the wheel (N m)", ylim=(0, None), xlim=(0, 105))
    efficiency.set(xlabel="ratio", ylabel="efficiency (%)", ylim=(0, 100), xlim=(0, 105))
    torque.legend(loc="lower left")
    efficiency.legend(loc="lower left")
    return figure


if __name__ == "__main__":
    drawn = {
        "shaken": shaken(),
        "directions": FIGURES["4.23"].make().figure,
        "master_curve": one_curve(),
        "in_space": in_space(),
        "in_flight": in_flight(),
        "two_states": two_states(),
        "drive": of_command("drive", "drive-thesis"),
        "drive_directions": of_command(
            "directions", "drive-screw", "vibration.frequency=20 kHz",
            "vibration.displacement_amplitude=20 um",
        ),
        "drive_locking": of_command("locking", "drive-actuator"),
        "control_failures": of_command("control", "drive-actuator", picture="control_failures"),
        "loaded_error": of_command("drive", "drive-screw", picture="drive_error", static=True),
        "misalign": of_command(
            "misalign", "drive-screw", "tolerances.centre_distance=js8",
            "tolerances.axial_offset=30 um", "tolerances.shaft_angle=0.02 deg",
        ),
        "roots_fillet": of_command("roots", "drive-screw", picture="roots_fillet"),
        "wear_flank": of_command("wear", "drive-screw", "drive.phases=12", picture="wear_flank"),
        "wear": of_command(
            "wear", "drive-screw", "drive.phases=2", "modification.tip_relief=30 um",
            picture="wear", depth="120 um",
        ),
        "shafts": of_command("shafts", "actuator-shafts"),
        "catalogue": catalogues(),
    }  # fmt: skip
    for name, figure in drawn.items():
        write_atomically(
            PICTURES / f"{name}.png", lambda path, figure=figure: figure.savefig(path, dpi=120)
        )
