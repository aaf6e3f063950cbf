"""Inputs of a worm gearset raised one at a time."""

import json
import math

import numpy as np
import pytest

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.errors import InputError
from asperity.files.store import read_dataset, write_dataset
from asperity.gearset import Gearset
from asperity.rating import Operation, RatingOptions, rate
from asperity.rating.iso14521.film_failure import FilmParameterError
from asperity.studies.sensitivity import sensitivity


def gearset(name="gearset-2", *settings):
    case = read_case(name, case_tables(), settings)
    return case.require(Gearset), case.require(Operation), case.require(RatingOptions)


@pytest.fixture(scope="module")
def study():
    return sensitivity(*gearset())


def test_a_raised_input_gives_the_efficiency_of_the_gearset_that_has_it(study):
    for name, setting in (
        ("worm_speed", "operation.worm_speed=1584 rpm"),
        ("worm_roughness", "gearset.worm_roughness=1.76 um"),
        ("pressure_angle", "gearset.pressure_angle=22 deg"),
    ):
        rated = rate(*gearset("gearset-2", setting), ("iso14521",)).iso14521
        assert study[name].efficiency[2] == pytest.approx(rated["eta_z1_2"], rel=1e-12)


def test_every_input_starts_from_the_gearset_as_it_is(study):
    for found in study.influences:
        assert found.efficiency[0] == pytest.approx(study.efficiency, rel=1e-13)
    assert study["axial_module"].values[0] == 1.7
    assert study["pressure_angle"].values[-1] == pytest.approx(28.0)


def test_a_value_without_an_answer_is_masked_with_its_reason(study):
    found = study["gear_ratio"]
    assert np.isnan(found.efficiency[6:]).all()
    assert (found.reason[6:] > 0).all()
    assert not found.reason[:6].any()
    assert "h*" in found.legend[found.reason[-1]]


def test_there_is_an_answer_just_below_where_answers_end_and_none_just_above(study):
    for name in ("gear_ratio", "axial_module"):
        end = study[name].fails_above
        near = sensitivity(*gearset(), inputs=[name], rises=[0.0, end - 1e-6, end + 1e-6])
        assert np.isnan(near[name].efficiency).tolist() == [False, False, True]


def test_the_elasticity_is_the_slope_of_the_logarithms(study):
    small = sensitivity(*gearset(), inputs=["worm_speed"], rises=[0.0, 1e-5])["worm_speed"]
    slope = math.log(small.efficiency[1] / small.efficiency[0]) / math.log1p(1e-5)
    assert study["worm_speed"].elasticity == pytest.approx(slope, rel=1e-4)


def test_an_influence_that_turns_says_so():
    assert sensitivity(*gearset("gearset-3"))["diameter_factor"].effect == "raises, then lowers"


def test_an_input_without_influence_says_so():
    study = sensitivity(*gearset("gearset-2", "rating.friction=0.1"))
    assert study["worm_roughness"].effect == "none"
    assert study["diameter_factor"].effect == "lowers"


def test_json_holds_plain_numbers_with_units_and_none_for_no_answer(study):
    answer = json.loads(json.dumps(study.to_json(), allow_nan=False))
    assert answer["rises_percent"] == [0, 5, 10, 15, 20, 25, 30, 35, 40]
    ratio = answer["inputs"]["gear_ratio"]
    assert ratio["eta_z1_2"][-1] is None
    assert ratio["gear_ratio"][-1] == pytest.approx(84.0)
    assert ratio["reason"].startswith("h*")
    assert answer["inputs"]["axial_module"]["axial_module_mm"][0] == 1.7
    assert answer["inputs"]["worm_speed"]["fails_above_percent"] is None


@pytest.mark.slow
def test_the_dataset_survives_its_file(study, tmp_path):
    dataset = read_dataset(write_dataset(study.to_dataset(), tmp_path / "study.nc"))
    curve = dataset["eta_z1_2"].sel(input="centre_distance")
    assert curve.values.tolist() == study["centre_distance"].efficiency.tolist()
    assert dataset["axial_module"].attrs["units"] == "mm"
    assert dataset["reason"].sel(input="gear_ratio").values[-1].startswith("h*")


def test_the_picture_has_a_line_for_every_input(study):
    (axes,) = study.plot().axes
    labels = axes.get_legend_handles_labels()[1]
    assert len(labels) == len(study.influences)


def test_rises_must_increase_from_zero():
    for rises in ([0.1, 0.2], [0.0], [0.0, 0.2, 0.1], [[0.0, 0.1]]):
        with pytest.raises(InputError, match=r"^rises is .*; it must increase from 0"):
            sensitivity(*gearset(), rises=rises)


def test_an_unknown_input_names_the_nearest():
    with pytest.raises(InputError, match="did you mean 'axial_module'"):
        sensitivity(*gearset(), inputs=["axial_modul"])
    with pytest.raises(InputError, match="not varied in this study"):
        sensitivity(*gearset(), inputs=["worm_speed"])["gear_ratio"]


def test_a_gearset_without_an_efficiency_is_refused_by_name():
    with pytest.raises(FilmParameterError, match=r"h\* is"):
        sensitivity(*gearset("gearset-2", "gearset.axial_module=2.4 mm"))
