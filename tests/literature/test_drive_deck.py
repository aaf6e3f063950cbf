"""The deck of loaded teeth run by CalculiX, against the package's own contact of one tooth.

G. Dhondt, K. Wittig: CalculiX, a free software three-dimensional structural finite element program.
"""

import re
import shutil
import subprocess

import numpy as np
import pytest
from apparatus.drives import case

from asperity.contact.candidates.records import Answer, Candidates
from asperity.drive.deck import TeethSetup, abaqus_files, calculix_files
from asperity.drive.deck.calculix import torques
from asperity.drive.deck.setup import SLID, WORM, turned_about
from asperity.drive.teeth.sector import RIM
from asperity.flanks.worm.distance import distances

FLOAT = r"[-+]?\d\.\d+E[-+]\d+"
LOAD = 60.0  # N m, of a tooth alone

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def setup():
    """A tooth cut out of the wheel, alone in the worm: small enough to solve in half a minute."""
    made = TeethSetup.from_case(
        case("drive.teeth=1", f"operation.output_torque={LOAD} N m", "friction.model=coulomb")
    )
    contact = made.model.contact
    body = contact.sector.body
    contact.slots = 1
    contact.candidates, contact.answer = Candidates.workspace(body, 1), Answer.workspace(body, 1)
    return made


def test_the_worm_s_surface_is_on_the_exact_flank_and_its_layer_behind_it(setup):
    own = turned_about(setup.worm.points, setup.axis, setup.origin, SLID)
    place = setup.pair.mounting.to_helicoid(1e3 * own)
    faces = setup.worm.face_nodes(WORM)[:, :4]
    assert np.abs(distances(place[np.unique(faces)], setup.pair.worm, 1)).max() < 1e-6
    assert setup.worm.scaled_jacobian().min() > 0.5


def test_the_flanks_begin_apart_and_the_package_s_balance_carries_the_load(setup):
    before, loaded, end = setup.wheel_angles
    assert before > setup.touching - SLID / 15.0
    assert loaded < before
    assert end - loaded == pytest.approx(SLID / 15.0)
    assert setup.balance.action.wrench[5] == pytest.approx(LOAD, rel=1e-6)


def test_abaqus_is_told_of_the_same_motion_and_of_dahl_s_law_by_a_subroutine(setup):
    (name, text), *none = abaqus_files(setup).items()
    assert (name, none) == ("teeth.inp", [])
    assert "*RIGID BODY, ELSET=worm, REF NODE=worm_centre" in text
    assert re.search(r"\*FRICTION\n0\.1344,", text)
    turns = re.findall(r"^worm_centre, ([456]), \1, (\S+?),?$", text, re.MULTILINE)
    last = np.array([float(amount) for _, amount in turns[-3:]])
    assert last == pytest.approx(SLID * setup.axis)
    dahl = TeethSetup.from_case(case("drive.teeth=1", f"operation.output_torque={LOAD} N m"))
    files = abaqus_files(dahl)
    assert set(files) == {"teeth.inp", "user.f"}
    assert "*FRICTION, USER, DEPVAR=3" in files["teeth.inp"]
    assert "law 'vector'" in files["user.f"]


def test_the_rim_is_held_where_the_package_holds_it(setup):
    rim = setup.wheel.points[setup.wheel.node_set(RIM)]
    radius = np.hypot(rim[:, 0], rim[:, 1])
    assert np.ptp(radius) < 1e-9


@pytest.mark.skipif(shutil.which("ccx") is None, reason="CalculiX is not installed")
def test_calculix_finds_the_torque_ratio_of_the_package_to_half_a_percent(setup, tmp_path):
    for name, text in calculix_files(setup).items():
        (tmp_path / name).write_text(text)
    done = subprocess.run(
        ["ccx", "teeth"], cwd=tmp_path, capture_output=True, text=True, check=False, timeout=900
    )
    assert "Job finished" in done.stdout, done.stdout[-2000:]
    sums = re.findall(
        r"moment about the origin \(mx,my,mz\)\s+" + r"\s+".join([f"({FLOAT})"] * 6),
        (tmp_path / "teeth.dat").read_text(),
    )
    last = np.array(sums[-1], float)
    wheel, worm = torques(setup, last[:3], last[3:])
    end = setup.balance
    # Faces between nodes stand a little proud of the exact flank.
    assert wheel == pytest.approx(LOAD, rel=0.3)
    assert wheel / worm == pytest.approx(LOAD / end.worm_torque, rel=5e-3)
    # Before it slides friction is not yet that of sliding.
    first = np.array(sums[3], float)
    assert torques(setup, first[:3], first[3:])[1] < 0.8 * worm
