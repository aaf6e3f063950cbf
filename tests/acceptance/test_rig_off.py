"""Off means off: whatever ends a run, everything was read back to be off, or is named."""

import os
import signal

import pytest
from apparatus import rigs
from apparatus.standing_rig import Procedure, StandingRig, lines_of, waited_for

pytestmark = [
    pytest.mark.filterwarnings("ignore::DeprecationWarning"),
    pytest.mark.skipif(os.name != "posix", reason="signals are those of POSIX"),
]

OUTPUTS = {"vibration", "amplifier", "steel", "bronze"}
# What a busy machine does not stretch beyond.
SETTINGS = 'guardian.patience="2 s"', 'guardian.deadline="3 s"', 'plan.shaken="2 s"'


@pytest.fixture(scope="module")
def case():
    return rigs.small_case(*SETTINGS)


@pytest.fixture(scope="module")
def standing(case):
    rig = StandingRig(case)
    yield rig
    rig.close()


@pytest.fixture
def rig(standing):
    standing.sound()
    standing.pace(1.0)
    yield standing
    standing.sound()


@pytest.fixture
def begun(case, rig, tmp_path):
    """Begin procedures, none of which is left behind."""
    made = []

    def begin(**options):
        made.append(Procedure(case, tmp_path / "run", rig, **options))
        return made[-1]

    yield begin
    for one in made:
        one.end()


def vibrating(rig):
    return waited_for(lambda: "vibration" in rig.on())


def all_off(rig):
    return waited_for(lambda: not OUTPUTS & set(rig.on()))


def gone_on_with(begun, rig, folder, **options):
    """Go on with a run to its end; nothing that was recorded is lost."""
    before = rigs.cells(folder)
    rig.sound()
    rig.pace(0.0)
    again = begun(resume=True, **options)
    assert again.ended() == 0, again.said
    assert rigs.cells(folder)[: len(before)] == before
    assert len(rigs.cells(folder)) == 2
    assert not OUTPUTS & set(rig.on())


def test_a_procedure_that_is_killed_leaves_everything_off(begun, rig, tmp_path):
    procedure = begun()
    vibrating(rig)
    procedure.kill(signal.SIGKILL)
    assert procedure.ended() == -signal.SIGKILL
    all_off(rig)
    waited_for(lambda: lines_of(tmp_path / "run", "interrupted"))
    found = lines_of(tmp_path / "run", "off")[-1]
    assert found["why"] == "the procedure has ended without a word"
    assert len(found["read_back"]) == 4
    assert "its state is off, its signal is still" in found["read_back"].values()
    assert "still_on" not in found
    waited_for(lambda: "read back to be off within" in procedure.said)
    gone_on_with(begun, rig, tmp_path / "run")
