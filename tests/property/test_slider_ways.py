"""The ways to the answer of a sliding body against each other, on bodies by lot.

The march, the periodic state, the homogenised law and the lanes of a batch are held to one another,
and the march to the plain way of `apparatus.plain_body`, which shares nothing with the package but
the tables of a case. Two answers may be no further apart than 2e-3 of mu F_N, unless one of them
says so: not settled, a note on the state it found, or the error of its step.
"""

import re

import numpy as np
import pytest
from apparatus.bodies import lots
from apparatus.plain_body import body_of, once, solved, wave_of

from asperity.errors import AsperityError
from asperity.slider import batch, solve, solve_many

BAR = 2e-3
STEADY = 1e-3  # that halves of a window may differ by; cycles that repeat may make them differ more
MOST_DRAWN = 6
"""Times as many bodies are drawn as are to be compared, until so many have settled."""
LONG = 1500
"""Cycles after which a body has come to where it stays, but for those that say so."""


def within(difference, *answers, more=0.0):
    """Whether a difference is below the bar, or an answer told of one about as large."""
    told = sum(2.0 * (each.step_error or 0.0) for each in answers)
    return abs(difference) <= BAR + more + told


def answered(lot, folder, **settings):
    """Return the answer for a body by lot, or None where the package says that it has none."""
    try:
        return solve(lot.model(folder, **settings), history=False)
    except AsperityError:
        return None


def periods(lot, cycles):
    """Return the settings of a march over so many cycles from the start."""
    vibration = lot.tables["vibration"]
    frequency = float(vibration["frequency"].split()[0])
    start = float(vibration.get("start", "0 s").split()[0])
    return {"duration": f"{start + cycles / frequency!r} s"}


def sensitive(lot, model, window, ratio):
    """Whether the plain way goes elsewhere in other steps: the motion is a matter of luck."""
    p, wave = body_of(model), wave_of(model.vibration)
    found = [once(model, p, wave, steps, lot.cycles, window)[0] for steps in (1700, 3100, 5900)]
    return max(abs(np.array([*found, ratio]) - ratio)) > BAR


def elsewhere(lot, folder, answer, ratio):
    """Whether a march has two states to go to, and in finer steps goes where the plain way is.

    What half the step changes is no error of the step then.
    """
    marched = [
        answered(lot, folder, step=f"{answer.model.step / answer.model.finer / n!r} s")
        for n in (2, 4, 8, 16)
    ]
    if any(each is None for each in marched):
        return False
    off = [abs(each.ratio - ratio) for each in marched]
    here = abs(marched[0].ratio - answer.ratio)
    return here <= 0.1 * BAR and min(off) <= BAR


def march_against_plain_means(seed, count, folder, **options):
    """Return the bodies whose march and plain way are apart, and how many do not tell.

    A march that says that it has not settled is no prediction, wherever it is; most such marches
    are where the plain way is all the same.
    """
    apart, undecided = [], 0
    for n, lot in enumerate(lots(seed, count, folder, **options)):
        answer = answered(lot, folder)
        if answer is None:
            undecided += 1
            continue
        own = solved(answer.model, lot.cycles, answer.cycles)
        load = 1.0
        if answer.normal is not None:
            load = answer.normal.normal_mean / answer.model.slider.normal_force
        if within(answer.ratio - own.ratio, answer, more=own.error) and (
            abs(load - own.load) <= BAR * max(load, 1.0) + own.error
        ):
            continue
        if (
            not answer.settled
            or sensitive(lot, answer.model, answer.cycles, own.ratio)
            or elsewhere(lot, folder, answer, own.ratio)
        ):
            undecided += 1
            continue
        apart.append((n, answer.ratio, own.ratio, answer.step_error, load, own.load, lot.toml()))
    return apart, undecided


def test_a_few_bodies_march_as_by_plain_means(tmp_path):
    apart, undecided = march_against_plain_means(3, 6, tmp_path)
    assert not apart
    assert undecided == 0


@pytest.mark.slow
@pytest.mark.campaign(tried_by="test_a_few_bodies_march_as_by_plain_means")
@pytest.mark.parametrize("part", range(40))
def test_bodies_march_as_by_plain_means(tmp_path, part):
    apart, undecided = march_against_plain_means((1, part), 50, tmp_path)
    assert not apart
    assert undecided <= 3


def told_apart(periodic, marched):
    """Whether one of two answers says that it may not be where the other is.

    That friction can give energy says nothing of that.
    """
    notes = [each for each in periodic.notes if not re.match("friction (gave|can give) ", each)]
    return bool(notes) or not periodic.settled or not marched.settled


