"""Claims 7.2, 7.3, 7.7, 7.10, 7.15 and 7.17: the gearset marched under vibration."""

import math
from collections.abc import Iterable

import numpy as np

from asperity.drive.point import MeshPoint
from asperity.slider.closed_forms import transverse_ratio
from asperity.thesis.drive.claims import FRICTION, assumed, geometry
from asperity.thesis.drive.figures import floor, system_efficiencies
from asperity.thesis.drive.marches import Shaken
from asperity.thesis.drive.sets import (
    AMPLITUDE,
    FREQUENCY,
    LOAD,
    RATIO,
    RATIOS,
    SHAKEN,
    SPEED,
    UNSHAKEN,
    conditions,
)
from asperity.thesis.drive.simulations import (
    ACTUATOR,
    BASE,
    MESHES,
    Simulation,
    meshes,
    of_set,
    on_mesh,
)
from asperity.thesis.exhibits import claim
from asperity.thesis.products import ARITHMETIC, FITTED, NOT_TESTABLE, Finding
from asperity.thesis.rating.printed import EFFICIENCY
from asperity.thesis.rating.rated import GEARSET_2, GEARSET_3

_NEAR = 0.03
"""Of a torque that is reconstructed."""


_TURNS = 24.0
"""Of the worm in set 3, 1/s."""
_FIRST = 50
"""Cycles."""
_APART = 0.1
_CLEAR = 0.03
"""A difference of two ratios that a figure would show clearly."""


def _parted(runs: "list[Shaken]") -> str:
    """Say how long contact is lost at most."""
    most = max(one.open for one in runs)
    return f"part for up to {most:.0%} of the time" if most > 0.0 else "never part"


def _state(shaken: Shaken) -> str:
    return "settled" if shaken.settled else "not settled"


@claim("7.2")
def _static() -> Finding:
    teeth = meshes()[0]
    found = teeth.loaded()
    pair = geometry()
    rated = GEARSET_3.number("iso14521", "eta_z1_2")
    reference = 0.5 * pair.diameter_factor * pair.axial_module
    plain = MeshPoint.of(pair, 1e-3 * reference).worm_torque(LOAD, FRICTION)
    by_standard, by_torque = LOAD / (RATIO * rated), LOAD / (RATIO * UNSHAKEN)
    return Finding.judged(
        {
            f"33.8 N m within {_NEAR:.0%}": abs(found.torque / UNSHAKEN - 1.0) < _NEAR,
            f"72 % within {_NEAR:.0%}": abs(found.efficiency / by_torque - 1.0) < _NEAR,
        },
        f"{found.torque:.2f} N m, {found.efficiency:.1%} for {rated:.1%} by the standard",
        "Gearset 3 was made from the printed efficiency of the same friction and load (claim 3.8), "
        f"which gives {by_standard:.1f} N m before any flank: within a few percent the torque, and "
        "the efficiency, which is the torque once more, could not be another. What elastic teeth "
        "add is where they touch, outside the worm's reference circle, at "
        f"{1e3 * found.radius:.2f} mm for {reference:.2f} mm, and that hangs on "
        "the hob: friction has the longer lever there and the sliding is faster, "
        f"{1e3 * found.sliding_speed:.0f} mm/s for {1e3 * SPEED:.0f}. "
        "“Simulated efficiency differs against theoretical by only 1%” is right of the thesis's "
        "own numbers; ours is "
        f"{100.0 * (rated - found.efficiency):.1f} points below the standard's. At one point of "
        f"the reference circle it would be {plain:.2f} N m; the standard's friction angle leaves "
        f"the pressure angle out. Without friction {found.frictionless:.2f} N m.",
        {
            "torque_Nm": found.torque,
            "efficiency": found.efficiency,
            "torque_without_friction_Nm": found.frictionless,
            "torque_reversed_Nm": found.turned_round,
            "deflection_urad": 1e6 * found.deflection,
            "radius_mm": 1e3 * found.radius,
            "efficiency_by_ISO_TR_14521": rated,
            "torque_at_reference_circle_Nm": plain,
        },
        [teeth, GEARSET_3],
        verdict=FITTED,
        assumed=f"Friction of {FRICTION:g} on exact flanks; the hob, which is borrowed; the "
        "yardsticks.",
    )


