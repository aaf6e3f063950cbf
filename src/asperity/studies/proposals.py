"""Worm gearsets for a ratio, a torque and a speed: proposals over the series that are made.

Every combination of starts, standard centre distance, module and profile shift is rated by all
three standards at once. Of those that hold, the ones stay that no other beats in size, efficiency
and margin together; where none holds, the nearest ones are told as such.
"""

import math
from collections.abc import Callable, Iterator, Mapping
from typing import Any

import numpy as np

from asperity.arrays import FloatArray
from asperity.errors import InputError, one_of
from asperity.formulas import masking
from asperity.gearset.hob_shelf import hob_of, shelf
from asperity.gearset.parameters import Gearset
from asperity.gearset.threads import thread_room
from asperity.rating.bs721.tables import Tables
from asperity.rating.demands import DEMANDS
from asperity.rating.parameters import Operation, RatingOptions
from asperity.rating.self_locking import locking_margins
from asperity.rating.standards import STANDARDS, tables_of
from asperity.rating.variants import Variants, variants
from asperity.studies.chosen import Borne, Chosen, Judges, choose, undominated, weakest
from asperity.studies.proposed import MOST, Proposal, Proposals, gearset_keys
from asperity.studies.requirements import Requirements, special_hob
from asperity.studies.series import grid
from asperity.units.standards import FROM_SI

RANKS = {"size": "centre_distance", "efficiency": "efficiency", "margin": "margin"}
LOCKS = ("", "rest", "motion")
"""When the worm must lock itself; empty: never."""


