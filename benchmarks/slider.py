"""How fast bodies are marched and periodic states found, against other ways in the same run.

Run it with ``make bench``. Every line gives a time and a ratio: on a shared machine only the ratio
means something. The other ways: a plain compiled loop over one body (what one writes first with
Numba), SciPy's LSODA on the same equations, and the march in place of the periodic state.
"""

import math
import subprocess
import sys
import time

import numba
import numpy as np
from _common import best, finish
from scipy.integrate import solve_ivp

from asperity.casefile import read_case
from asperity.slider.batch import solve_many
from asperity.slider.march import march
from asperity.slider.model import Model
from asperity.slider.periodic import solve_periodic
from asperity.slider.tables import TABLES

RATIOS = (2.0, 3.0, 4.0, 6.0, 20.0)


@numba.njit(cache=False, error_model="numpy")
def plain_loop(steps, dt, drive, stiffness, mass, force, limit, amplitude, omega, cos, sin, split):
    """One body, one loop, the textbook way; the same scheme and ledger as the package."""
    x = v = y = vy = sx = sy = 0.0
    last_x = last_y = 0.0
    fx = fy = 0.0
    fd = 0.0
    drive_work = vibration_work = friction_work = 0.0
    top, low, side = -1e300, 1e300, 0.0
    for n in range(steps):
        u = amplitude * math.sin(omega * (n + 1) * dt)
        ux = u * cos - last_x
        uy = u * sin - last_y
        last_x += ux
        last_y += uy
        dx = v * dt - ux
        dy = vy * dt - uy
        if split:
            hx = sx + 0.5 * dx
            hy = sy + 0.5 * dy
            size = math.sqrt(hx * hx + hy * hy)
            a = 0.0
            if size > 0.0:
                a = (abs(hx * dx + hy * vy * dt) + abs(hy * uy)) / (size * limit)
        else:
            a = math.sqrt(dx * dx + dy * dy) / limit
        decay = math.exp(-a)
        gain = 1.0 if a < 1e-12 else (1.0 - decay) / a
        sx = sx * decay + dx * gain
        sy = sy * decay + dy * gain
        size = math.sqrt(sx * sx + sy * sy)
        if size > limit:
            sx *= limit / size
            sy *= limit / size
        x += v * dt
        y += vy * dt
        gx, gy, gd = fx, fy, fd
        fx = force * sx / limit
        fy = force * sy / limit
        fd = stiffness * (drive * (n + 1) * dt - x)
        v += dt * (fd - fx) / mass
        vy -= dt * fy / mass
        drive_work += 0.5 * (fd + gd) * drive * dt
        vibration_work -= 0.5 * ((fx + gx) * ux + (fy + gy) * uy)
        friction_work += 0.5 * ((fx + gx) * dx + (fy + gy) * dy)
        top = max(top, fx)
        low = min(low, fx)
        side = max(side, abs(fy))
    return drive_work, vibration_work, friction_work, top, low, side


def lsoda_seconds(model, span):
    """Time LSODA takes for ``span`` simulated seconds of the law in this model, rtol 1e-6."""
    slider, friction = model.slider, model.friction
    limit = friction.max_deflection
    force = model.full_friction
    omega = 2.0 * math.pi * model.frequency
    cos, sin, _ = model.unit_direction
    ua, eta = model.amplitude, friction.transfer
    split = friction.law == "split"

    def rates(t, q):
        x, v, vy, sx, sy = q
        ub = ua * omega * math.cos(omega * t)
        v1x, v1y, v2y = v - ub * cos, vy, -eta * ub * sin
        if split:
            size = math.hypot(sx, sy) or 1e-300
            a = (abs(sx * v1x + sy * v1y) + abs(sy * v2y)) / size / limit
        else:
            a = math.hypot(v1x, v1y + v2y) / limit
        fx, fy = force * sx / limit, force * sy / limit
        pull = slider.drive_stiffness * (slider.drive_velocity * t - x)
        return (
            v,
            (pull - fx) / slider.mass,
            -fy / slider.mass,
            v1x - a * sx,
            v1y + v2y - a * sy,
        )

    stretch = 0.4 * force / slider.drive_stiffness
    start = [-stretch, slider.drive_velocity, 0.0, 0.4 * limit, 0.0]
    began = time.thread_time()
    answer = solve_ivp(
        rates, (0.0, span), start, method="LSODA", rtol=1e-6, atol=[1e-12, 1e-9, 1e-9, 1e-13, 1e-13]
    )
    if not answer.success:
        raise RuntimeError(answer.message)
    return time.thread_time() - began


