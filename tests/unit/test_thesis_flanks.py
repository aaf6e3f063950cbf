"""The thesis's figures of flanks: what each must show, and the bodies that they are drawn with."""

import numpy as np
import pytest

from asperity.mesh import box
from asperity.results.dataset import described
from asperity.thesis.contents import FIGURES
from asperity.thesis.flanks import figures as figures_flanks
from asperity.thesis.flanks import solids as figures_solids
from asperity.thesis.flanks.drawings import View, paint
from asperity.thesis.flanks.meshing import meshing
from asperity.thesis.flanks.shapes import Shape, joined

IDENTICAL, MISALIGNED, MODIFIED = 0, 1, 2


@pytest.fixture(scope="module")
def formation():
    return FIGURES["2.10"].make().dataset


def bearing_columns(dataset, design):
    """Share of the face that is within the film at each instant."""
    near = dataset["gap"].isel(design=design) < float(dataset["film"])
    face = dataset["face"].isel(design=design)
    width = float(face.max() - face.min())
    low = face.where(near).min(("row", "column"))
    high = face.where(near).max(("row", "column"))
    return ((high - low) / width).values, low.values, high.values


@pytest.mark.slow
def test_an_identical_hob_gives_contact_lines_across_the_face(formation):
    share, _, _ = bearing_columns(formation, IDENTICAL)
    assert share.max() > 0.99
    assert np.count_nonzero(share > 0.5) >= 4


@pytest.mark.slow
def test_misalignment_of_an_identical_hob_gives_contact_at_one_edge(formation):
    _, low, high = bearing_columns(formation, MISALIGNED)
    assert low == pytest.approx(float(formation["face"].isel(design=MISALIGNED).min()))
    assert np.all(high < -2.0)


@pytest.mark.slow
def test_an_oversized_and_tilted_hob_gives_ellipses_within_the_face(formation):
    share, low, high = bearing_columns(formation, MODIFIED)
    face = formation["face"].isel(design=MODIFIED)
    assert np.all(share < 0.25)
    assert np.all(low > float(face.min()) + 2.0)
    assert np.all(high < float(face.max()) - 2.0)


@pytest.mark.slow
def test_what_touches_the_wheel_lies_on_the_worms_thread(formation):
    touching = formation["worm_radius"].where(formation["gap"] < float(formation["film"]))
    # The film reaches past the end of the worm's flank by less than its tip is rounded.
    assert float(touching.min()) > float(formation["worm_root"])
    assert float(touching.max()) < float(formation["worm_tip"]) + 0.05


@pytest.mark.slow
def test_each_correction_lowers_the_highest_pressure():
    dataset = FIGURES["2.9"].make().dataset
    highest = {name: float(dataset[f"{name}_pressure"].max()) for name in figures_flanks.DESIGNS}
    assert highest["lead"] < 0.8 * highest["misaligned"]
    assert highest["relieved"] < 0.85 * highest["over_relieved"]
    assert float(dataset["relieved_length"]) > 1.2 * float(dataset["over_relieved_length"])


@pytest.mark.slow
def test_tilting_the_hob_brings_the_dye_from_the_edge_to_the_middle():
    dataset = FIGURES["2.11"].make().dataset
    centre = np.abs(dataset["centre"].values)
    half = float(dataset["face"].max())
    assert centre[0] > 0.7 * half
    assert centre[1] < 0.3 * half
    for tilt, share in zip(dataset["tilt"].values, dataset["marked_share"].values, strict=True):
        assert 0.1 < share < 0.25
        assert np.any(Shape.read(dataset, f"teeth_{tilt:g}").part == 1)


def test_the_profile_is_modified_between_pitch_line_and_tip_alone():
    dataset = FIGURES["2.13"].make().dataset
    radius, relief = dataset["radius"].values, dataset["relief"].values
    pitch, tip = float(dataset["pitch_radius"]), float(dataset["tip_radius"])
    assert relief[radius <= pitch] == pytest.approx(0.0, abs=1e-9)
    expected = 30.0 * np.maximum((radius - pitch) / (tip - pitch), 0.0) ** 3
    assert relief == pytest.approx(expected, abs=1e-6)


def test_facets_shrink_with_the_square_of_the_step_and_never_cut_into_the_flank():
    flank = meshing(figures_solids.GEAR).wheel.flank(1)
    grid = flank.grid(15, 21)
    step = figures_solids.STEP
    heights = [figures_solids.facet_height(flank, grid, step / part) for part in (1, 2, 4)]
    assert min(float(height.min()) for height in heights) > -1e-9
    means = [float(height.mean()) for height in heights]
    assert means[0] / means[1] == pytest.approx(4.0, rel=0.15)
    assert means[1] / means[2] == pytest.approx(4.0, rel=0.15)


@pytest.mark.slow
def test_the_densities_are_a_half_and_three_quarters_of_the_coarse_size():
    dataset = FIGURES["7.11"].make().dataset
    for name in ("element_height", "element_width"):
        size = dataset[name].values
        assert size / size[0] == pytest.approx([1.0, 0.75, 0.5], abs=0.03)
    assert np.all(np.diff(dataset["elements"].values) > 0)
    assert np.all(dataset["scaled_jacobian"].values > 0.2)


@pytest.fixture
def cube():
    return Shape.of_mesh(box((1.0, 1.0, 1.0), (2, 2, 2)))


def test_a_shape_comes_back_from_its_dataset(cube):
    both = joined([cube, Shape.of_grid(np.zeros((2, 3, 3)), 1)])
    back = Shape.read(described(**both.variables("cube")), "cube")
    assert np.array_equal(back.points, both.points)
    assert np.array_equal(back.faces, both.faces)
    assert np.array_equal(np.unique(back.part, return_counts=True), [[0, 1], [24, 2]])


def test_a_closed_body_shows_the_faces_towards_the_eye_and_a_shell_all(cube):
    from matplotlib.figure import Figure

    axes = Figure().subplots(1, 2)
    view = View((1.0, 1.0, 1.0))
    paint(axes[0], cube, {0: "#808080"}, view)
    paint(axes[1], cube, {0: "#808080"}, view, shell=True)
    drawn = [len(panel.collections[0].get_paths()) for panel in axes]
    assert drawn == [12, 24]
