"""Figures 5.2, 5.5 to 5.11, 7.8 and 7.9: elastic blocks on the curves of the sliding body."""

import functools
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from asperity.slider.closed_forms import longitudinal_ratio, transverse_ratio
from asperity.thesis.contact import drawings, pressed
from asperity.thesis.contact.blocks import LIGHT, Block, settle_all
from asperity.thesis.contact.claims import (
    ACROSS,
    ALONG,
    DIRECTIONS,
    FROM_REST,
    LONGITUDINAL,
    ON_BODY,
    SLIDING,
    TRANSVERSE,
    at_ratios,
    in_directions,
)
from asperity.thesis.exhibits import Drawn, FigureOf, labelled
from asperity.thesis.sliding import drawings as drawings_sliding
from asperity.thesis.sliding.bodies import PERIODIC, Body, Sweep
from asperity.thesis.sliding.claims import DIRECTION, PLOTTED, RATIO
from asperity.thesis.sliding.figures import side_by_side, two_cycles

ALL_DIRECTIONS = tuple(np.arange(0.0, 360.1, 15.0).tolist())
FINE = ("solve.duration=0.3 s", "solve.step=1 us")

_DENSE = "0.1:20:0.1"
_NAMES = ("sliding body", "elastic block")
_CLOSED = "asperity.slider.closed_forms"


def _over_ratio(case: str, mesh: Sequence[str], ratios: Sequence[float], *, on_body: bool) -> Drawn:
    """The sliding body as a line, blocks as markers, and how far they are apart."""
    base = at_ratios(case, ratios, mesh)
    shaken = at_ratios(case, ratios, (*mesh, ON_BODY)) if on_body else []
    solved = settle_all([*base, *shaken])
    groups = [solved[: len(base)], solved[len(base) :]][: 1 + on_body]
    modes = [(), (ON_BODY,)][: 1 + on_body]
    sweeps = [Sweep(SLIDING[case], ((RATIO, _DENSE),), (PERIODIC, *mode)) for mode in modes]
    dense = sweeps[0].values()
    if case == LONGITUDINAL:
        rigid, closed = longitudinal_ratio(dense), f"{_CLOSED}.longitudinal_ratio(k)"
    else:
        rigid, closed = transverse_ratio(0.71 * dense), f"{_CLOSED}.transverse_ratio(0.71 * k)"
    place = ("shaken", "k_block")
    dataset = labelled(
        k=(("k",), dense, "1", "velocity ratio v_a/v_d"),
        k_block=(("k_block",), np.array(ratios), "1", "velocity ratio v_a/v_d, blocks"),
        shaken=(("shaken",), _objects(["base", "body"][: len(groups)]), "1", "what is shaken"),
        periodic=(
            ("shaken", "k"), np.array([sweep.ratios() for sweep in sweeps]), "1",
            "ratio, sliding body, periodic state",
        ),
        rigid=(("k",), rigid, "1", "ratio, rigid Coulomb friction and rigid drive"),
        **_compared(groups, place),
    )  # fmt: skip
    how = [
        *(sweep.command for sweep in sweeps), closed, *(block.how for block in (*base, *shaken)),
    ]  # fmt: skip
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


def _over_direction(mesh: Sequence[str], directions: Sequence[float]) -> Drawn:
    blocks = in_directions(directions, mesh)
    solved = settle_all(blocks)
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


def _from_rest(
    case: str,
    ratio: str,
    mesh: Sequence[str],
    keep: str,
    part: Callable[..., Any] | None,
    axes: Sequence[str],
) -> Drawn:
    """The sliding body and the block marched from rest side by side."""
    settings = (f"{RATIO}={ratio}", *(FROM_REST if mesh else FINE))
    body, block = Body(SLIDING[case], settings), Block(case, (*mesh, *settings))
    results = [body.solve(), block.march()]
    if part is None:
        dataset = side_by_side(_NAMES, results, keep)
        figure = drawings_sliding.drive_over_time(dataset)
    else:
        dataset = side_by_side(_NAMES, results, keep, part).sel(axis=list(axes))
        figure = drawings_sliding.friction_over_cycles(dataset)
    return Drawn(figure, dataset, [body.command, block.command])


