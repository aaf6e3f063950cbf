"""Claims 2.4, 2.5, 4.9 to 4.12, 5.2: how the thesis reads the forces on a sliding body."""

import numpy as np

from asperity.slider.closed_forms import (
    cosine_mean_approach,
    dead_load_ratio,
    orbit_mean_approach,
)
from asperity.slider.history import History
from asperity.thesis.exhibits import claim
from asperity.thesis.products import ARITHMETIC, NOT_TESTABLE, Finding
from asperity.thesis.sliding.bodies import DIRECTION, PERIODIC, RATIO, TWO_PHASE, Body, Sweep

_RATIOS = "2,6,20"
_SAME = 1e-9
_COARSE = 10.0  # us
_READ = 0.02
"""Of mu F_N, that can be read off a figure with an axis from 0 to 1."""
_EARLY, _LATE = (0.3, 0.6), (0.6, 1.0)  # s
_TOLD = 0.01
_ENDS = 0.5  # s, the transverse runs of Appendix A
_END = 1e-3  # s, of the march in which it undulates


@claim("2.4")
def _a_little_faster() -> Finding:
    fast, faster = (
        Body("table-4.3", (f"vibration.velocity_amplitude={v} mm/s", PERIODIC)) for v in ("0.75", 3)
    )
    result, other = fast.result, faster.result
    least, turned = result.friction_min[0], other.friction_min[0]
    return Finding.judged(
        {
            "the mean falls": result.ratio < 1.0 - 1e-3,
            "friction keeps its sign": least > 0.0,
            "it turns where the vibration is faster": turned < 0.0,
        },
        f"{result.ratio:.3f} of mu F_N, at least {least:.2f} N",
        "The asperities "
        "give way before the force can turn, which rigid friction would do. At v_a = "
        f"{1e3 * faster.model.peak_velocity:g} mm/s the least is {turned:.2f} N.",
        {"ratio": result.ratio, "friction_x_min_N": least, "friction_x_min_k_6_N": turned},
        [fast, faster],
        assumed="The source's other numbers are not given; those of Table 4.3 stand in.",
    )


@claim("2.5")
def _normal_vibration() -> Finding:
    orbit = 1.0 - orbit_mean_approach(1.5)
    cosine = 1.0 - cosine_mean_approach(1.0, 1.5)
    by_load = 1.0 - dead_load_ratio(1.0)
    return Finding.judged(
        {
            "friction falls without loss of contact": orbit > 0.0,
        },
        f"{orbit:.1%} by the area of a Hertz contact, {by_load:.0%} by its load",
        "Tests of another source, whose contact, load and law of friction are not told: there is "
        "nothing to hold the percentage to. "
        "A Hertz contact under a dead load stands lower in the mean when it oscillates: at the "
        f"first loss of contact by {orbit:.1%} where it is free and by {cosine:.1%} as a pure "
        "cosine. That is the most there can be without loss of contact, where friction goes by "
        "the area; friction that goes by the load keeps its mean.",
        {
            "saved_by_area": orbit,
            "saved_by_area_cosine": cosine,
            "saved_by_load": by_load,
        },
        [
            "asperity.slider.closed_forms: orbit_mean_approach(1.5), "
            "cosine_mean_approach(1.0, 1.5), dead_load_ratio(1.0)",
        ],
        verdict=NOT_TESTABLE,
        assumed="Friction that goes by the area of contact; by the load there is nothing to save.",
    )


@claim("4.9")
def _transfer() -> Finding:
    shares = ("1", "0.71", "0.5")
    sweeps = [
        Sweep("table-4.3", ((RATIO, _RATIOS),), (PERIODIC, f"friction.transfer={share}"))
        for share in shares
    ]
    ratios = np.array([sweep.ratios() for sweep in sweeps])
    apart = float(np.ptp(ratios, axis=0).max())
    return Finding.judged(
        {"no influence": apart < _SAME},
        f"ratios apart by {apart:.0e}" if apart else "ratios the same to the last bit",
        f"At eta_y = {', '.join(shares)} and k = {_RATIOS.replace(',', ', ')}: the base does not "
        "move across the drive, so that there is nothing to transfer.",
        {"largest_difference": apart},
        sweeps,
        verdict=ARITHMETIC,
    )