def states_against_marches(seed, count, folder, **options):
    """Return the bodies whose state and march are apart untold, and how many say so.

    Ductile asperities come to their state as 1/t: what four times the march brings nearer is on its
    way.
    """
    apart, said = [], 0
    for n, lot in enumerate(lots(seed, count, folder, **options)):
        periodic = answered(lot, folder, method="periodic")
        marched = answered(lot, folder, **periods(lot, LONG))
        if periodic is None or marched is None:
            said += 1
            continue
        off = periodic.ratio - marched.ratio
        if within(off, periodic, marched, more=min(marched.residual, STEADY)):
            continue
        if told_apart(periodic, marched):
            said += 1
            continue
        longer = answered(lot, folder, **periods(lot, 4 * LONG))
        if longer is not None and abs(periodic.ratio - longer.ratio) < 0.7 * abs(off):
            said += 1
        else:
            then = None if longer is None else longer.ratio
            apart.append((n, periodic.ratio, marched.ratio, then, lot.toml()))
    return apart, said


def test_a_few_bodies_march_into_their_periodic_states(tmp_path):
    apart, said = states_against_marches(3, 2, tmp_path, models=("dahl",), pressed=False)
    assert not apart
    assert said == 0


@pytest.mark.slow
@pytest.mark.campaign(tried_by="test_a_few_bodies_march_into_their_periodic_states")
@pytest.mark.parametrize("part", range(20))
def test_bodies_march_into_their_periodic_states(tmp_path, part):
    # At least 18 of 30 are compared.
    apart, said = states_against_marches((2, part), 30, tmp_path)
    assert not apart
    assert said <= 12


def without_duration(notes):
    """Return notes without the durations that would do, and these."""
    told = [re.search(r"a solve\.duration of (\S+) s would do", note) for note in notes]
    durations = [float(found[1]) for found in told if found]
    return [n for n, found in zip(notes, told, strict=True) if not found], durations


def check_lanes(drawn, folder, cycles):
    """Hold the lanes of a batch to marches one by one."""
    # As many steps for all, which lets them share a batch.
    for lot in drawn:
        lot.tables["vibration"].pop("start", None)
        lot.tables["solve"] = periods(lot, cycles)
    models = [lot.model(folder) for lot in drawn]
    for lot, model, together in zip(drawn, models, solve_many(models), strict=True):
        alone = answered(lot, folder)
        if alone is None:
            assert isinstance(together, AsperityError)
            continue
        assert together.ratio == pytest.approx(alone.ratio, abs=1e-7), lot.toml()
        assert together.settled == alone.settled
        (notes, durations), (others, other) = map(without_duration, (together.notes, alone.notes))
        assert notes == others
        # Foreseen from a march's end, it may be another by the last digits of where that is.
        assert np.log2(durations) == pytest.approx(np.log2(other), abs=1.0), lot.toml()
        assert model.full_friction == alone.static_drive_force


def shaken_otherwise(lot):
    """Return a body by lot shaken at four speeds: bodies of one law and as many steps."""
    vibration = lot.tables["vibration"]
    return [
        lot._replace(tables={
            **lot.tables,
            "vibration": {**vibration, "velocity_ratio": times * vibration["velocity_ratio"]},
        })
        for times in (0.5, 0.8, 1.0, 1.1)
    ]  # fmt: skip


@pytest.fixture
def shared(monkeypatch):
    """How many bodies each batch has that is marched."""
    sizes = []
    waves = batch.waves_of
    monkeypatch.setattr(batch, "waves_of", lambda own: [sizes.append(len(own)), waves(own)][1])
    return sizes


def test_a_few_lanes_and_single_marches_are_the_same(tmp_path, shared):
    (lot,) = lots(5, 1, tmp_path, models=("dahl",), pressed=False)
    lot.tables["friction"].pop("exponent", None)
    check_lanes(shaken_otherwise(lot), tmp_path, 12)
    assert shared == [4]


@pytest.mark.slow
@pytest.mark.campaign(tried_by="test_a_few_lanes_and_single_marches_are_the_same")
@pytest.mark.parametrize("part", range(12))
def test_lanes_and_single_marches_are_the_same(tmp_path, part, shared):
    drawn = lots((3, part), 6, tmp_path, models=("dahl", "dahl", "lugre"))
    for lot in drawn[:4]:
        # What a batch cannot have.
        lot.tables["friction"].pop("exponent", None)
        lot.tables["slider"].pop("drive_damping", None)
    check_lanes([each for lot in drawn for each in shaken_otherwise(lot)], tmp_path, 40)
    assert sum(shared) >= 4


def check_homogenised(seed, count, folder, **options):
    """Hold a homogenised law to the periodic state until so many were compared; return how many."""
    compared = 0
    for lot in lots(seed, MOST_DRAWN * count, folder, **options):
        if compared == count:
            break
        homogenised = answered(lot, folder, method="homogenised", **periods(lot, 1000))
        periodic = answered(lot, folder, method="periodic")
        if homogenised is None or periodic is None:
            continue
        if homogenised.settled and periodic.settled and not periodic.notes:
            off = homogenised.ratio - periodic.ratio
            assert within(off, homogenised, periodic, more=homogenised.residual), lot.toml()
            compared += 1
    return compared


