"""NetCDF holds what JSON does, in parts within parts too."""

import json

import numpy as np
import pytest
import xarray as xr

import asperity
from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.results import read
from asperity.results.nested import with_parts
from asperity.runs import Run
from asperity.shafts import study


def shafts_of(case):
    return study.answer(study.prepare(read_case(case, case_tables(), ())), Run())


def leaves(value, path=(), index=()):
    """Yield every value of JSON by its keys, and by where it stands in lists."""
    if isinstance(value, dict):
        for key, part in value.items():
            yield from leaves(part, (*path, key), index)
    elif isinstance(value, list):
        for at, part in enumerate(value):
            yield from leaves(part, path, (*index, at))
    else:
        yield path, index, value


UNITS = {
    "N": "N", "Nm": "N m", "MPa": "MPa", "kWh": "kWh", "W": "W", "h": "h", "s": "s", "kg": "kg",
    "rpm": "rpm", "degC": "degC", "deg": "deg", "arcmin": "arcmin", "um": "um", "mm": "mm",
    "mm_per_rad": "mm/rad",
}  # fmt: skip
"""Units by what keys of JSON end with."""


def unit_by(name):
    """Return the unit that a key's end says."""
    ends = (end for end in UNITS if name.endswith(f"_{end}"))
    return UNITS.get(max(ends, key=len, default=""), "1")


def stands(dataset, path, index, over):
    """Return what a dataset has of a value."""
    name, rows = [], {}
    at = list(index)
    for key in path:
        if name and name[-1] in over and f"{'.'.join(name)}.row" not in rows:
            known = dataset[f"{'.'.join(name)}.row"].values.tolist()
            rows[f"{'.'.join(name)}.row"] = known.index(key)
        else:
            name.append(key)
    called = ".".join(name)
    if called not in dataset.variables:
        assert not index
        return dataset.attrs[called]
    variable = dataset[called]
    for dim in variable.dims:
        if dim not in rows:
            rows[dim] = at.pop(0)
    return variable.isel(rows).item()


@pytest.mark.parametrize(
    ("asked", "case", "over"),
    [
        (asperity.rate, "actuator-duty", ("forces",)),
        pytest.param(asperity.rate, "gearset-3", ("forces",), marks=pytest.mark.slow),
        (shafts_of, "actuator-shafts", ("cases",)),
    ],
)
def test_a_dataset_has_every_value_of_json(asked, case, over):
    answer = asked(case)
    dataset = answer.to_dataset()
    held = {entry.key: entry.variable for entry in answer.entries()}
    numbers = 0
    for path, index, value in leaves(json.loads(json.dumps(answer.to_json()))):
        key = ".".join(path)
        if value is None or key == "notes":
            continue
        numbers += isinstance(value, float)
        if key in held and key not in dataset.variables and not index:
            name = held[key]
            there = dataset[name].item() if name in dataset.variables else dataset.attrs[name]
        else:
            there = stands(dataset, path, index, over)
        assert there == value, key
    assert numbers > 90
    for name, variable in dataset.variables.items():
        if "." in name and variable.dtype.kind == "f":
            assert variable.attrs["units"] == unit_by(name), name


@pytest.mark.slow
@pytest.mark.parametrize("asked", [asperity.rate, shafts_of])
def test_and_so_has_its_file(tmp_path, asked):
    answer = asked("actuator-shafts")
    answer.save(tmp_path / "answer.nc")
    xr.testing.assert_equal(read(tmp_path / "answer.nc").to_dataset(), answer.to_dataset())


def test_what_one_row_lacks_is_nan_or_empty_and_what_none_has_is_not_there():
    parts = {
        "rows": [{"life_h": 2.0, "by": "wear"}, {"life_h": None, "none": None}],
        "of": {"a": {"x": [1, 2]}, "b": {"x": [3]}},
        "holds": True,
        "why": "heat",
        "lead_mm_per_rad": 3.5,
    }
    dataset = with_parts(xr.Dataset(), parts, over=("of",))
    np.testing.assert_array_equal(dataset["rows.life_h"], [2.0, np.nan])
    assert dataset["rows.life_h"].attrs == {"units": "h", "long_name": "rows: life"}
    assert dataset["rows.by"].values.tolist() == ["wear", ""]
    assert "rows.none" not in dataset
    np.testing.assert_array_equal(dataset["of.x"].sel({"of.row": "b"}), [3.0, np.nan])
    assert dataset.attrs == {"holds": 1, "why": "heat"}
    assert dataset["lead_mm_per_rad"].attrs["units"] == "mm/rad"


@pytest.mark.parametrize("end", UNITS)
def test_a_number_has_the_unit_that_its_key_ends_with(end):
    dataset = with_parts(xr.Dataset(), {"rows": [{f"a_{end}": 1.0, f"a{end}": 2.0}]})
    assert dataset[f"rows.a_{end}"].attrs == {"units": UNITS[end], "long_name": "rows: a"}
    assert dataset[f"rows.a{end}"].attrs["units"] == "1"


@pytest.mark.parametrize("rows", [[{"x": [1.0, 2.0]}, {"x": 3.0}], [{"x": 3.0}, {"x": [1.0]}]])
def test_a_key_that_is_a_list_in_one_row_and_a_number_in_another_is_refused(rows):
    with pytest.raises(TypeError, match=r"rows\.x is a list in one place and not in another"):
        with_parts(xr.Dataset(), {"rows": rows})