@claim("4.10")
def _two_directions() -> Finding:
    k, angles = 20, (90, 270)
    bodies = [
        Body("table-4.4", (PERIODIC, f"{RATIO}={k}", f"{DIRECTION}={theta} deg"))
        for theta in angles
    ]
    there, here = (body.history.friction for body in bodies)
    scale = float(np.abs(there).max())
    along, across, mirrored = (
        float(np.abs(difference).max())
        for difference in (
            there[:, 0] - here[:, 0], there[:, 1] - here[:, 1], there[:, 1] + here[:, 1]
        )
    )  # fmt: skip
    turns = [float(value) for value in (here[:, 0].min(), here[:, 0].max(), here[:, 1].min(),
                                        here[:, 1].max())]  # fmt: skip
    return Finding.judged(
        {
            "F_x changes only in magnitude, F_y in direction": turns[0] > 0.0
            and turns[2] < 0.0 < turns[3],
            "F_x matches": along < _SAME * scale,
            "F_y matches, or is its mirror image": min(across, mirrored) < _SAME * scale,
        },
        f"F_x apart by {along:.0e} N, F_y by {mirrored:.0e} N but for its sign",
        "A base that moves across alone leaves nothing to (42), so that (38) to (59) are (22) to "
        "(37): an identity, which could not have come out otherwise. The curves of Figure 4.22 are "
        "lost, and which way the older model's y points with them. If it moves the base towards +y "
        "first, a direction of "
        f"{angles[0]:g} deg, which Appendix B gives for the same picture, then the "
        f"{angles[1]:g} deg of Table 4.4 turn the sign of F_y and nothing else; a difference of "
        f"convention. Ratios do not tell the two apart. F_x goes from {turns[0]:.2f} to "
        f"{turns[1]:.2f} N and keeps its sign, as it must where nothing drives the contact back; "
        f"F_y goes from {turns[2]:.2f} to {turns[3]:.2f} N. At k = {k:g}, periodic state.",
        {"friction_x_difference_N": along, "friction_y_difference_N": across,
         "friction_y_sum_N": mirrored},
        bodies,
        verdict=ARITHMETIC,
    )  # fmt: skip


@claim("4.11")
def _undulating() -> Finding:
    angles = (0, 45, 90)
    bodies = {
        scheme: [Body("table-4.3", (f"{DIRECTION}={theta} deg", *scheme)) for theta in angles]
        for scheme in ((TWO_PHASE,), ())
    }
    printed, converged = (
        [_undulation(body.history) for body in group] for group in bodies.values()
    )
    model = bodies[()][0].model
    stretch = 2.0 * (model.slider.drive_stiffness or 0.0) * model.amplitude
    return Finding.judged(
        {
            "the drive force undulates": printed[0] > 1e-3,
            "less towards transverse": printed[0] > printed[1] > printed[2],
        },
        ", ".join(f"{swing:.4f} N at {theta} deg" for swing, theta in zip(printed, angles,
                                                                          strict=True)),
        "It follows from the printed scheme: (20) stretches the drive by the relative position "
        f"of (42), in which the base's motion is, so that twice k_d u_a, {stretch:.4f} N, times "
        "the cosine of the direction undulates, and could neither be absent nor grow towards "
        "transverse. What is more is mostly the ringing of the drive: with the body's own "
        f"position, which the scheme does not take, {converged[0]:.4f} N are left along the drive. "
        f"Between lowest and highest of the last {_END * 1e3:g} ms at k = 6.",
        {
            f"{name}_{theta}deg_N": swing
            for name, group in (("two_phase", printed), ("exponential", converged))
            for theta, swing in zip(angles, group, strict=True)
        },
        [body for group in bodies.values() for body in group],
        verdict=ARITHMETIC,
    )  # fmt: skip


