"""Figures 5.2, 5.5 to 5.11, 7.8 and 7.9: elastic blocks on the curves of the sliding body."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from asperity.block.problem import BlockProblem
from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.contact.interface.normal import NormalLaw, pressure
from asperity.slider.closed_forms import longitudinal_ratio, transverse_ratio
from asperity.thesis.contact import drawings, pressed
from asperity.thesis.contact.elastic import (
    ALL_DIRECTIONS,
    DIRECTION,
    DIRECTIONS,
    LONGITUDINAL,
    ON_BODY,
    RATIO,
    SLIDING,
    TRANSVERSE,
    BlockFromRest,
    from_rest,
    over_direction,
    over_ratio,
    ratios,
)
from asperity.thesis.exhibits import Drawn, labelled
from asperity.thesis.sliding import drawings as drawings_sliding
from asperity.thesis.sliding.bodies import PERIODIC, Body, Sweep
from asperity.thesis.sliding.claims import PLOTTED
from asperity.thesis.sliding.figures import side_by_side, two_cycles

_DENSE = "0.1:20:0.1"
_EDGE = 5e-3  # m, of an element of the shipped block
_NAMES = ("sliding body", "elastic block")
_CLOSED = "asperity.slider.closed_forms"


def _over_ratio(case: str, full: bool, *, on_body: bool = False) -> Drawn:
    """The sliding body as a line, blocks as markers, and how far they are apart."""
    over = ratios(case)
    blocks = over_ratio(case, full, on_body=on_body)
    modes = [(), (ON_BODY,)][: 1 + on_body]
    solved = [block.settled() for block in blocks]
    groups = [solved[n : n + len(over)] for n in range(0, len(solved), len(over))]
    sweeps = [Sweep(SLIDING[case], ((RATIO, _DENSE),), (PERIODIC, *mode)) for mode in modes]
    dense = sweeps[0].values()
    if case == LONGITUDINAL:
        rigid, closed = longitudinal_ratio(dense), f"{_CLOSED}.longitudinal_ratio(k)"
    else:
        rigid, closed = transverse_ratio(0.71 * dense), f"{_CLOSED}.transverse_ratio(0.71 * k)"
    place = ("shaken", "k_block")
    dataset = labelled(
        k=(("k",), dense, "1", "velocity ratio v_a/v_d"),
        k_block=(("k_block",), np.array(over), "1", "velocity ratio v_a/v_d, blocks"),
        shaken=(("shaken",), _objects(["base", "body"][: len(groups)]), "1", "what is shaken"),
        periodic=(
            ("shaken", "k"), np.array([sweep.ratios() for sweep in sweeps]), "1",
            "ratio, sliding body, periodic state",
        ),
        rigid=(("k",), rigid, "1", "ratio, rigid Coulomb friction and rigid drive"),
        **_compared(groups, place),
    )  # fmt: skip
    how = [*(sweep.command for sweep in sweeps), closed, *(block.how for block in blocks)]
    return Drawn(drawings.over_ratio(dataset), dataset, how)


def _compared(groups: Any, place: tuple[str, ...]) -> dict[str, Any]:
    """Ratios of settled blocks and of the bodies beside them."""

    def of(name: str) -> Any:
        return np.array([[getattr(one, name) for one in group] for group in groups])

    return {
        "block": (place, of("ratio"), "1", "ratio, elastic block"),
        "slider": (place, of("slider"), "1", "ratio, sliding body at the same point"),
        "in_series": (
            place, of("in_series"), "1", "ratio, sliding body with the block's compliance"
        ),
        "rocking": (
            place, of("rocking"), "1", "ratio, that body with the inertia of the block's turns"
        ),
        "unsteadiness": (
            place, of("unsteadiness"), "1", "half of what four windows of the block are apart"
        ),
    }  # fmt: skip


def _objects(names: Sequence[str]) -> Any:
    return np.array(names, dtype=object)


def figure_5_11(*, full: bool = False) -> Drawn:
    """Ratio over direction."""
    directions = ALL_DIRECTIONS if full else DIRECTIONS
    blocks = over_direction(full)
    solved = [block.settled() for block in blocks]
    count = len(directions)
    groups = [solved[n : n + count] for n in range(0, len(solved), count)]
    settled = Sweep(SLIDING[TRANSVERSE], ((RATIO, PLOTTED), (DIRECTION, "0:360:3")), (PERIODIC,))
    dataset = labelled(
        k=(("k",), settled.values(), "1", "velocity ratio v_a/v_d"),
        theta=(("theta",), settled.values(1), "deg", "direction of vibration"),
        theta_block=(("theta_block",), np.array(directions), "deg", "direction, blocks"),
        periodic=(("k", "theta"), settled.ratios(), "1", "ratio, sliding body, periodic state"),
        **_compared(groups, ("k", "theta_block")),
    )
    how = [settled.command, *(block.how for block in blocks)]
    return Drawn(drawings.over_direction(dataset), dataset, how)


def figure_5_3() -> Drawn:
    """Pressure over overclosure by two laws."""
    case = read_case(LONGITUDINAL, case_tables())
    stiffness = BlockProblem.from_case(case).normal.stiffness
    laws = {
        "linear": NormalLaw("linear", stiffness),
        "two-stage": NormalLaw.two_stage(stiffness, _EDGE),
    }
    start, end = laws["two-stage"].start, laws["two-stage"].end
    over = np.linspace(-0.2 * end, 1.6 * end, 361)
    found = np.array([[pressure(x, 0.0, law.numbers) for x in over] for law in laws.values()])
    dataset = labelled(
        law=(("law",), _objects([*laws]), "1", "law of pressure"),
        overclosure=(("overclosure",), over, "m", "overclosure"),
        pressure=(("law", "overclosure"), found[..., 0], "Pa", "pressure"),
        slope=(("law", "overclosure"), found[..., 1], "Pa/m", "rise of pressure over overclosure"),
        start=((), start, "m", "overclosure from which the stiffness rises"),
        end=((), end, "m", "overclosure up to which it rises"),
    )
    how = [
        f"asperity.contact.interface.normal.NormalLaw, a final stiffness of {stiffness:.4g} Pa/m"
    ]
    return Drawn(drawings.normal_laws(dataset), dataset, how)


def _drive(case: str, full: bool) -> Drawn:
    body, block = _from_rest(case, full)
    result = body.solve()
    histories = [one.to_dataset()[["drive_force"]] for one in (result, block.marched())]
    dataset = side_by_side(_NAMES, histories, result.static_drive_force)
    return Drawn(drawings_sliding.drive_over_time(dataset), dataset, [body.command, block.command])


def _friction(case: str, full: bool, axes: Sequence[str]) -> Drawn:
    body, block = _from_rest(case, full)
    result = body.solve()
    cycles = [
        two_cycles(one.to_dataset()[["friction"]], result.model)
        for one in (result, block.marched())
    ]
    dataset = side_by_side(_NAMES, cycles, result.static_drive_force).sel(axis=list(axes))
    figure = drawings_sliding.friction_over_cycles(dataset)
    return Drawn(figure, dataset, [body.command, block.command])


def _from_rest(case: str, full: bool) -> tuple[Body, BlockFromRest]:
    """The block marched from rest, and the sliding body that it is."""
    (block,) = from_rest(case, full)
    settings = [setting for setting in block.settings if not setting.startswith("block.")]
    return Body(SLIDING[case], tuple(settings)), block


def figure_5_6(*, full: bool = False) -> Drawn:
    """Drive force from rest, longitudinal, k = 6."""
    return _drive(LONGITUDINAL, full)


def figure_5_7(*, full: bool = False) -> Drawn:
    """Friction from rest, longitudinal, k = 6."""
    return _friction(LONGITUDINAL, full, ["x"])


def figure_5_9(*, full: bool = False) -> Drawn:
    """Drive force from rest, transverse, k = 20."""
    return _drive(TRANSVERSE, full)


def figure_5_10(*, full: bool = False) -> Drawn:
    """Friction from rest, transverse, k = 20."""
    return _friction(TRANSVERSE, full, ["x", "y"])


def figure_5_5(*, full: bool = False) -> Drawn:
    """Ratio over k, longitudinal."""
    return _over_ratio(LONGITUDINAL, full)


def figure_5_8(*, full: bool = False) -> Drawn:
    """Ratio over k, transverse."""
    return _over_ratio(TRANSVERSE, full)


def figure_7_8(*, full: bool = False) -> Drawn:
    """Ratio over k, transverse, base or block shaken."""
    return _over_ratio(TRANSVERSE, full, on_body=True)


def figure_7_9(*, full: bool = False) -> Drawn:
    """Ratio over k, longitudinal, base or block shaken."""
    return _over_ratio(LONGITUDINAL, full, on_body=True)


def figure_5_2() -> Drawn:
    """Pressure under a cylinder, at nodes and integrated."""
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
    dataset = labelled(
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
    how = [
        "asperity.thesis.contact.pressed.press(kind, shift)",
        "asperity.thesis.contact.pressed.hertz()",
    ]
    return Drawn(drawings.pressure(dataset), dataset, how)