@claim("7.5")
def _densities() -> Finding:
    teeth = meshes()
    found = [one.loaded() for one in teeth]
    runs = {name: on_mesh(name) for name in MESHES}
    shaken = [[run.shaken() for run in group] for group in runs.values()]
    ratios = np.array([[one.ratio for one in group] for group in shaken])
    settled = np.min([[one.settled for one in group] for group in shaken], axis=0).astype(bool)
    steps = np.abs(np.diff(ratios, axis=0))  # coarse to intermediate, intermediate to fine
    first, second = (step[settled].max(initial=0.0) for step in steps)
    nearer = int((steps[1] < steps[0])[settled].sum())
    places = [RATIOS.index(k) for k in (5.0, RATIOS[-1])]
    shown = (
        f"{', '.join(f'{ratio:.3f}' for ratio in ratios[:, at])} at k_w = {RATIOS[at]:g}"
        + ("" if settled[at] else ", not all settled")
        for at in places
    )
    loose = ", ".join(f"{k:g}" for k, ends in zip(RATIOS, settled, strict=True) if not ends)

    def each(values: Iterable[float], form: str) -> str:
        return " and ".join(format(value, form) for value in values)

    return Finding.judged(
        {},
        f"ratio under vibration on the coarse, intermediate and fine mesh {'; '.join(shown)}",
        "The element sizes of Table 7.4 and the faceted flanks that were meshed are lost. On exact "
        "flanks, which are the same on every mesh, three densities of one family (figure 7.11) "
        f"are at most {first:.3f} of the ratio apart from coarse to intermediate and {second:.3f} "
        f"from intermediate to fine, at the {settled.sum()} of {len(RATIOS)} velocity ratios where "
        f"all three have settled; intermediate and fine are the closer pair at {nearer} of these. "
        + (f"At k_w = {loose} flanks hammer and one or more have not settled: there each has a "
           "ratio of its own, as states do that differ by nothing else (figure 7.14). "
           if loose else "")
        + "What the density changes is how far the teeth deflect under load, "
        f"{each((1e6 * one.deflection for one in found), '.0f')} urad with the shaft's twist on "
        "the coarse and the intermediate mesh; static torques "
        f"{each((one.torque for one in found), '.3f')} N m, transmission errors "
        f"{each((1e6 * one.error for one in found), '.0f')} urad, pressures at nodes "
        f"{each((1e-9 * one.pressure for one in found), '.1f')} GPa: contact is narrower than the "
        "elements. The fine mesh's deflection is kept with the package, since it is dear: "
        "drive.density = 'fine' gives it.",
        {
            f"{what}_{name}_{unit}": scale * getattr(one, what)
            for what, unit, scale in (("torque", "Nm", 1.0), ("deflection", "urad", 1e6))
            for name, one in zip(MESHES, found, strict=False)
        }
        | {
            f"ratio_{name}_at_k_w_{RATIOS[at]:g}": float(own[at])
            for name, own in zip(MESHES, ratios, strict=True)
            for at in places
        }
        | {
            "most_apart_coarse_to_intermediate": float(first),
            "most_apart_intermediate_to_fine": float(second),
        },
        [*teeth, *(run for group in runs.values() for run in group)],
        verdict=NOT_TESTABLE,
        assumed=assumed(),
    )  # fmt: skip


@claim("7.3")
def _ratio() -> Finding:
    last = of_set(3)[-1]
    found = last.shaken()
    cycles = np.arange(1, found.cycle_torque.size + 1)
    so_far = np.cumsum(found.cycle_torque) / cycles / found.static
    wheel = np.cumsum(found.cycle_wheel) / cycles / LOAD
    thesis = SHAKEN / UNSHAKEN
    early = slice(2, _FIRST)
    single = found.cycle_torque / found.static
    passes = bool(so_far[early].min() <= thesis <= so_far[early].max())
    return Finding.judged(
        {
            "a mean of the first cycles can be that": passes,
        },
        f"{found.ratio:.2f} ({_state(found)}, wheel balanced to {abs(found.balance):.1%}); the "
        f"first three cycles {found.window:.2f}, the wheel's torque {1 + found.window_balance:.1f} "
        "times its load",
        "A reading of Figure 7.10, which is lost. By (143) it is the mean of one cycle, of which "
        "there is no one number here: means of "
        f"single cycles lie between {single[:_FIRST].min():.2f} and {single[:_FIRST].max():.2f} of "
        f"T_Bs among the first {_FIRST}, and between {single[-_FIRST:].min():.2f} and "
        f"{single[-_FIRST:].max():.2f} among the last that are kept, since the worm swings on its "
        "shaft over many cycles of the vibration. "
        f"{thesis:.2f} lies among them, so that nothing of the reading is refuted. In balance with "
        "the load it is none of ours, which claim 7.11 judges: the mean so far goes from "
        f"{so_far[early].max():.2f} to {so_far[early].min():.2f} within the first {_FIRST} cycles, "
        f"where the wheel has between {wheel[early].min():.2f} and {wheel[early].max():.2f} times "
        "the torque of its load. In balance with one flank bearing no ratio is below "
        f"{floor():.2f}. Contact is lost for {found.open:.0%} of the time, and forces reach "
        f"{1e-3 * found.force:.0f} kN.",
        {
            "ratio": found.ratio,
            "torque_balance": found.balance,
            "settled": float(found.settled),
            "ratio_first_cycles": found.window,
            "balance_first_cycles": found.window_balance,
            "least_mean_so_far": float(so_far[early].min()),
            "open_share": found.open,
            "greatest_force_kN": 1e-3 * found.force,
            "least_of_one_cycle": float(single.min()),
            "most_of_one_cycle": float(single.max()),
        },
        [last],
        verdict=NOT_TESTABLE,
        assumed=assumed(),
    )