def propose(
    gear_ratio: float,
    gearset: Gearset,
    operation: Operation,
    options: RatingOptions | None = None,
    *,
    rank: str = "size",
    exact: bool = False,
    can_be_cut: Callable[[Mapping[str, Any]], bool] | None = None,
    held: Mapping[str, float] | None = None,
    locks: str = "",
    requirements: Requirements | None = None,
    borne: Callable[[Mapping[str, Any]], Borne] | None = None,
    details: Callable[[Mapping[str, Any]], Mapping[str, Any]] | None = None,
) -> Proposals:
    """Propose gearsets for a ratio, by the torque and the speed of an operation.

    Parameters
    ----------
    gear_ratio : float
        Wanted ratio of the speeds, 3 to 100; teeth are counted, so that it is met within 3 %.
    gearset : Gearset
        Materials, roughness, flank and whatever is not proposed.
    operation : Operation
        Torque, speed, lubricant, life.
    options : RatingOptions, optional
        How they are rated.
    rank : {'size', 'efficiency', 'margin'}
        What the first one is best in.
    exact : bool
        Whether the teeth must give the ratio as nearly as they can; else a tooth more or less is
        proposed too.
    can_be_cut : callable, optional
        Whether a hob cuts the wheel of a gearset with the keys of a `Proposal`. What is shown is
        asked for, and others take the place of what cannot be cut.
    held : mapping of str to float, optional
        What of the macro-geometry is given and not proposed, see `asperity.studies.series.grid`.
    locks : {'', 'rest', 'motion'}
        Whether the worm must lock itself, at rest or in motion, by every standard that rates it.
    requirements : Requirements, optional
        What is kept beside the safeties.
    borne : callable, optional
        What shafts and bearings of a gearset with such keys come to; it raises InputError where
        they cannot be judged. Those that nothing else beats are asked for.
    details : callable, optional
        What else a `Proposal` tells of a gearset with its keys; those that are shown are asked for.

    Returns
    -------
    Proposals
        The best first.

    Raises
    ------
    InputError
        A rank that is not known, a ratio that no gearset has, or a case that no standard rates.
    """
    if rank not in RANKS:
        raise InputError(f"--rank {rank}: {one_of(RANKS, rank)}")
    if not 3.0 <= gear_ratio <= 100.0:
        raise InputError(f"ratio is {gear_ratio:g}; it must be from 3 to 100")
    if locks not in LOCKS:
        raise InputError(f"--locks {locks}: {one_of(LOCKS[1:], locks)}")
    keeps = requirements or Requirements()
    hobs = shelf(keeps.hobs, gearset)
    designs = grid(gear_ratio, held or {}, exact=exact, off=keeps.ratio_tolerance, hobs=hobs)
    tried = np.array(designs).T
    room = thread_room(
        gearset.flank, gearset.tooth_proportions, tried[0], tried[4], gearset.pressure_angle
    )
    starts, teeth, distance, module, factor, shift = tried[:, room > 0.0]
    if not starts.size:
        raise InputError(
            f"gearset.pressure_angle is {math.degrees(gearset.pressure_angle):.4g} deg, with which "
            f"every thread for a ratio of {gear_ratio:g} is pointed: take a smaller one"
        )
    rated = variants(
        gearset,
        operation,
        options,
        STANDARDS,
        starts=starts,
        wheel_teeth=teeth,
        centre_distance=distance / FROM_SI["mm"],
        axial_module=module / FROM_SI["mm"],
        diameter_factor=factor,
    )
    if "iso14521.eta_ges" not in rated:
        why = next(note for note in rated.notes if note.startswith("iso14521: "))
        raise InputError(
            f"gearsets are proposed by the efficiency of ISO/TR 14521: {why.partition(': ')[2]}"
        )
    margins, least, rated_by_all = _margins(rated)
    efficiency = np.asarray(rated["iso14521.eta_ges"])
    known = np.isfinite(margins) & np.isfinite(efficiency) & (efficiency > 0.0)
    locking = _locking(rated, tables_of(options or RatingOptions(), None))
    if locks:
        known &= np.all([margin >= 0.0 for margin in locking[locks].values()], axis=0)
    kept_too = keeps.kept(rated, locking["rest"])
    if known.any() and not (known & kept_too).any():
        raise InputError(
            f"[requirements] asks for {keeps.said}, which no gearset of the series for a ratio of "
            f"{gear_ratio:g} has: ask for less, or choose another ratio"
        )
    known &= kept_too
    holding = known & (margins >= keeps.safety) & rated_by_all
    if not holding.any():
        holding = known & (margins >= keeps.safety)
    kept = np.flatnonzero(holding if holding.any() else known)
    if not len(kept):
        if locks:
            when = "at rest" if locks == "rest" else "in motion"
            raise InputError(
                f"no gearset of the series that can be rated locks itself {when} by every "
                "standard: take a larger ratio, or leave --locks out"
            )
        other = " or hold less of the gearset with --set" if held else ""
        raise InputError(
            "no gearset of the series can be rated for this; look for a value with a wrong unit"
            f"{other}"
        )
    holds = bool(holding.any())

    def proposal(n: int) -> Proposal:
        rows, bearings, _ = chosen.borne.get(n, Borne())
        weak = rows and weakest(rows).margin == margins[n]
        return Proposal(
            int(starts[n]),
            int(teeth[n]),
            float(distance[n]),
            float(module[n]),
            float(f"{factor[n]:.12g}"),
            float(f"{shift[n]:.12g}"),
            float(efficiency[n]),
            float(margins[n]),
            weakest(rows).name if weak else DEMANDS[least[n]].path,
            bool(holding[n]) and bool(margins[n] >= keeps.safety),
            *_locks(locking, n),
            hob=hob_of(hobs or (), int(starts[n]), float(module[n]), float(factor[n])),
            rows=rows,
            bearings=bearings,
        )

    def keys(n: int) -> dict[str, Any]:
        return gearset_keys(starts[n], teeth[n], distance[n], module[n], factor[n])

    def best(of: Any) -> Any:
        if not holds:
            return of[np.argsort(-margins[of], kind="stable")[:MOST]]
        return of[undominated(np.stack([-distance, efficiency, margins], axis=-1)[of])]

    judges = Judges(keys, can_be_cut, borne)
    chosen = choose(kept, margins, best, judges, keeps.safety if holds else None)
    if holds and not len(chosen.shown) and (chosen.weak or chosen.refused):
        holds, before = False, chosen
        others = np.array([n for n in np.flatnonzero(known) if n not in before.refused], dtype=int)
        chosen = choose(others, margins, best, judges, None, before.borne)
        chosen = chosen._replace(weak=before.weak, refused=before.refused | chosen.refused)
    if not len(chosen.shown):
        raise InputError(_none_left(chosen))
    shown = chosen.shown
    notes = list(rated.notes)
    if pointed := len(designs) - starts.size:
        notes.append(f"left out: {pointed} whose worm or hob would have pointed threads")
    if chosen.uncut:
        notes.append(f"left out: {chosen.uncut} whose wheel no hob cuts (asperity flank tells why)")
    if held:
        named = ", ".join(f"gearset.{key}" for key in held)
        notes.append(f"held as it is set: {named}")
    if keeps.said:
        notes.append(f"kept as [requirements] has it: {keeps.said}")
    notes += special_hob(gearset.pressure_angle)
    if operation.wear_assumed:
        notes.append(operation.wear_assumed)
    notes += _shaft_notes(chosen)
    notes += chosen.borne.get(int(shown[0]), Borne()).lacking
    if holds:
        if not rated_by_all[shown].all():
            notes.append(
                "none holds by every standard, since one or another cannot rate these; they hold "
                "by those that can"
            )
    elif holding.any():
        notes.append("none holds with its shafts and bearings; these come nearest")
    else:
        notes.append("none holds by every standard; these come nearest")
    order = {"size": (-efficiency, distance), "efficiency": (distance, -efficiency),
             "margin": (distance, -margins)}[rank]  # fmt: skip
    if holds:
        shown = shown[np.lexsort(tuple(keys[shown] for keys in order))]
    told = tuple(map(proposal, shown))
    return Proposals(
        rated=starts.size,
        holding=int((holding & rated_by_all).sum()),
        ranked_by=rank,
        found=tuple(p._replace(**(details(p.keys) if details else {})) for p in told),
        notes=tuple(notes),
    )


