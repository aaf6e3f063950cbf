import numpy as np
import pytest

from asperity.friction.two_phase import phases
from asperity.thesis.contents import FIGURES
from asperity.thesis.sliding.schemes import increment

pytestmark = pytest.mark.usefixtures("plain_kernels")


def test_every_figure_asked_for_is_there():
    assert list(FIGURES) == [
        "2.7", "2.9", "2.10", "2.11", "2.12", "2.13", "2.14", "2.15", "2.16", "3.1", "3.2", "3.3",
        "3.4", "3.5", "4.3", "4.4", "4.9", "4.10", "4.11", "4.13", "4.14", "4.15", "4.17",
        "4.18", "4.19", "4.20", "4.21", "4.22", "4.23", "5.2", "5.3",
        "5.5", "5.6", "5.7", "5.8", "5.9", "5.10", "5.11", "6.8", "6.9", "6.24",
        "7.1", "7.2", "7.3", "7.4", "7.5", "7.6", "7.7", "7.8", "7.9", "7.10", "7.11", "7.12",
        "7.13", "7.14", "7.15",
    ]  # fmt: skip


def test_dahl_from_rest_is_drawn_for_five_exponents():
    drawn = FIGURES["2.7"].make()
    (axes,) = drawn.figure.axes
    assert len(axes.get_legend().get_texts()) == 5
    assert float(drawn.dataset["force"].max()) == pytest.approx(5.5)


def test_rigid_friction_is_reversed_for_a_third_of_the_cycle_at_k_2():
    friction = FIGURES["2.14"].make().dataset["friction_rigid_drive"].sel(axis="x").values
    assert np.median(np.abs(friction)) == pytest.approx(5.08)
    assert np.mean(np.abs(friction) < 5.079) < 1e-3
    assert np.mean(friction < 0.0) == pytest.approx(1.0 / 3.0, abs=1e-3)


def test_dahl_friction_falls_and_keeps_its_sign_just_above_k_1():
    dataset = FIGURES["2.15"].make().dataset
    for drive in ("compliant", "rigid"):
        least = float(dataset[f"friction_{drive}_drive"].sel(axis="x").min())
        assert 0.0 < least < 0.8 * float(dataset["full_force"])


def test_rigid_friction_keeps_its_size_under_transverse_vibration():
    dataset = FIGURES["2.16"].make().dataset
    size = np.hypot(*(dataset["friction"].sel(axis=axis).values for axis in ("x", "y")))
    assert size == pytest.approx(np.full(size.shape, 5.08), rel=1e-6)
    # (2/pi) K(m)/sqrt(1 + k^2) at k = 2.
    assert float(dataset["mean_friction"]) / 5.08 == pytest.approx(0.6425, abs=1e-3)


def test_both_laws_of_pressure_end_with_the_same_stiffness_and_begin_with_a_tenth():
    dataset = FIGURES["5.3"].make().dataset
    slope = {law: dataset["slope"].sel(law=law).values for law in ("linear", "two-stage")}
    assert slope["two-stage"][-1] == slope["linear"][-1]
    first = dataset["overclosure"].values.searchsorted(1e-9)
    assert slope["two-stage"][first] == pytest.approx(0.1 * slope["linear"][first])


@pytest.mark.parametrize("base_y", [0.5, -0.2])
def test_an_increment_that_is_drawn_is_the_scheme_that_is_marched(base_y):
    root, body, moved = np.array([0.0, 0.42]), np.array([0.5, 0.0]), np.array([0.8, -0.12])
    found = increment(root, body, moved, base_y)
    s = found.deflection[0]
    before = np.array([body[0] - root[0], root[1] - body[1]]) / s
    slip = moved - body
    last, cosine, sine = phases(s, *before, slip[0], -slip[1], 0.0, 0.71 * base_y, 1.0, False)
    assert found.deflection[2] == pytest.approx(last, rel=1e-12)
    assert [cosine, sine] == pytest.approx(
        [np.cos(found.angles[1]), np.sin(found.angles[1])], rel=1e-12
    )
    # The root stands its deflection away from the body, and took its share of the base.
    for place, size in zip((1, 3), found.deflection[1:], strict=True):
        assert np.hypot(*(found.root[place] - moved)) == pytest.approx(size)
    assert found.root[2] - found.root[1] == pytest.approx([0.0, 0.71 * base_y])
