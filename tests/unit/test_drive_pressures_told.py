"""What is told of resolved pressures: which peaks are not resolved, and none above its limit."""

import dataclasses
from types import SimpleNamespace

import numpy as np
import pytest
from apparatus.drives import problem

from asperity.drive.resolved.contact import ResolvedContact, _Teeth
from asperity.drive.resolved.pressures import CLOSE, Change
from asperity.drive.resolved.strip import FACE_END, FLANK, WHEEL_TIP, WORM_TIP, ZONES
from asperity.drive.static import notes
from asperity.drive.static.spread import STRIPS, told_k_h_beta
from asperity.flanks.parameters import Modification


def told(changes):
    record = SimpleNamespace(
        peaks=[np.full(len(ZONES), 1e8)] * 12, forces=[np.full(len(ZONES), 100.0)] * 12,
        changes=changes,
    )  # fmt: skip
    return [line for line in notes._pressures(problem(), record) if "not resolved" in line]


def test_a_peak_that_is_not_resolved_is_told_with_its_place_its_phase_and_by_how_much():
    changes = [
        (3, Change(0, WORM_TIP, 0.06)), (7, Change(1, WORM_TIP, 0.084)),
        (7, Change(0, WORM_TIP, 0.07)), (2, Change(0, FLANK, 0.11)),
    ]  # fmt: skip
    assert told(changes) == [
        "the peak on the flank is not resolved at 1 of 12 phases: the finest patches still changed "
        "it by up to 11 % (phase 3)",
        "the peak on the worm's tip edge is not resolved at 2 of 12 phases: the finest patches "
        "still changed it by up to 8.4 % (phase 8)",
    ]
    assert not told([])


def tooth(peaks, forces, number=0):
    return SimpleNamespace(
        number=number, normal=float(np.sum(forces)), peaks=lambda: np.array(peaks, float),
        forces=lambda: np.array(forces, float),
    )  # fmt: skip


def changes(before, after, cap=None, forces=(1e3, 100.0, 100.0, 100.0)):
    owner = SimpleNamespace(cap=cap)
    return list(ResolvedContact._changes(owner, tooth(before, forces), tooth(after, forces, 7)))


def test_only_peaks_of_the_flank_and_the_worm_s_tip_that_bear_and_do_not_flow_count():
    assert changes([100, 200, 300, 400], [100, 200, 900, 900]) == []
    found = changes([100, 200, 300, 400], [104, 250, 300, 400])
    assert [(each.tooth, each.zone) for each in found] == [(7, WORM_TIP)]
    assert found[0].share == pytest.approx(0.2)
    assert found[0].share > CLOSE
    # At the cap it stands; an edge that bears nothing to speak of has no peak to resolve.
    assert changes([100, 1000, 0, 0], [100, 1000, 0, 0], cap=1000.0) == []
    assert changes([100, 200, 0, 0], [100, 400, 0, 0], forces=(1e3, 0.5, 0.0, 0.0)) == []
    assert {WHEEL_TIP, FACE_END} == {ZONES.index("wheel_tip"), ZONES.index("face_end")}


def test_what_flows_bears_its_limit_and_not_a_digit_more():
    cap = 100.0 * 9.80665e6
    area = np.random.default_rng(1).uniform(1e-10, 1e-9, 2000)
    force = cap * area
    # The quotient alone stands above by its rounding.
    assert (force / area).max() > cap
    teeth = SimpleNamespace(contact=SimpleNamespace(cap=cap), numbers=(0,))
    (found,) = _Teeth.pressures(teeth, [SimpleNamespace(area=area)], SimpleNamespace(force=force))
    assert found.pressure.max() == cap
    assert found.pressure.min() > (1.0 - 1e-12) * cap


def test_a_force_in_one_strip_of_the_face_is_told_as_the_least_k_h_beta():
    (said,) = notes.narrow(float(STRIPS))
    assert said.startswith("K_Hbeta is 20 or more: all of the force lies within one of 20 strips")
    assert not list(notes.narrow(0.9 * STRIPS))
    assert [told_k_h_beta(20.0), told_k_h_beta(12.345)] == ["20 or more", "12.3"]


def test_a_flank_that_flows_in_large_parts_says_so():
    # An elastic ellipse bears 2/3 of its largest pressure in the mean.
    assert not notes.flowing(0.66 * 981.0, 981.0)
    assert not notes.flowing(861.0, None)
    (said,) = notes.flowing(861.0, 981.0)
    assert said.startswith("large parts of the flank flow: ")
    assert "861 MPa, 88 % of the hardness" in said


def test_what_root_relief_leaves_of_the_wheel_s_edge_is_no_reason_to_give_it():
    record = SimpleNamespace(
        peaks=[np.full(len(ZONES), 1e8)] * 12, forces=[np.full(len(ZONES), 100.0)] * 12, changes=[]
    )

    def of(drive):
        (line,) = (e for e in notes._pressures(drive, record) if "the wheel's tip edge" in e)
        return line

    sharp = problem()
    assert "modification.root_relief relieves it" in of(sharp)
    relief = Modification(root_relief="80 um")
    assert "modification.root_relief leaves this" in of(
        dataclasses.replace(sharp, modification=relief)
    )