def _margins(rated: Variants) -> tuple[FloatArray, Any, Any]:
    """Return of each design the least safety over what is asked, and which demand has it.

    And whether every standard has an answer: AGMA 6034 knows bronzes only, and the tables of
    BS 721 do not reach everywhere.
    """
    rows = [
        np.broadcast_to(np.asarray(rated[demand.path]) / demand.asked, rated.shape)
        if demand.path in rated
        else np.full(rated.shape, math.nan)
        for demand in DEMANDS
    ]
    stacked = np.stack(rows)
    least = np.argmin(np.where(np.isnan(stacked), math.inf, stacked), axis=0)
    margins = np.take_along_axis(stacked, least[None], axis=0)[0]
    # What ISO/TR 14521 cannot rate has no efficiency either.
    return margins, least, ~np.any(np.isnan(stacked), axis=0)


def _locking(rated: Variants, tables: Tables) -> dict[str, dict[str, FloatArray]]:
    """Return by state and standard by how much friction is above what locks; NaN without one."""
    found: dict[str, dict[str, FloatArray]] = {"rest": {}, "motion": {}}
    with masking(rated.shape):
        margins = locking_margins(rated.rating_inputs, rated, tables)
    for (standard, state), margin in margins.items():
        everywhere = np.broadcast_to(np.asarray(margin, dtype=float), rated.shape)
        # A standard without an answer has no say.
        known = rated.reason(standard) == 0
        found["rest" if state == "static" else "motion"][standard] = np.where(
            known, everywhere, math.inf
        )
    return found


def _locks(
    locking: Mapping[str, Mapping[str, FloatArray]], n: int
) -> tuple[tuple[str, ...], tuple[str, ...], str]:
    """Return by which standards a design locks, at rest and in motion, and in a word."""
    margins = {
        state: {name: float(margin[n]) for name, margin in own.items() if margin[n] < math.inf}
        for state, own in locking.items()
    }
    rest, motion = (
        tuple(name for name, margin in margins[state].items() if margin >= 0.0)
        for state in ("rest", "motion")
    )
    count = len(margins["rest"])
    word = "in motion" if len(motion) == count else "at rest" if len(rest) == count else ""
    return rest, motion, word or ("by some" if rest or motion else "no")


def _none_left(chosen: Chosen) -> str:
    """Return why nothing can be proposed of what can be rated."""
    if chosen.refused:
        return next(iter(chosen.refused.values()))
    return (
        "no hob cuts the wheel of any gearset that could be proposed (asperity flank tells why): "
        "take another gearset.flank, pressure angle or ratio"
    )


def _shaft_notes(chosen: Chosen) -> Iterator[str]:
    """Yield how many were left out for their shafts and bearings, and why."""
    if chosen.weak:
        nearest = max(chosen.weak, key=lambda row: row.margin)
        yield (
            f"left out: {len(chosen.weak)} whose shafts or bearings do not hold; nearest to it: "
            f"{nearest.name} by {nearest.standard}, {nearest.stands}"
        )
    if chosen.refused:
        why = next(iter(chosen.refused.values()))
        yield f"left out: {len(chosen.refused)} whose shafts cannot be judged: {why}"
