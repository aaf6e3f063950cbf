"""Every example runs as it stands and comes to its number."""

import runpy
from pathlib import Path

import matplotlib
import pytest

EXAMPLES = Path(__file__).parents[2] / "examples"


@pytest.fixture
def example():
    with matplotlib.rc_context({"backend": "agg"}):
        from matplotlib import pyplot

        pyplot.switch_backend("agg")
        yield lambda name: runpy.run_path(str(EXAMPLES / f"{name}.py"))
        pyplot.close("all")


def test_every_example_is_tested():
    names = {path.stem for path in EXAMPLES.glob("*.py")}
    assert names == {
        "a_first_slide",
        "an_elastic_block",
        "every_direction",
        "flanks_of_a_worm_gearset",
        "friction_law_across_the_drive",
        "which_friction_reduction_helps",
    }


def test_a_first_slide(example):
    assert example("a_first_slide")["ratio"] == pytest.approx(0.13700, rel=1e-3)


@pytest.mark.slow
def test_every_direction(example):
    names = example("every_direction")
    assert names["ratios"][2, 12] == pytest.approx(0.40459, rel=1e-3)
    assert names["best"].tolist() == [90.0, 0.0, 0.0, 0.0]


@pytest.mark.slow
def test_friction_law_across_the_drive(example):
    names = example("friction_law_across_the_drive")
    assert names["across"]["split"][23] == pytest.approx(0.40459, rel=1e-3)
    assert names["spread_along"] < 1e-6
    assert names["spread_across"] == pytest.approx(0.357, abs=5e-3)


@pytest.mark.slow
def test_which_friction_reduction_helps(example):
    names = example("which_friction_reduction_helps")
    assert names["efficiency"]["longitudinal"][20] == pytest.approx(0.62281, rel=1e-4)
    assert names["best"] == pytest.approx(0.37920, rel=1e-4)


@pytest.mark.slow
def test_flanks_of_a_worm_gearset(example):
    names = example("flanks_of_a_worm_gearset")
    assert names["centres"] == pytest.approx([4.8, 1.66], abs=0.1)
    assert names["errors"]["ZI"] < 1e-12
    assert names["errors"]["ZA"] == pytest.approx(2.58e-4, rel=0.02)
    assert names["room"] == pytest.approx(0.0295, abs=1e-3)


@pytest.mark.slow
def test_an_elastic_block(example):
    names = example("an_elastic_block")
    assert names["block"].ratio == pytest.approx(names["body"].ratio, rel=0.02)
    assert names["block"].ledger.residual < 1e-4
    assert names["block"].unconverged == 0
    # A rigid block pulled at half its height: moments of drive and pressure about its middle.
    front, slider = names["front"], names["problem"].model.slider
    length, _, height = names["problem"].block.size
    lean = 1.5 * names["block"].drive_force / slider.normal_force * height / length
    ratio = names["pressure"][front].mean() / names["pressure"][~front].mean()
    assert ratio == pytest.approx((1.0 + lean) / (1.0 - lean), abs=0.01)