@claim("7.7")
def _efficiency() -> Finding:
    runs = [run for run, k in zip(of_set(3, *ACTUATOR), RATIOS, strict=True) if k <= 5.0]
    found = [run.shaken() for run in runs]
    efficiency = system_efficiencies(found)
    shaken = [one.actuator for one in found]
    turn = 2.0 * math.pi * _TURNS
    # As the least torque, at high k_w, leaves most of it to the sonotrode and the greatest least.
    low = LOAD * turn / RATIO / 0.13 - UNSHAKEN * turn
    high = LOAD * turn / RATIO / 0.09 - SHAKEN * turn
    return Finding.judged(
        {
            "below that without vibration wherever friction falls": bool(
                np.all(efficiency[2:] < efficiency[0])
            ),
        },
        f"{efficiency.min():.1%} to {efficiency.max():.1%}",
        "An estimate from the measured power of a sonotrode, which is lost; the thesis itself "
        "leaves how far to the dynamics of the system, the actuator and tests. That the system's "
        "efficiency falls holds wherever friction does; how far depends on the mechanical power "
        "that our actuator gives in the ledger of each run: "
        + ", ".join(f"{1e-3 * p:.3g} kW at {k:g}" for k, p in zip(RATIOS, shaken, strict=False))
        + ". The thesis takes a hundred times what its sonotrode took; with its torques those "
        f"efficiencies are {1e-3 * low:.0f} to {1e-3 * high:.0f} kW. Its amplitude is the cause: "
        f"{1e3 * AMPLITUDE:g} mm hammers the teeth.",
        {f"efficiency_at_k_w_{k:g}": float(e) for k, e in zip(RATIOS, efficiency, strict=False)},
        runs,
        verdict=NOT_TESTABLE,
        assumed=f"The actuator at its resonance: {', '.join(ACTUATOR)}. {assumed()}",
    )


@claim("7.10")
def _slow() -> Finding:
    runs = {number: of_set(number) for number in (1, 2)}
    first, second = ([run.shaken() for run in runs[number]] for number in (1, 2))
    apart = [abs(a.ratio - b.ratio) for a, b in zip(first, second, strict=True)]
    worst = int(np.argmax(apart))
    amplitudes = [1e6 * conditions(number)[0].amplitude for number in (1, 2)]
    return Finding.judged(
        {"the two sets give one curve": max(apart) < _CLEAR},
        f"apart by up to {max(apart):.2f}, at k_w = {RATIOS[worst]:g}: {first[worst].ratio:.2f} "
        f"({_state(first[worst])}, balanced to {abs(first[worst].balance):.1%}) and "
        f"{second[worst].ratio:.2f} ({_state(second[worst])}, to "
        f"{abs(second[worst].balance):.1%})",
        "Figure 7.13 is lost, and what decides is ours or not told: inertia, damping, backlash, "
        "hob, and whether the step was static. In a static step, and wherever no tooth parts, "
        "friction goes by k_w alone, and the two would be one curve; in our march they are not: "
        f"at {FREQUENCY:g} Hz the two peak velocities are {amplitudes[0]:.1f} and "
        f"{amplitudes[1]:.1f} um: with the smaller the teeth "
        f"{_parted(first)}, with the larger they {_parted(second)}. "
        f"{sum(one.settled for one in (*first, *second))} of {len(first) + len(second)} runs are "
        "settled.",
        {
            "largest_difference": float(max(apart)),
            "ratio_set_1_at_20": first[-1].ratio,
            "ratio_set_2_at_20": second[-1].ratio,
            "settled_runs": float(sum(one.settled for one in (*first, *second))),
        },
        [*runs[1], *runs[2]],
        verdict=NOT_TESTABLE,
        assumed=f"The yardstick, {_CLEAR:g}. {assumed()}",
    )