def _drive(case: str, ratio: str, mesh: Sequence[str]) -> Drawn:
    return _from_rest(case, ratio, mesh, "drive_force", None, ())


def _friction(case: str, ratio: str, mesh: Sequence[str], axes: Sequence[str]) -> Drawn:
    return _from_rest(case, ratio, mesh, "friction", two_cycles, axes)


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


_BLOCK = (
    "Lines: the sliding body of chapter 4; markers: the elastic block, its friction read after it "
    "has settled from the sliding body's periodic state, over sixteen cycles or more until four "
    "parts of them agree within 0.1 %. Below: how far it is from the sliding body, from one that "
    "has the block's compliance as a spring between itself and its asperities, and from one that "
    "rocks on it as the block does."
)
_REST = "From rest over 0.3 s, with the same increments for the sliding body and the block."
_ALONG, _ACROSS = ((case, SLIDING[case]) for case in (LONGITUDINAL, TRANSVERSE))


def _two(
    number: str, title: str, caption: str, cases: tuple[str, ...], make: Callable[..., Drawn],
    *, full: Callable[[], Drawn] | None = None,
) -> FigureOf:  # fmt: skip
    """A figure on the light mesh and, where more is asked for, on that of the shipped case."""
    return FigureOf(
        number, title, caption, cases,
        functools.partial(make, mesh=LIGHT), full or functools.partial(make, mesh=()),
    )  # fmt: skip


FIGURES = (
    FigureOf(
        "5.2", "Contact at nodes and integrated over the surface",
        "A rigid cylinder on a block of 8-node elements nearly as wide as the contact's "
        "half-width, with the same law of pressure and the same load. Above: it stands between two "
        "lines of nodes; so coarse, neither is Hertz's pressure point by point, at nodes too low, "
        "integrated as much too high in the middle. Below, what tells them apart: how "
        "far it goes while it moves over an element; held at nodes alone it sinks between them, "
        "integrated less than half as much.",
        (), figure_5_2,
    ),
    _two(
        "5.5", "Longitudinal vibration: the elastic block",
        f"Table 4.3. {_BLOCK}", _ALONG,
        functools.partial(_over_ratio, LONGITUDINAL, ratios=ALONG, on_body=False),
    ),
    _two(
        "5.6", "Drive force of the elastic block, longitudinal, k = 6",
        f"Table 4.3. {_REST}", _ALONG, functools.partial(_drive, LONGITUDINAL, "6"),
    ),
    _two(
        "5.7", "Friction of the elastic block, longitudinal, k = 6",
        f"Table 4.3, two cycles at the end. {_REST}", _ALONG,
        functools.partial(_friction, LONGITUDINAL, "6", axes=("x",)),
    ),
    _two(
        "5.8", "Transverse vibration: the elastic block",
        f"Table 4.4. {_BLOCK}", _ACROSS,
        functools.partial(_over_ratio, TRANSVERSE, ratios=ACROSS, on_body=False),
    ),
    _two(
        "5.9", "Drive force of the elastic block, transverse, k = 20",
        f"Table 4.4. {_REST}", _ACROSS, functools.partial(_drive, TRANSVERSE, "20"),
    ),
    _two(
        "5.10", "Friction of the elastic block, transverse, k = 20",
        f"Table 4.4, two cycles at the end. {_REST}", _ACROSS,
        functools.partial(_friction, TRANSVERSE, "20", axes=("x", "y")),
    ),
    _two(
        "5.11", "The elastic block in every direction of vibration",
        "Table 4.4. Lines: the sliding body of chapter 4; markers: the elastic block. Below: how "
        "far it is from the sliding body.", _ACROSS,
        functools.partial(_over_direction, directions=DIRECTIONS),
        full=functools.partial(_over_direction, (), ALL_DIRECTIONS),
    ),
    _two(
        "7.8", "Transverse vibration of the base or of the block",
        f"Table 4.4. {_BLOCK}", _ACROSS,
        functools.partial(_over_ratio, TRANSVERSE, ratios=ACROSS, on_body=True),
    ),
    _two(
        "7.9", "Longitudinal vibration of the base or of the block",
        f"Table 4.3. {_BLOCK}", _ALONG,
        functools.partial(_over_ratio, LONGITUDINAL, ratios=ALONG, on_body=True),
    ),
)  # fmt: skip