@pytest.mark.parametrize("seed", [21, 24])
def test_a_few_homogenised_laws_end_in_the_periodic_state(tmp_path, seed):
    assert check_homogenised(seed, 1, tmp_path, models=("dahl",), pressed=False) == 1


@pytest.mark.slow
@pytest.mark.campaign(tried_by="test_a_few_homogenised_laws_end_in_the_periodic_state")
@pytest.mark.parametrize("part", range(20))
def test_the_homogenised_law_ends_in_the_periodic_state(tmp_path, part):
    options = {"models": ("dahl", "lugre"), "pressed": part % 3 == 0}
    assert check_homogenised((4, part), 2, tmp_path, **options) == 2


def nothing_and_little(seed, count, folder, method):
    """Yield each body with what no vibration makes of it, and a millionth of the velocity."""
    for lot in lots(seed, count, folder):
        settings = {"method": method}
        if method == "march":
            settings |= periods(lot, lot.cycles)
        step = lot.model(folder).step
        still = lot._replace(
            tables={**lot.tables, "vibration": {**lot.tables["vibration"], "velocity_ratio": 0.0}}
        )
        little = lot._replace(
            tables={**lot.tables, "vibration": {**lot.tables["vibration"], "velocity_ratio": 1e-6}}
        )
        settings["step"] = f"{step!r} s"
        yield lot, *(answered(each, folder, **settings) for each in (still, little))


def check_that_nothing_changes(seed, count, folder, method):
    checked = 0
    for lot, nothing, little in nothing_and_little(seed, count, folder, method):
        if nothing is None or little is None or not (nothing.settled and little.settled):
            continue
        checked += 1
        # What has settled in the mean only may be as far away as the halves of its window differ.
        # Springs are laid out to where the body comes, and are right to 1e-4.
        most = 2e-5
        if method == "homogenised":
            most = 5e-4  # it is a table of mean velocities
        most += 2.0 * (little.step_error or 0.0)
        most += 2.0 * (min(nothing.residual, STEADY) + min(little.residual, STEADY))
        ratios = nothing.ratio, little.ratio, nothing.notes, little.notes
        assert abs(little.ratio - nothing.ratio) <= most, (ratios, lot.toml())
    return checked


@pytest.mark.parametrize("method", ["march", "periodic"])
def test_a_vibration_of_nothing_changes_nothing_for_a_few_bodies(tmp_path, method):
    assert check_that_nothing_changes(12, 5, tmp_path, method) >= 3


@pytest.mark.slow
@pytest.mark.campaign(
    over="part", tried_by="test_a_vibration_of_nothing_changes_nothing_for_a_few_bodies"
)
@pytest.mark.parametrize("part", range(8))
@pytest.mark.parametrize("method", ["march", "periodic", "homogenised"])
def test_a_vibration_of_nothing_changes_nothing(tmp_path, method, part):
    # Many a march is too short to settle, and a homogenised law takes seconds.
    # Marches of light bodies under strong vibration seldom settle in the time they are given.
    count, least = {"march": (25, 2), "periodic": (25, 15), "homogenised": (6, 1)}[method]
    assert check_that_nothing_changes((7, part), count, tmp_path, method) >= least


def check_finer_steps(seed, count, folder, method, **options):
    """Hold an answer to that of a quarter of its step until so many were; return how many."""
    compared = 0
    for lot in lots(seed, MOST_DRAWN * count, folder, **options):
        if compared == count:
            break
        settings = {"method": method}
        if method == "march":
            # As long as most take to settle; in the lot's own time one in seven has.
            settings |= periods(lot, LONG)
        given = answered(lot, folder, **settings)
        if given is None:
            continue
        settings["step"] = f"{given.model.step / given.model.finer / 4.0!r} s"
        finer = answered(lot, folder, **settings)
        if finer is None or not (given.settled and finer.settled) or given.notes != finer.notes:
            continue
        most = 0.01 * max(abs(finer.ratio), 0.1)
        told = 2.0 * (given.step_error or 0.0)
        assert abs(given.ratio - finer.ratio) <= most + told, lot.toml()
        compared += 1
    return compared


def test_a_finer_step_changes_no_second_digit_of_a_few_bodies(tmp_path):
    assert check_finer_steps(8, 2, tmp_path, "periodic", pressed=False) == 2


@pytest.mark.slow
@pytest.mark.campaign(tried_by="test_a_finer_step_changes_no_second_digit_of_a_few_bodies")
@pytest.mark.parametrize("method", ["march", "periodic"])
@pytest.mark.parametrize("part", range(10))
def test_a_finer_step_changes_no_second_digit(tmp_path, method, part):
    count = {"march": 5, "periodic": 15}[method]
    assert check_finer_steps((8, part), count, tmp_path, method) == count