@claim("7.15")
def _discs() -> Finding:
    runs = of_set(3)
    found = [run.shaken() for run in runs]
    ratio = np.array([one.ratio for one in found])
    k = np.array(RATIOS)
    across = np.asarray(transverse_ratio(k))
    apart = np.abs(ratio - across)
    near = k <= 3.0
    far = k[(apart > _APART)]
    return Finding.judged(
        {
            "near rigid friction up to k_w = 3": bool(np.all(apart[near] < _APART)),
        },
        f"near rigid friction up to k_w = {k[: int(np.argmax(apart > _APART))].max():g}, apart by "
        f"{apart[near].max():.2f} at most up to k_w = 3 and {apart[~near].max():.2f} beyond",
        "Both curves of the figure are lost, that of the gear and that of the disc tests. In their "
        "place stand our march and rigid friction under vibration across the sliding, apart by "
        f"more than {_APART:g} from k_w = {far.min():g} on: axial vibration of this worm is mostly "
        f"along the normal, and its flanks leave each other. {sum(one.settled for one in found)} "
        f"of {len(found)} runs are settled; the wheel is balanced to "
        f"{max(abs(one.balance) for one in found):.1%}.",
        {f"apart_at_k_w_{one:g}": float(d) for one, d in zip(k, apart, strict=True)},
        [*runs, "asperity.slider.closed_forms.transverse_ratio"],
        verdict=NOT_TESTABLE,
        assumed=assumed(),
    )


LOCKING = (
    "friction.model=dahl", "friction.exponent=0", "friction.mu=0.149",
    "friction.max_deflection=70 nm", "drive.load_inertia=3.2e-3 kg m**2",
    "drive.worm_inertia=1.3e-5 kg m**2", "drive.contact_damping=0.01 s/m",
    'drive.deflection=[["10 N m", "20 urad"], ["66 N m", "100 urad"], ["150 N m", "190 urad"]]',
    "drive.tangential_compliance=0.6 nm/N", "mount.backlash=0.15 mm",
    "vibration.mode=screw", "vibration.frequency=20 kHz",
)  # fmt: skip
"""Gearset 2 shaken as a screw; the deflection of its teeth is assumed, a third of gearset 3's."""


_CREEPING = 5.0  # um


@claim("7.17")
def _locking() -> Finding:
    from asperity.thesis.drive.marches import holding

    on_demand = Simulation(
        "gearset-2",
        (*LOCKING, "drive.protocol=on-demand", "vibration.velocity_ratio=1.5"),
    )
    creeping = Simulation(
        "gearset-2",
        (
            *LOCKING,
            "drive.protocol=back-drive",
            f"vibration.displacement_amplitude={_CREEPING:g} um",
        ),
    )
    other = Simulation(
        BASE,
        (
            "drive.protocol=on-demand", "friction.exponent=0", "vibration.mode=screw",
            "vibration.frequency=2 kHz", "vibration.velocity_ratio=1.5",
        ),
    )  # fmt: skip
    _, held = holding(on_demand.case, on_demand.settings)
    creep, _ = holding(creeping.case, creeping.settings)
    _, never = holding(other.case, other.settings)
    lead, angle = math.degrees(geometry().lead_angle), math.degrees(math.atan(FRICTION))
    backs = [GEARSET_2.number(standard, "eta_back") for standard in ("bs721", "agma6034")]
    steepest = math.degrees(math.atan(math.sqrt(1.0 - 2.0 * EFFICIENCY)))
    own = GEARSET_2.number("iso14521", "lead_angle_deg")
    return Finding.judged(
        {
            f"at {EFFICIENCY:.0%} a worm of gearset 2's lead locks itself, by (1)": own < steepest,
        },
        f"by (1), up to {steepest:.0f} deg of lead; marched, gearset 2 "
        f"{'holds' if held else 'does not hold'} after, and under vibration, "
        f"{_CREEPING:g} um, its wheel creeps back at {abs(creep or 0.0):.2g} rad/s",
        "Arithmetic: what is kept is the self-locking of a gearset that has it, and by (1) one of "
        f"the printed {EFFICIENCY:.0%} has, at any lead angle below {steepest:.0f} deg: once the "
        "vibration is off it comes to rest. The march adds what happens before: with the motor "
        "off and the vibration on such a gearset gives way, in steps that add up, so that the "
        "motor or a brake must hold it until the vibration has ended, which the thesis wants "
        "studied. "
        f"By ISO/TR 14521 gearset 2 locks in motion; by BS 721 and AGMA 6034, whose friction is "
        f"lower, the wheel would drive the worm at {backs[0]:.0%} and {backs[1]:.0%}. Gearset 3, "
        f"which the thesis shakes, has a lead angle of {lead:.0f} deg against a friction angle of "
        f"{angle:.0f} deg and none to keep, and {'holds' if never else 'does not hold'} after.",
        {"creep_under_vibration_rad_s": abs(creep or 0.0), "held_after": float(bool(held))},
        [on_demand, creeping, other],
        verdict=ARITHMETIC,
        assumed="For the march: shaken as a screw; inertias, damping, backlash and deflection of "
        "the teeth: " + ", ".join(LOCKING),
    )