@claim("4.12")
def _one_cycle() -> Finding:
    ratios = _RATIOS.split(",")
    bodies = [Body("table-4.3", (f"{RATIO}={ratio}",)) for ratio in ratios]
    early, late = ([_off_the_mean(body, *window) for body in bodies] for window in (_EARLY, _LATE))
    return Finding.judged(
        {f"a cycle from {_LATE[0]:g} s on tells the mean, within {_TOLD:.0%}": max(late) < _TOLD},
        f"off the mean of many cycles by up to {', '.join(f'{share:.2%}' for share in late)} from "
        f"{_LATE[0]:g} s on and {', '.join(f'{share:.1%}' for share in early)} from "
        f"{_EARLY[0]:g} s, at k = {', '.join(ratios)}",
        "A definition: the thesis does not claim that one cycle tells of others, nor says which it "
        "takes. What it would be off by stands beside: the drive rings undamped but for what "
        "friction takes, and a cycle of vibration is a small part of its period, so that it "
        "depends on when. Here ratios are means over at least twenty of these periods. The runs "
        f"of Appendix A across the drive end at {_ENDS:g} s, before the ringing has died down.",
        {
            f"largest_error_{name}_k_{ratio}": share
            for name, group in (("early", early), ("late", late))
            for ratio, share in zip(ratios, group, strict=True)
        },
        bodies,
        verdict=NOT_TESTABLE,
        assumed=f"The windows, from {_EARLY[0]:g} to {_EARLY[1]:g} s and from {_LATE[0]:g} to "
        f"{_LATE[1]:g} s, and {_TOLD:.0%}.",
    )


@claim("5.2")
def _coarse_step() -> Finding:
    cases = {"longitudinal": "table-4.3", "transverse": "table-4.4"}
    coarse = {
        name: Sweep(case, ((RATIO, _RATIOS),), (TWO_PHASE, f"solve.step={_COARSE:g} us"))
        for name, case in cases.items()
    }
    fine = {name: Sweep(case, ((RATIO, _RATIOS),), (PERIODIC,)) for name, case in cases.items()}
    ratios = {name: (coarse[name].ratios(), fine[name].ratios()) for name in cases}
    off = {name: float(np.abs(one - other).max()) for name, (one, other) in ratios.items()}
    one, other = ratios["longitudinal"]
    shares = one / other - 1.0
    at = {f"{k:g}": float(s) for k, s in zip(coarse["longitudinal"].values(), shares, strict=True)}
    cycle = 1e6 / Body("table-4.3").model.frequency
    return Finding.judged(
        {f"{name}: within {_READ:g} on an axis from 0 to 1": value < _READ
         for name, value in off.items()},
        ", ".join(f"{name} apart by {value:.3f} at most" for name, value in off.items()),
        "Of the finite elements only the step is tried, and on the axis from 0 to 1 that the "
        "published figures have its error is not seen. As a "
        "share of the ratio itself it is "
        + ", ".join(f"{share:+.1%} at k = {k}" for k, share in at.items())
        + f" along the drive: a step of {_COARSE:g} us is one of {cycle / _COARSE:.0f} to a cycle, "
        "the two-phase scheme is of first order, and at high k the asperities are stretched "
        "several times over in each. Compared with periodic states.",
        {f"relative_error_k_{k}": share for k, share in at.items()}
        | {f"error_{name}": value for name, value in off.items()},
        [*coarse.values(), *fine.values()],
        assumed=f"The yardstick, {_READ:g} of mu F_N: what can be read off such a figure. No "
        "finite elements: the rigid sliding body stands for the block, with the thesis's two-phase "
        "scheme at their step; what an elastic block differs by is claim 5.1.",
    )  # fmt: skip


def _undulation(history: History) -> float:
    return float(np.ptp(history.drive_force[history.time > history.time[-1] - _END]))


def _off_the_mean(body: Body, begin: float, end: float) -> float:
    """How far the mean over a cycle between two times may be off that over the window."""
    history = body.history
    if history.span is None:
        raise ValueError("a history without the length of its stretches")
    edges = np.append(0.0, np.cumsum(history.span))
    impulse = np.append(0.0, np.cumsum(history.span * history.drive_force))
    period = 1.0 / body.model.frequency
    first = np.arange(begin, end - period, period)
    last = first + period
    means = (np.interp(last, edges, impulse) - np.interp(first, edges, impulse)) / period
    return float(np.abs(means / body.result.drive_force - 1.0).max())
