"""Claims 5.1, 5.3, 5.4 and 7.8: the elastic block against the sliding body."""

from collections.abc import Sequence

import numpy as np

from asperity.thesis.contact import elastic
from asperity.thesis.contact.blocks import Settled, problem_of
from asperity.thesis.contact.elastic import LONGITUDINAL, ON_BODY, RATIO, SLIDING, STIFF, TRANSVERSE
from asperity.thesis.exhibits import claim
from asperity.thesis.products import ARITHMETIC, NOT_TESTABLE, Finding
from asperity.thesis.sliding.bodies import PERIODIC, Body, Sweep

_SAME = 0.01
_READ = 0.02  # of mu F_N, that can be read off a figure with an axis from 0 to 1
# At k = 20 along the drive that is a third of the ratio. Of the ratio the block's compliance takes
# about 1 %, and one read off a figure of the thesis is no surer than this.
_SAME_SHARE = 0.02


_WITHIN = f"within {_SAME:g} of mu F_N and {_SAME_SHARE:.0%} of the ratio"


def _apart(solved: Sequence[Settled]) -> tuple[float, float, float, float]:
    """Most apart from the sliding body, absolutely and relatively, and from those in series."""
    ratio, slider, series, rocking = (
        np.array([getattr(one, name) for one in solved])
        for name in ("ratio", "slider", "in_series", "rocking")
    )
    return (
        float(np.abs(ratio - slider).max()),
        float(np.abs(ratio / slider - 1.0).max()),
        float(np.abs(ratio - series).max()),
        float(np.abs(ratio - rocking).max()),
    )


def marched_and_slid(case: str, full: bool = False) -> tuple[elastic.BlockFromRest, Body]:
    """The block marched from rest that is shown of a case, and the sliding body that it is."""
    (block,) = elastic.from_rest(case, full)
    settings = (setting for setting in block.settings if not setting.startswith("block."))
    return block, Body(SLIDING[case], tuple(settings))


@claim("5.1")
def _equal_ratios() -> Finding:
    groups = {
        "longitudinal": elastic.over_ratio(LONGITUDINAL),
        "transverse": elastic.over_ratio(TRANSVERSE),
        "coupled": elastic.over_direction(),
    }
    apart, numbers = {}, {}
    for name, blocks in groups.items():
        part = apart[name] = _apart([block.settled() for block in blocks])
        numbers[f"{name}_largest_difference"] = part[0]
        numbers[f"{name}_largest_relative_difference"] = part[1]
        numbers[f"{name}_largest_difference_with_compliance"] = part[2]
        numbers[f"{name}_largest_difference_with_rocking"] = part[3]
    sprung, rocked = (max(part[n] for part in apart.values()) for n in (2, 3))
    stiff_apart, *_ = _apart([STIFF.settled()])
    block, body = marched_and_slid(LONGITUDINAL)
    marched, slid = block.marched().ratio, body.result.ratio
    parts = {
        f"“match the expected trend”, {name}: {_WITHIN}": part[0] < _SAME and part[1] < _SAME_SHARE
        for name, part in apart.items()
    }
    return Finding.judged(
        parts | {"from rest to 0.3 s, k = 6, the same": abs(marched - slid) < _SAME},
        "apart by at most "
        + ", ".join(f"{part[0]:.4f} {name} ({part[1]:.1%})" for name, part in apart.items()),
        "Percentages are of the ratio itself. The difference is the block's compliance: a sliding "
        "body with that spring between itself and its asperities is met within "
        f"{sprung:.4f} of mu F_N, and within {rocked:.5f} where the spring has the inertia of the "
        "block, which rocks on its contact when friction reverses fast. A block a hundred times as "
        f"stiff is within {stiff_apart:.5f} of the sliding body at k = 20. Marched from rest at "
        f"k = 6, in the window of that run: {marched:.4f} "
        f"against {slid:.4f}; the drive has not "
        "settled by then.",
        numbers
        | {
            "stiff_block_difference": stiff_apart,
            "ratio_from_rest": marched,
            "slider_ratio_from_rest": slid,
        },
        [
            *(one for blocks in groups.values() for one in blocks),
            STIFF,
            block,
            body,
        ],
        assumed=f"The yardsticks: {_WITHIN}. Finite elements of ours, condensed to the contact, "
        "for Abaqus's.",
    )


