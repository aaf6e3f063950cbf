"""Elastic blocks on the curves of the sliding body, and the ways they are read."""

import functools
from types import SimpleNamespace

import numpy as np
import pytest

from asperity.block.problem import BlockProblem
from asperity.block.solution import settled as settling
from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.thesis.contact import blocks, elastic, pressed
from asperity.thesis.contact import claims as claims_contact
from asperity.thesis.contact.blocks import Settled
from asperity.thesis.contact.elastic import LIGHT, BlockFromRest, ElasticBlock, from_rest
from asperity.thesis.contents import CLAIMS, FIGURES

K_2 = "vibration.velocity_ratio=2"
STIFF = "block.youngs_modulus=20900 GPa"


@functools.cache
def problem(*settings):
    return BlockProblem.from_case(
        read_case("block-longitudinal", case_tables(), (*LIGHT, *settings))
    )


@functools.cache
def settle(case, *settings):
    return blocks.settle(case, (*LIGHT, *settings))


def compliance(*settings):
    return np.diag(problem(*settings).compliance.static)


@pytest.mark.slow
def test_a_block_that_does_not_give_is_the_sliding_body():
    stiff = settle("block-longitudinal", STIFF, K_2)
    assert stiff.ratio == pytest.approx(stiff.slider, rel=5e-4)
    assert stiff.in_series == pytest.approx(stiff.slider, rel=5e-4)


@pytest.mark.slow
def test_what_separates_block_and_sliding_body_is_the_blocks_compliance():
    for found in (
        settle("block-longitudinal", K_2),
        settle("block-transverse", "vibration.velocity_ratio=3"),
    ):
        assert found.ratio == pytest.approx(found.in_series, rel=1e-3)
        assert abs(found.ratio - found.in_series) < 0.2 * abs(found.ratio - found.slider)


@pytest.mark.slow
def test_a_block_settles_to_the_same_wherever_its_start_leaves_it():
    block = settle("block-transverse", K_2)
    assert abs(block.late) > 1e-3
    assert block.unsteadiness < 0.5 * settling.STEADY * block.slider


@pytest.mark.slow
def test_a_block_is_read_anew_in_longer_windows_until_they_agree(monkeypatch):
    found = settle("block-transverse", K_2)
    assert found.cycles == 16
    monkeypatch.setattr(settling, "STEADY", found.unsteadiness / found.slider)
    monkeypatch.setattr(settling, "_LONGEST", 8)
    longer = blocks.settle("block-transverse", (*LIGHT, K_2))
    assert longer.cycles == 32
    assert longer.ratio == pytest.approx(found.ratio, rel=1e-3)


@pytest.mark.slow
@pytest.mark.campaign(tried_by="test_a_block_is_read_anew_in_longer_windows_until_they_agree")
def test_a_rocking_block_read_for_twice_as_long_comes_to_the_same(monkeypatch):
    settings = (*LIGHT, "vibration.velocity_ratio=20")
    found = blocks.settle("block-longitudinal", settings)
    assert found.cycles == 32
    monkeypatch.setattr(settling, "STEADY", 0.0)
    monkeypatch.setattr(settling, "_LONGEST", 16)
    further = blocks.settle("block-longitudinal", settings)
    assert further.cycles == 64
    assert further.unsteadiness < found.unsteadiness
    assert further.ratio == pytest.approx(found.ratio, abs=found.unsteadiness)


def test_the_bases_compliance_goes_with_that_of_the_material():
    soft, stiff = compliance(), compliance(STIFF)
    assert soft / stiff == pytest.approx([100.0, 100.0], rel=1e-6)


def test_pressure_on_the_base_makes_it_give_more_than_its_shear_alone():
    whole = compliance()
    body, surface = problem().body, problem().surface
    spread = np.zeros((len(surface.nodes), 3))
    spread[:, 0] = surface.nodal_area / surface.area
    shear = spread.ravel() @ body.flexibility @ spread.ravel()
    # Shear of a prism that friction on its lower face pushes on and turns, and whose inertia
    # resists both: 1 - z - r z (1 - z) of it is left at the height z of 1; and some bending.
    length, width, height = problem().block.size
    r = 3.0 * height**2 / (height**2 + length**2)
    share = 1.0 / 3.0 - r / 6.0 + r**2 / 30.0
    assert 1.0 < shear / (share * height / (209e9 / 2.6 * length * width)) < 1.3
    assert 1.5 < whole[0] / shear < 3.0