def march_batches(report):
    """Batches of 32 against a plain loop and LSODA.

    Up to a velocity ratio of 7.5 a step of 1 us need not be divided; above, the march takes more
    steps than asked for, and a batch over all ratios falls into several.
    """
    for law in ("vector", "split"):
        case = read_case("table-4.4", TABLES, [f"friction.law={law}"])
        models = [
            Model.from_case(
                case.replace_values(
                    {"vibration.velocity_ratio": ratio, "vibration.direction": angle}
                )
            )
            for ratio, angle in zip(
                np.linspace(0.5, 7.5, 32), np.linspace(0.0, np.pi, 32), strict=True
            )
        ]
        steps = round(models[0].duration / models[0].step)
        solve_many(models)
        batch = best(lambda m=models: solve_many(m)) / steps / 32
        model = models[16]
        arguments = (
            steps, model.step, model.slider.drive_velocity, model.slider.drive_stiffness,
            model.slider.mass, model.full_friction, model.friction.max_deflection,
            model.amplitude, 2.0 * math.pi * model.frequency, model.unit_direction[0],
            model.friction.transfer * model.unit_direction[1], law == "split",
        )  # fmt: skip
        plain_loop(*arguments)
        plain = best(lambda a=arguments: plain_loop(*a)) / steps
        march(model, history=False)
        single = best(lambda m=model: march(m, history=False)) / steps
        span = 0.02
        lsoda = lsoda_seconds(model, span) / span * model.step
        report[f"march {law}"] = {
            "batch_ns": batch * 1e9,
            "single_ns": single * 1e9,
            "plain_loop_ns": plain * 1e9,
            "lsoda_ns": lsoda * 1e9,
            "plain_over_batch": plain / batch,
            "lsoda_over_batch": lsoda / batch,
        }


def periodic_points(report):
    """The 125 points of Figure 4.23, against marching them."""
    case = read_case("table-4.4", TABLES, ["solve.method=periodic"])
    models = [
        Model.from_case(
            case.replace_values(
                {"vibration.velocity_ratio": ratio, "vibration.direction": math.radians(angle)}
            )
        )
        for ratio in RATIOS
        for angle in range(0, 361, 15)
    ]
    solve_many(models[:1])
    whole = best(lambda: solve_many(models))
    points = []
    for model in models:
        began = time.perf_counter()
        solve_periodic(model, history=False)
        points.append(time.perf_counter() - began)
    marched = best(lambda: march(Model.from_case(read_case("table-4.4", TABLES)), history=False))
    report["periodic"] = {
        "figure_4.23_s": whole,
        "median_point_ms": float(np.median(points)) * 1e3,
        "march_over_periodic": marched / float(np.median(points)),
    }


def sweep_memory(report):
    """Peak memory of a batch for ten times the steps."""
    code = (
        "import resource\n"
        "from asperity.casefile import read_case\n"
        "from asperity.slider.batch import solve_many\n"
        "from asperity.slider.model import Model\n"
        "from asperity.slider.tables import TABLES\n"
        "case = read_case('table-4.4', TABLES, ['solve.duration={} s'])\n"
        "solve_many([Model.from_case(case)] * 32)\n"
        "print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss)"
    )
    short, long = (
        int(subprocess.check_output([sys.executable, "-c", code.format(span)]))
        for span in ("0.3", "3")
    )
    report["memory"] = {"short_MiB": short / 1024, "ten_times_the_steps_over_short": long / short}


def command_line(report):
    """Answering time of the command line, kernels cached."""
    for name, arguments in (
        ("help", ["--help"]),
        ("slide", ["slide", "table-4.3", "--json"]),
    ):
        command = [sys.executable, "-m", "asperity", *arguments]
        subprocess.run(command, check=True, capture_output=True)
        report[f"asperity {name}"] = {
            "seconds": best(
                lambda c=command: subprocess.run(c, check=True, capture_output=True),
                clock=time.perf_counter,
            )
        }
    bare = [sys.executable, "-c", "import numba"]
    report["asperity slide"]["import_numba_s"] = best(
        lambda: subprocess.run(bare, check=True), clock=time.perf_counter
    )


def main():
    """Run all and print one line a figure."""
    report = {}
    march_batches(report)
    periodic_points(report)
    sweep_memory(report)
    command_line(report)
    finish(report)


if __name__ == "__main__":
    main()