@claim("5.3")
def _height() -> Finding:
    mass, density = 0.5, 7850.0
    length, width, height = problem_of(LONGITUDINAL).block.size
    steel = mass / (density * length * width)
    needed = mass / (length * width * height)
    return Finding.judged(
        {
            "0.053 m high at the density of Appendix A": round(steel, 3) == 0.053,
            "0.03 m high, with the density that 5.3.1 leaves open": needed > 0.0,
        },
        f"{steel:.4f} m of steel; {height:g} m at {needed:.0f} kg/m3",
        "The two texts describe two blocks, and each follows from its own numbers: Appendix A has "
        f"steel of {density:g} kg/m3 and the height that its mass takes, 5.3.1 keeps the height "
        f"of {height:g} m and sets the mass by the density. The blocks here are those of 5.3.1. "
        "A taller block of less density yields and rocks a little more.",
        {"height_m": steel, "density_at_0.03_m_kg_per_m3": needed},
        ["mass / (density * length * width)", f"asperity block {LONGITUDINAL}"],
        verdict=ARITHMETIC,
    )


@claim("5.4")
def _solver() -> Finding:
    blocks = [one.settled() for one in elastic.over_ratio(LONGITUDINAL)]
    apart, _, sprung, rocked = _apart(blocks)
    stiff, *_ = _apart([STIFF.settled()])
    return Finding.judged(
        {},
        f"elastic block {apart:.4f} from the sliding body, {stiff:.5f} a hundred times as stiff",
        "The curves that differ, Figures 5.6, 5.7, 5.9 and 5.10, are lost, and Abaqus's solver is "
        "not ours. Of finite elements solved to rounding what remains is the block's compliance, "
        f"no error of a solver: with its spring the sliding body is within {sprung:.4f}, with its "
        f"inertia within {rocked:.5f}, and it vanishes as the block is made stiff. A finer mesh "
        "changes that compliance little.",
        {"apart": apart, "apart_stiff": stiff, "apart_with_compliance": sprung},
        [*elastic.over_ratio(LONGITUDINAL), STIFF],
        verdict=NOT_TESTABLE,
    )


@claim("7.8")
def _base_or_body() -> Finding:
    cases = (LONGITUDINAL, TRANSVERSE)
    blocks = {case: elastic.over_ratio(case, on_body=True) for case in cases}
    ours, theirs = (
        {
            case: np.split(np.array([getattr(b.settled(), name) for b in group]), 2)
            for case, group in blocks.items()
        }
        for name in ("ratio", "slider")
    )
    along, across = (float(np.abs(ours[c][0] - ours[c][1]).max()) for c in cases)
    along_share, across_share = (float(np.abs(ours[c][1] / ours[c][0] - 1.0).max()) for c in cases)
    slid = float(np.abs(np.subtract(*theirs[TRANSVERSE])).max())
    axes = ((RATIO, ",".join(f"{k:g}" for k in elastic.RATIOS[TRANSVERSE])),)
    guided = [
        Sweep(SLIDING[TRANSVERSE], axes, (PERIODIC, "slider.lateral=guided", *mode))
        for mode in ((), (ON_BODY,))
    ]
    held = float(np.abs(guided[0].ratios() - guided[1].ratios()).max())
    return Finding.judged(
        {
            f"longitudinal: within {_READ:g} on an axis from 0 to 1": along < _READ,
            f"transverse: within {_READ:g} on an axis from 0 to 1": across < _READ,
        },
        f"apart by at most {along:.4f} longitudinal ({along_share:.1%}), {across:.4f} transverse "
        f"({across_share:.1%})",
        "“All results follow the same trend”, and they do, with the law of section 7.3 on both "
        "sides; what "
        "Appendix E does instead is claim 7.20. “This is because both methods create the same "
        "relative velocity” is not quite so where eta_y is below 1: of a body that is shaken the "
        "contact sees all lateral motion with the share eta_y, its answer to friction among it; "
        "of a base that is shaken, the base's motion alone. The sliding body is apart by "
        f"{slid:.4f} for that reason, and by {held:.0e} where it is guided and cannot answer.",
        {
            "longitudinal_largest_difference": along,
            "transverse_largest_difference": across,
            "longitudinal_largest_relative_difference": along_share,
            "transverse_largest_relative_difference": across_share,
            "slider_transverse_largest_difference": slid,
            "guided_slider_transverse_largest_difference": held,
        },
        [*(block for group in blocks.values() for block in group), *guided],
        assumed=f"The yardstick, {_READ:g} of mu F_N: what can be read off such a figure.",
    )
