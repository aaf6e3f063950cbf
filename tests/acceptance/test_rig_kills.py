"""Killed at any moment, procedure and guardian lose nothing and leave nothing unreadable."""

import contextlib
import os
import random
import signal

import pytest
from apparatus import rigs
from apparatus.forked_guardian import Dials
from apparatus.fuse import Fuse
from apparatus.standing_rig import Procedure, StandingRig

from asperity.files.leftovers import remove_leftovers
from asperity.tribometer.guardian import switching
from asperity.tribometer.recording import Recording

pytestmark = [
    pytest.mark.filterwarnings("ignore::DeprecationWarning"),
    pytest.mark.skipif(os.name != "posix", reason="processes are forked"),
]

OUTPUTS = {"vibration", "amplifier", "steel", "bronze"}
PARTS, KILLS = 30, 10
LONG = 60.0


@pytest.fixture(scope="module")
def case():
    times = 'plan.before="0.5 s"', 'plan.shaken="0.5 s"', 'plan.idle="0.2 s"'
    patient = f'guardian.patience="{LONG} s"', f'guardian.deadline="{LONG} s"'
    return rigs.small_case(*times, *patient)


@pytest.fixture(scope="module")
def rig(case):
    made = StandingRig(case)
    yield made
    made.close()


@pytest.fixture(scope="module")
def dials():
    return Dials(patience=LONG, deadline=LONG, limit=switching._LIMIT, opening=20.0)


@pytest.fixture(scope="module")
def undisturbed(case, rig, dials, tmp_path_factory):
    """Cells of a run that nobody kills, and what it does to files in each of its processes."""
    counts = Dials(procedure=0, guardian=0)

    def counted(name):
        Fuse(random.Random(0), 1, 1.0).light(
            count=lambda: counts.turn(**{name: getattr(counts, name) + 1})
        )

    rig.left(True)
    folder = tmp_path_factory.mktemp("undisturbed")
    run = Procedure(
        case, folder, rig, dials=dials, before=lambda: counted("procedure"),
        begins=lambda _: counted("guardian"),
    )  # fmt: skip
    assert run.ended() == 0, run.said
    run.gone()
    calls = {name: int(getattr(counts, name)) for name in ("procedure", "guardian")}
    assert min(calls.values()) > 10
    return rigs.cells(folder), calls


class Killed:
    """A plan in whose runs somebody is killed, until it comes to its end."""

    def __init__(self, case, rig, dials, folder, rng, calls):
        self._case, self._rig, self._dials = case, rig, dials
        self._folder, self._rng, self._calls = folder, rng, calls
        self._cells = []

    def once(self):
        """Go on with it; returns whom it killed, "" if it came to its end."""
        who = self._rng.choice(["procedure", "guardian", "both"])
        armed = "guardian" if who == "guardian" else "procedure"
        fuse = Fuse(self._rng, self._calls[armed], 0.35 if armed == "procedure" else 0.15)
        noted = self._folder / "guardian"

        def with_it():
            if who == "both" and noted.exists():
                # At the very end it has gone by itself.
                with contextlib.suppress(ProcessLookupError):
                    os.kill(int(noted.read_text()), signal.SIGKILL)

        kinds = [line["kind"] for line in rigs.whole_lines(self._folder)]
        self._rig.left("done" not in kinds)
        latched = "latched" in kinds[_last(kinds, "acknowledged") + 1 :]
        errors = self._folder / "errors"
        said = len(errors.read_text()) if errors.exists() else 0
        run = Procedure(
            self._case, self._folder, self._rig, dials=self._dials, resume="started" in kinds,
            acknowledge="looked at" if latched else "",
            before=(lambda: fuse.light(with_it)) if armed == "procedure" else None,
            begins=lambda n: fuse.light() if armed == "guardian" and n == 0 else fuse.put_out(),
        )  # fmt: skip
        code = run.ended()
        run.gone()
        told = f"{who} at {fuse.says} after {len(kinds)} lines: {code}, {run.said[said:]}"
        # Nobody is there who switches off, and that is said, where the first guardian is killed
        # before it has.
        ended = code == 4 and "has ended as it began; NOT READ BACK" in told
        assert ended or code in (0, 3, -signal.SIGKILL, -signal.SIGPROF), told
        if who != "both" and not ended:
            assert not OUTPUTS & set(self._rig.on()), told
        self._nothing_is_lost(told)
        return who if code else ""

    def _nothing_is_lost(self, told):
        lines = rigs.whole_lines(self._folder)
        assert [line["line"] for line in lines] == list(range(1, len(lines) + 1)), told
        cells = rigs.cells_of(lines)
        assert cells[: len(self._cells)] == self._cells, told
        self._cells = cells

    def ended(self, wanted):
        """See that all of it is there."""
        assert self._cells == wanted
        for line in rigs.journal(self._folder):
            if line["kind"] == "done" and "cell" in line:
                assert (self._folder / line["recording"]).is_file()
        assert not list(self._folder.glob(".*.blocks"))
        # As every command does that writes into a folder.
        remove_leftovers(self._folder)
        for path in self._folder.glob("*.nc"):
            # Opened, its check sums are compared; what does not agree is a gap.
            assert not Recording.open(path).gaps


def _last(kinds, kind):
    return len(kinds) - 1 - kinds[::-1].index(kind) if kind in kinds else -1


@pytest.mark.slow
@pytest.mark.campaign(over="part")
@pytest.mark.parametrize("part", range(PARTS))
def test_three_hundred_kills_lose_nothing_and_leave_nothing_unreadable(
    case, rig, dials, undisturbed, tmp_path, part
):
    wanted, calls = undisturbed
    rng = random.Random(part)
    kills = runs = 0
    while kills < KILLS:
        plan = Killed(case, rig, dials, tmp_path / f"run-{runs}", rng, calls)
        while plan.once():
            kills += 1
        plan.ended(wanted)
        runs += 1