@pytest.mark.parametrize(("share", "verdict"), [(0.01, "reproduced"), (0.03, "differs")])
def test_claims_of_equal_ratios_are_judged_by_the_ratio_too(monkeypatch, share, verdict):
    """At k = 20 the ratio is a thirtieth: 3 % of it are a thousandth of mu F_N."""

    def settled(block):
        ratio = (1.0 + share) / 30.0 if elastic.ON_BODY in block.settings else 1.0 / 30.0
        return Settled(ratio, 1.0 / 30.0 / (1.0 + share), ratio, ratio, 0.0, 16, 0.0)

    slid = SimpleNamespace(ratio=0.15)
    monkeypatch.setattr(BlockFromRest, "marched", lambda one: slid)
    monkeypatch.setattr(ElasticBlock, "settled", settled)
    monkeypatch.setattr(claims_contact.Body, "result", slid)
    monkeypatch.setattr(claims_contact.Sweep, "ratios", lambda one: np.full(8, 1.0 / 30.0))
    finding = CLAIMS["5.1"].make()
    assert finding.verdict == verdict
    assert f"({share:.1%})" in finding.ours
    # One trend on an axis from 0 to 1 is what this one is about.
    shaken = CLAIMS["7.8"].make()
    assert shaken.verdict == "reproduced"
    assert f"({share:.1%})" in shaken.ours


def test_touched_at_its_nodes_a_cylinder_sinks_between_them():
    over, between = (pressed.press("nodes", shift).approach for shift in (0.0, 0.5))
    element = pressed.SIZE[0] / pressed.ELEMENTS[0]
    assert between - over == pytest.approx(element**2 / (8.0 * pressed.RADIUS), rel=0.02)
    over, integrated = (pressed.press("surface", shift).approach for shift in (0.0, 0.5))
    assert 0.0 < integrated - over < 0.5 * element**2 / (8.0 * pressed.RADIUS)


def test_a_surface_touched_at_its_nodes_keeps_its_area():
    _, surface = pressed._body()
    nodal = pressed.at_nodes(surface)
    assert nodal.area == pytest.approx(surface.area)
    assert np.allclose(nodal.points, nodal.positions[nodal.faces])


@pytest.mark.slow
def test_a_figure_holds_block_and_sliding_body_at_the_same_points(monkeypatch):
    monkeypatch.setitem(elastic.RATIOS, "block-longitudinal", (2.0,))
    drawn = FIGURES["7.9"].make()
    assert list(drawn.dataset["shaken"].values) == ["base", "body"]
    assert drawn.dataset["slider"].values == pytest.approx(
        drawn.dataset["periodic"].sel(k=[2.0]).values, rel=1e-9
    )
    assert any(line.startswith("asperity sweep table-4.3") for line in drawn.how)
    assert len(drawn.figure.axes) == 2


def test_figures_of_blocks_have_more_to_show_in_full():
    with_more = {number for number, figure in FIGURES.items() if figure.has_full}
    assert with_more == {"5.5", "5.6", "5.7", "5.8", "5.9", "5.10", "5.11", "7.8", "7.9"}
    for number in with_more:
        light, full = ({part.task.name for part in FIGURES[number].parts(f)} for f in (False, True))
        assert light
        assert not light & full


def test_a_block_is_settled_once_for_all_runs(tmp_path, monkeypatch):
    monkeypatch.setenv("ASPERITY_CACHE", str(tmp_path))
    solved = []

    def settled(case, settings):
        solved.append(settings)
        return Settled(0.5, 0.5, 0.5, 0.5, 0.0, 16, 0.0)

    monkeypatch.setattr(blocks, "settle", settled)
    block, other = (ElasticBlock("block-longitudinal", (*LIGHT, k)) for k in (K_2, f"{K_2}.5"))
    assert block.settled() == block.settled() == other.settled()
    assert len(solved) == 2


def test_what_is_shown_of_a_march_is_kept_as_it_was(tmp_path, monkeypatch):
    monkeypatch.setenv("ASPERITY_CACHE", str(tmp_path))
    time = np.linspace(0.0, 1.0, 5)
    history = SimpleNamespace(
        time=time, drive_force=2.0 * time, friction=np.stack([time, -time], axis=1)
    )
    results = [SimpleNamespace(ratio=0.25, history=history)]
    monkeypatch.setattr(blocks, "march", lambda case, settings: results.pop())
    (block,) = from_rest("block-longitudinal")
    now, again = block.marched(), block.marched()
    for name in ("ratio", "time", "drive_force", "friction"):
        assert np.array_equal(getattr(now, name), getattr(again, name))
    assert again.to_dataset()["friction"].sel(axis="y").values[-1] == -1.0
