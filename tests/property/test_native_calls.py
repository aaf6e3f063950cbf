"""What a library's machine code answers is what Numba's answers, bit for bit."""

import contextlib
import json
import time

import numpy as np
import pytest
from apparatus import rigs
from apparatus.called import copied, moved, recorded, words
from observe import observe

from asperity.kernels.native.entries import listed
from asperity.kernels.native.types import UnlistedTypeError, types_of

# So many calls of an entry, or as many as take a minute.
CALLS, LEAST, MOST = 1000, 20, 60.0
# Its rig is simulated by a process of its own; here it is by this one.
RIG = "rig run rig-final RIG --out OUT"
# Command lines, in the way of `answers/commands.toml`, that call all entries of the list among
# them but those below. A march of many steps proves no more of each than one of some.
# The first is the cheapest.
LINES = (
    "rig reduce RECORDING --set reduction.speed_settling='0.3 s'",
    "slide table-4.3 EARLY --out OUT",
    "slide table-4.3 --set solve.method=periodic --out OUT",
    "slide table-4.4 LUGRE --set solve.method=periodic",
    "slide table-4.3 EARLY --set vibration.waveform=triangle",
    "slide table-4.3 EARLY --set solve.scheme=two-phase",
    "slide table-4.1-L4 --set solve.method=homogenised",
    "slide table-4.4 --set solve.method=homogenised",
    "static table-4.3",
    "static normal-pin",
    "slide normal-pin",
    "slide normal-pin --set vibration.waveform=triangle --set friction.model=coulomb",
    "slide normal-pin EARLY --set solve.method=march",
    "slide normal-pin --set solve.method=march --set vibration.velocity_ratio=20 --set "
    "vibration.start='0.14 s' --set solve.duration='0.6 s'",
    "slide normal-pin --set solve.duration='40 ms' --set vibration.start='10 ms' --out OUT",
    "slide normal-machine --set solve.method=periodic",
    "sweep normal-pin --over vibration.velocity_ratio=1,6 EARLY --set solve.method=march",
    "sweep table-4.3 --over vibration.velocity_ratio=1,6 EARLY",
    "flank gearset-3b --density coarse",
    "flank gearset-3b --density coarse --set gearset.flank=ZK",
    "flank gearset-3b --density coarse --set mount.centre_distance_error='0.05 mm' --set "
    "mount.shaft_angle_error='0.1 deg' --set mount.backlash='0.1 mm'",
    "drive drive-thesis",
    "drive drive-screw TEETH LUGRE --set friction.stribeck_velocity='0.1 m/s' --set "
    "drive.protocol=window",
    "drive drive-screw --static --set drive.teeth=1 --set drive.phases=1",
    "block block-longitudinal BLOCK --set contact.normal=two-stage",
    "block block-longitudinal BLOCK --out OUT",
    "rig plan rig-final --out OUT",
    RIG,
    "drive drive-screw --set drive.model=teeth --set drive.teeth=1 --set drive.window=1 "
    "--set drive.protocol=window --set vibration.frequency='20 kHz'",
)
# Called where it is kept, as here; listed of many states alone: of few Python does it.
KEPT = {
    "slide table-4.3 --set solve.method=periodic --out OUT": "asperity.slider.on_twice.at_state"
}
# Entries that none of these calls here, with the reason why.
LEFT_OUT = {
    95: "friction on twice the step, where no state repeats itself on that: exhibits of the thesis "
    "alone meet one; that of a pressed body is compared",
}


def owned():
    """The entries of each line, but for those of a line before it."""
    seen, lines = set(), {}
    for line in LINES:
        lines[line] = set(listed().lines[line]) - seen - LEFT_OUT.keys()
        if line in KEPT:
            lines[line].add(listed().named(KEPT[line])[0].number)
        seen |= lines[line]
    return lines


def test_every_entry_of_the_list_is_compared_or_left_out_with_a_reason():
    compared = set().union(*owned().values())
    assert {entry.number for entry in listed().entries} - compared == LEFT_OUT.keys()
    assert all(owned().values())


def entry_of():
    """Return what tells the number of the entry that a call is of, or None."""
    numbers = {(each.name, json.dumps(each.arguments)): each.number for each in listed().entries}

    def number(kernel, arguments):
        with contextlib.suppress(UnlistedTypeError):
            types = json.dumps(types_of(arguments))
            return numbers.get((f"{kernel.__module__}.{kernel.__qualname__}", types))
        return None

    return number


@pytest.mark.slow
@pytest.mark.campaign
@pytest.mark.parametrize("line", LINES)
def test_a_thousand_calls_of_an_entry_answer_as_numba_does(line, monkeypatch, tmp_path):
    monkeypatch.delenv("ASPERITY_NATIVE", raising=False)
    monkeypatch.chdir(tmp_path)
    with recorded(of=entry_of()) as calls:
        if line == RIG:
            rigs.run(rigs.small_case(), tmp_path / "rig")
        else:
            observe(line, tmp_path)
    own = owned()[line]
    assert own <= calls.keys()
    for number in sorted(own):
        answered, tried = same_answers(calls[number])
        assert answered == tried, listed().entries[number].name


def same_answers(starts):
    """Compare calls near those recorded; return how many the library answered of how many."""
    rng = np.random.default_rng(1)
    answered, began = 0, None
    for number in range(CALLS):
        if number >= LEAST and time.process_time() - began > MOST:
            return answered, number
        kernel, arguments = starts[number % len(starts)]
        here = moved(arguments, rng)
        there = copied(here)
        answer = kernel._native(here)
        if answer is NotImplemented:
            return answered, number + 1
        answered += 1
        expected = kernel._dispatcher(*there)
        # What is compiled is.
        began = began or time.process_time()
        assert words(answer) == words(expected), kernel.__qualname__
        # Also what was filled.
        assert words(here) == words(there), kernel.__qualname__
    return answered, CALLS
