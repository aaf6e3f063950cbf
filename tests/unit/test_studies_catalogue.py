"""The best gearset for every ratio and centre distance."""

import json
import math

import numpy as np
import pytest

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.errors import InputError
from asperity.files.store import read_dataset, write_dataset
from asperity.gearset import Gearset
from asperity.gearset.sizing import MODULES
from asperity.rating import Operation, RatingOptions, rate
from asperity.studies.catalogue import search
from asperity.studies.design import Bounds

RATIOS = [5.0, 10.0, 20.0, 40.0, 60.0, 100.0]
DISTANCES = [0.04, 0.06, 0.1, 0.2]


def gearset(name="gearset-2", *settings):
    case = read_case(name, case_tables(), settings)
    return case.require(Gearset), case.require(Operation), case.require(RatingOptions)


@pytest.fixture(scope="module")
def found():
    return search(*gearset(), ratios=RATIOS, centre_distances=DISTANCES)


def test_every_pair_has_a_proposal_or_a_reason(found):
    missing = np.isnan(found.numbers["eta_z1_2"])
    assert ((found.reason != "") == missing).all()
    assert missing.any()
    assert not missing.all()


def test_a_proposal_is_the_gearset_that_rates_so(found):
    _, operation, options = gearset()
    for i, j in np.argwhere(found.reason == ""):
        rated = rate(found.gearset_at(i, j), operation, options, ("iso14521", "bs721"))
        numbers = {key: values[i, j] for key, values in found.numbers.items()}
        assert rated.iso14521["eta_z1_2"] == pytest.approx(numbers["eta_z1_2"], rel=1e-12)
        assert rated.bs721["M_w_Nm"] == pytest.approx(numbers["M_w_Nm"], rel=1e-12)
        assert rated.bs721["M_s_Nm"] == pytest.approx(numbers["M_s_Nm"], rel=1e-12)


def test_a_proposal_bears_the_torques_and_keeps_the_bounds(found):
    proposed = found.reason == ""
    numbers = {key: values[proposed] for key, values in found.numbers.items()}
    assert (numbers["safety_wear"] > 1.0).all()
    assert (numbers["safety_strength"] > 1.0).all()
    assert (np.abs(numbers["profile_shift"]) <= 0.5).all()
    assert ((numbers["diameter_factor"] >= 6.0) & (numbers["diameter_factor"] <= 12.0)).all()
    assert set(numbers["axial_module_mm"]) <= set(MODULES)


def test_the_ratio_of_a_proposal_is_the_nearest_that_whole_teeth_give(found):
    for i, j in np.argwhere(found.reason == ""):
        starts, teeth = (found.numbers[key][i, j] for key in ("starts", "wheel_teeth"))
        assert teeth == round(starts * RATIOS[i])


def test_a_smaller_set_of_diameter_factors_is_never_better(found):
    few = search(
        *gearset(), ratios=RATIOS, centre_distances=DISTANCES,
        bounds=Bounds(diameter_factor=(8.0, 9.0)),
    )  # fmt: skip
    assert np.nansum(few.candidates) < np.nansum(found.candidates)
    both = (few.reason == "") & (found.reason == "")
    assert (few.numbers["eta_z1_2"][both] <= found.numbers["eta_z1_2"][both]).all()


def test_a_wheel_without_enough_teeth_is_the_reason(found):
    assert found.reason[0, 3].startswith("no worm of 1 to 6 starts gives a wheel of")
    assert found.candidates[0, 3] == 0


def test_a_number_of_starts_that_a_table_does_not_have_is_the_reason(found):
    assert found.reason[0, 0].startswith("bs721: starts is not allowed; it must be from 1 to 4")


def test_a_torque_that_none_bears_is_the_reason_with_the_best_there_is():
    weak = search(
        *gearset("gearset-2", "operation.output_torque=5 kN m"),
        ratios=[60.0], centre_distances=[0.06],
    )  # fmt: skip
    assert weak.reason[0, 0].startswith("too weak by BS 721: the strongest has M_w")
    assert weak.reason[0, 0].endswith("for 5000 N m")


def test_a_module_that_does_not_exist_is_the_reason():
    none = search(
        *gearset(), ratios=[30.0], centre_distances=[0.06],
        bounds=Bounds(profile_shift=(0.0123, 0.0124)),
    )  # fmt: skip
    assert none.reason[0, 0] == "no module of ISO 54 gives a profile shift within 0.0123 and 0.0124"


def test_a_pair_without_a_proposal_has_no_gearset(found):
    with pytest.raises(InputError, match="a gear ratio of 5 at a centre distance of 200 mm: no"):
        found.gearset_at(0, 3)


def test_widths_of_the_gearset_given_do_not_limit_the_proposals(found):
    narrow = search(
        *gearset("gearset-2", "gearset.wheel_face_width=5 mm"),
        ratios=RATIOS, centre_distances=DISTANCES,
    )  # fmt: skip
    assert np.array_equal(narrow.numbers["M_s_Nm"], found.numbers["M_s_Nm"], equal_nan=True)


def test_json_lists_proposals_and_what_is_impossible(found):
    answer = json.loads(json.dumps(found.to_json(), allow_nan=False))
    assert len(answer["proposals"]) + len(answer["impossible"]) == len(RATIOS) * len(DISTANCES)
    first = answer["proposals"][0]
    assert isinstance(first["starts"], int)
    assert first["centre_distance_mm"] in (40.0, 60.0, 100.0, 200.0)


@pytest.mark.slow
def test_the_dataset_survives_its_file(found, tmp_path):
    dataset = read_dataset(write_dataset(found.to_dataset(), tmp_path / "catalogue.nc"))
    assert dataset["axial_module"].attrs["units"] == "mm"
    at = dataset.sel(ratio=60.0, centre_distance=0.06)
    assert float(at["eta_z1_2"]) == found.numbers["eta_z1_2"][4, 1]


@pytest.mark.parametrize(
    ("ratios", "distances", "message"),
    [
        ([1.0], [0.06], "ratios has 1 among them; each must be above 1"),
        ([20.0], [0.0], "centre_distances has 0 among them"),
        ([20.0], [math.nan], "centre_distances has nan among them"),
        ([], [0.06], r"ratios is of shape \(0,\); it must be a list of numbers"),
    ],
)
def test_ratios_and_centre_distances_that_cannot_be_are_refused(ratios, distances, message):
    with pytest.raises(InputError, match=message):
        search(*gearset(), ratios=ratios, centre_distances=distances)
