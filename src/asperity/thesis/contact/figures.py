"""Figures 5.2, 5.5 to 5.11, 7.8 and 7.9: elastic blocks on the curves of the sliding body."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from asperity.contact.interface.normal import NormalLaw, pressure
from asperity.results.dataset import described
from asperity.thesis.contact import drawings, elastic, pressed
from asperity.thesis.contact.blocks import problem_of
from asperity.thesis.contact.claims import marched_and_slid
from asperity.thesis.contact.elastic import (
    DIRECTION,
    LONGITUDINAL,
    ON_BODY,
    RATIO,
    SLIDING,
    TRANSVERSE,
)
from asperity.thesis.exhibits import Computed, figure
from asperity.thesis.sliding import drawings as drawings_sliding
from asperity.thesis.sliding.bodies import PERIODIC, Sweep
from asperity.thesis.sliding.claims import PLOTTED
from asperity.thesis.sliding.figures import (
    CLOSED_FORMS,
    beginning,
    side_by_side,
    two_cycles,
)

_DENSE = "0.1:20:0.1"
_EDGE = 5e-3  # m, of an element of the shipped block
_NAMES = ("sliding body", "elastic block")


@figure("5.5", drawings.over_ratio, LONGITUDINAL)
@figure("5.8", drawings.over_ratio, TRANSVERSE)
@figure("7.8", drawings.over_ratio, TRANSVERSE, True)
@figure("7.9", drawings.over_ratio, LONGITUDINAL, True)
def _over_ratio(case: str, on_body: bool = False, *, full: bool = False) -> Computed:
    """The sliding body as a line, blocks as markers, and how far they are apart."""
    over = elastic.RATIOS[case]
    blocks = elastic.over_ratio(case, full, on_body=on_body)
    modes = [(), (ON_BODY,)][: 1 + on_body]
    solved = [block.settled() for block in blocks]
    groups = [solved[n : n + len(over)] for n in range(0, len(solved), len(over))]
    sweeps = [Sweep(SLIDING[case], ((RATIO, _DENSE),), (PERIODIC, *mode)) for mode in modes]
    dense = sweeps[0].values()
    rigid, closed = CLOSED_FORMS[SLIDING[case]]
    dataset = described(
        k=(("k",), dense, "1", "velocity ratio v_a/v_d"),
        k_block=(("k_block",), np.array(over), "1", "velocity ratio v_a/v_d, blocks"),
        shaken=(("shaken",), _objects(["base", "body"][: len(groups)]), "1", "what is shaken"),
        periodic=(
            ("shaken", "k"), np.array([sweep.ratios() for sweep in sweeps]), "1",
            "ratio, sliding body, periodic state",
        ),
        rigid=(("k",), rigid(dense), "1", "ratio, rigid Coulomb friction and rigid drive"),
        **_compared(groups, ("shaken", "k_block")),
    )  # fmt: skip
    return dataset, [*sweeps, closed, *blocks]


_BESIDES = {
    "block": ("ratio", "ratio, elastic block"),
    "slider": ("slider", "ratio, sliding body at the same point"),
    "in_series": ("in_series", "ratio, sliding body with the block's compliance"),
    "rocking": ("rocking", "ratio, that body with the inertia of the block's turns"),
    "unsteadiness": ("unsteadiness", "half of what four windows of the block are apart"),
}


def _compared(groups: Any, place: tuple[str, ...]) -> dict[str, Any]:
    """Ratios of settled blocks and of the bodies beside them."""
    return {
        name: (
            place,
            np.array([[getattr(one, of) for one in group] for group in groups]),
            "1",
            said,
        )
        for name, (of, said) in _BESIDES.items()
    }


def _objects(names: Sequence[str]) -> Any:
    return np.array(names, dtype=object)


@figure("5.11", drawings.over_direction)
def _over_direction(*, full: bool = False) -> Computed:
    directions = elastic.DIRECTIONS[full]
    blocks = elastic.over_direction(full)
    solved = [block.settled() for block in blocks]
    count = len(directions)
    groups = [solved[n : n + count] for n in range(0, len(solved), count)]
    settled = Sweep(SLIDING[TRANSVERSE], ((RATIO, PLOTTED), (DIRECTION, "0:360:3")), (PERIODIC,))
    dataset = described(
        k=(("k",), settled.values(), "1", "velocity ratio v_a/v_d"),
        theta=(("theta",), settled.values(1), "deg", "direction of vibration"),
        theta_block=(("theta_block",), np.array(directions), "deg", "direction, blocks"),
        periodic=(("k", "theta"), settled.ratios(), "1", "ratio, sliding body, periodic state"),
        **_compared(groups, ("k", "theta_block")),
    )
    return dataset, [settled, *blocks]


@figure("5.3", drawings.normal_laws)
def _normal_laws() -> Computed:
    stiffness = problem_of(LONGITUDINAL).normal.stiffness
    laws = {
        "linear": NormalLaw("linear", stiffness),
        "two-stage": NormalLaw.two_stage(stiffness, _EDGE),
    }
    start, end = laws["two-stage"].start, laws["two-stage"].end
    over = np.linspace(-0.2 * end, 1.6 * end, 361)
    found = np.array([[pressure(x, 0.0, law.numbers) for x in over] for law in laws.values()])
    dataset = described(
        law=(("law",), _objects([*laws]), "1", "law of pressure"),
        overclosure=(("overclosure",), over, "m", "overclosure"),
        pressure=(("law", "overclosure"), found[..., 0], "Pa", "pressure"),
        slope=(("law", "overclosure"), found[..., 1], "Pa/m", "rise of pressure over overclosure"),
        start=((), start, "m", "overclosure from which the stiffness rises"),
        end=((), end, "m", "overclosure up to which it rises"),
    )
    return dataset, [
        f"asperity.contact.interface.normal.NormalLaw, a final stiffness of {stiffness:.4g} Pa/m"
    ]


@figure("5.6", drawings_sliding.drive_over_time, LONGITUDINAL)
@figure("5.9", drawings_sliding.drive_over_time, TRANSVERSE)
def _drive(case: str, *, full: bool = False) -> Computed:
    block, body = marched_and_slid(case, full)
    histories = [one.to_dataset()[["drive_force"]] for one in (body.result, block.marched())]
    dataset = side_by_side(_NAMES, histories, body.result.static_drive_force)
    return beginning(dataset, body.model), [body, block]


@figure("5.7", drawings_sliding.friction_over_cycles, LONGITUDINAL, ["x"])
@figure("5.10", drawings_sliding.friction_over_cycles, TRANSVERSE, ["x", "y"])
def _friction(case: str, axes: list[str], *, full: bool = False) -> Computed:
    block, body = marched_and_slid(case, full)
    cycles = [
        two_cycles(one.to_dataset()[["friction"]], body.model)
        for one in (body.result, block.marched())
    ]
    dataset = side_by_side(_NAMES, cycles, body.result.static_drive_force)
    return dataset.sel(axis=axes), [body, block]


@figure("5.2", drawings.pressure)
def _pressure() -> Computed:
    kinds: tuple[pressed.Kind, ...] = ("nodes", "surface")
    shifts = np.linspace(0.0, 1.0, 9)
    half, peak = pressed.hertz()
    found = {kind: [pressed.press(kind, shift) for shift in shifts] for kind in kinds}
    middle = len(shifts) // 2
    profiles: dict[str, Any] = {}
    for kind in kinds:
        profile = found[kind][middle]
        at = f"x_{kind}"
        profiles[at] = ((at,), profile.x, "m", "distance from the middle of the cylinder")
        profiles[f"pressure_{kind}"] = ((at,), profile.pressure, "Pa", f"pressure, {kind}")
    x = np.linspace(-half, half, 201)
    dataset = described(
        shift=(("shift",), shifts, "1", "place of the cylinder in elements from a line of nodes"),
        kind=(("kind",), _objects(kinds), "1", "where the pressure acts"),
        greatest=(
            ("kind", "shift"),
            np.array([[one.pressure.max() for one in found[kind]] for kind in kinds]),
            "Pa", "greatest pressure",
        ),
        approach=(
            ("kind", "shift"),
            np.array([[one.approach for one in found[kind]] for kind in kinds]),
            "m", "approach of the cylinder",
        ),
        x=(("x",), x, "m", "distance from the middle of the cylinder"),
        hertz=(
            ("x",), peak * np.sqrt(np.clip(1.0 - (x / half) ** 2, 0.0, 1.0)), "Pa",
            "pressure after Hertz",
        ),
        shift_shown=((), shifts[middle], "1", "place of the cylinder in the profile"),
        element=((), pressed.SIZE[0] / pressed.ELEMENTS[0], "m", "width of an element"),
        **profiles,
    )  # fmt: skip
    return dataset, [
        "asperity.thesis.contact.pressed.press(kind, shift)",
        "asperity.thesis.contact.pressed.hertz()",
    ]
