"""Proposals in each of their forms: JSON, netCDF and the tables hold the same."""

import json

import numpy as np
import pytest

from asperity.rating.verdict_rows import Row
from asperity.results import read
from asperity.studies.proposed import Proposal, Proposals

PLAIN = Proposal(1, 40, 100.0, 4.0, 10.0, 0.25, 0.75, 1.2, "iso14521.S_H", True)
WHOLE = PLAIN._replace(
    wheel_teeth=41,
    locks_at_rest=("iso14521", "bs721"),
    locks="by some",
    hob="4 x 40",
    mass_kg=4.5,
    rim_kg=0.9,
    backlash_arcmin=(3.0, 9.0),
    rows=(
        Row("worm shaft", "DIN 743", 1.4, 1.2, by="section 2"),
        Row("bearing 1", "ISO 281", 9000.0, 5000.0, "h"),
    ),
    bearings={"worm_shaft.bearing.1": "6205"},
)


def saved(folder, *found):
    proposals = Proposals(rated=9, holding=2, ranked_by="size", found=found, notes=("a note",))
    proposals.write(folder, pictures="")
    answer = json.loads((folder / "size.json").read_text("utf-8"))
    return answer, read(folder / "size.nc").to_dataset()


@pytest.mark.slow
@pytest.mark.parametrize("found", [(PLAIN,), (PLAIN, WHOLE), (WHOLE, WHOLE)])
def test_netcdf_holds_of_each_proposal_what_json_does(tmp_path, found):
    answer, dataset = saved(tmp_path, *found)
    assert dataset.attrs["rated"] == answer["rated"]
    for place, proposal in enumerate(answer["proposals"]):
        own = dataset.isel(proposal=place)
        rows, bearings = proposal.pop("rows", []), proposal.pop("bearings", {})
        for key, value in proposal.items():
            name, _, unit = key.rpartition("_")
            held = own[name if unit in ("mm", "kg", "arcmin") else key]
            assert held.attrs["long_name"]
            if name and unit in ("mm", "kg", "arcmin"):
                assert held.attrs["units"] == unit
            if isinstance(value, list) and key != "backlash_arcmin":
                assert held.item() == "; ".join(value)
            else:
                assert held.values.tolist() == value
        for row in rows:
            there = own.sel(row=row["name"])
            assert there["row_value"] == row.get("safety", row.get("life_h"))
            assert there["row_asked"] == row.get("asked", row.get("asked_h"))
            assert there["row_standard"] == row["standard"]
            assert there["row_by"] == row["by"]
            assert (there["row_unit"] == "h") == ("life_h" in row)
        if bearings:
            assert own["bearings"] == "; ".join(f"{k} = {name}" for k, name in bearings.items())


@pytest.mark.slow
def test_what_one_proposal_lacks_is_nan_or_empty(tmp_path):
    _, dataset = saved(tmp_path, PLAIN, WHOLE)
    first = dataset.isel(proposal=0)
    assert np.isnan(first["mass"])
    assert np.isnan(first["backlash"]).all()
    assert np.isnan(first["row_value"]).all()
    assert first["hob"] == ""
