"""What a job finds, the command line finds again: by its line, and by the case that is saved."""

import importlib.util
import itertools
import json
import shlex
from pathlib import Path

import numpy as np
import pytest
import scipy.io
import xarray as xr

from asperity.casefile.written import written

pytestmark = pytest.mark.slow

ANSWERS = Path(__file__).parents[1] / "answers"
BLOCK = {
    "block.elements": "[2, 2, 2]", "block.element": "hex8", "vibration.start": "1 ms",
    "solve.step": "4 us", "solve.duration": "2 ms",
}  # fmt: skip
TEETH = {
    "drive.deflection": '[["22 N m", "50 urad"], ["366 N m", "365 urad"]]',
    "drive.effective_radius": "9.8 mm", "drive.tangential_compliance": "2.9 nm/N",
}  # fmt: skip
# What differs from run to run, and where it was left.
TIMES = frozenset(("seconds", "condense_seconds", "ms_per_increment", "file"))
PERIODIC = {"solve.method": "periodic"}
LETTERS = "ABCDEFGH"


def steady(answer):
    """An answer without what differs from run to run."""
    if isinstance(answer, dict):
        return {key: steady(value) for key, value in answer.items() if key not in TIMES}
    return [*map(steady, answer)] if isinstance(answer, list) else answer


def done(page, command, case="", settings=None, arguments=None, **options):
    """Do a job to its end; returns it and its answer."""
    begun = page.job(command, case, settings, arguments, **options)
    assert begun.status == 200, begun.error
    job = page.ended(begun.json["id"])
    assert job["state"] == "done", job
    assert job["answered"]
    return job, page.get(f"/api/jobs/{job['id']}/answer").json


ASKED = {
    "drive": ("drive-screw", TEETH, {}),
    "block": ("block-longitudinal", BLOCK, {}),
    "sweep": ("table-4.3", PERIODIC, {"over": ["vibration.velocity_ratio=2,4"]}),
    "flank": ("gearset-3b", {"mount.backlash": "0.1 mm"}, {"density": "coarse"}),
}


@pytest.mark.campaign(over="command")
@pytest.mark.parametrize("command", [*ASKED])
def test_a_saved_case_gives_the_same_object(page, asperity, command):
    case, settings, options = ASKED[command]
    job, answer = done(page, command, case, settings, **options)
    words = shlex.split(job["line"])
    assert words[:3] == ["asperity", command, case]
    assert [f"{path}={text}" for path, text in settings.items()] == [
        word for before, word in itertools.pairwise(words) if before == "--set"
    ]
    name = f"same-{command}"
    saved = page.ask("POST", "/api/save", {"name": name, "toml": answer["toml"]})
    assert saved.status == 200, saved.error
    more = [f"--{key}={one}" for key, value in options.items() for one in np.atleast_1d(value)]
    code, printed, errors = asperity(command, f"{name}.toml", *more, "--json", cwd=page.folder)
    assert code == 0, errors
    assert steady(json.loads(printed)) == steady(answer["answer"])


def test_a_fit_to_an_upload_is_that_of_its_line(page, asperity):
    upload = page.ask("PUT", "/api/files/ratios.csv", (ANSWERS / "ratios.csv").read_bytes())
    assert upload.status == 200
    asked = {"free": "friction.max_deflection", "law": "vector"}
    job, answer = done(page, "fit", "table-4.3", arguments={"data": "ratios.csv"}, **asked)
    code, printed, errors = asperity(*shlex.split(job["line"])[1:], cwd=page.folder)
    assert code == 0, errors
    assert steady(json.loads(printed)) == steady(answer["answer"])


@pytest.fixture(scope="module")
def measured(page):
    """Volts of a rig's channels, and how often they are sampled, s; its case is in the folder."""
    with xr.open_dataset(ANSWERS / "rig.nc", engine="h5netcdf") as found:
        volts = found.raw.values * found.scale.values + found.offset.values
        tables = json.loads(found.attrs["configuration"])
        step = float(found.attrs["sample_interval"])
    assert [one["channel"] for one in tables["channels"].values()] == [*LETTERS]
    saved = page.ask("POST", "/api/save", {"name": "my-rig", "toml": written(tables)})
    assert saved.status == 200
    return volts, step


def csv(path, volts, step):
    rows = (f"{step * n:.9g}," + ",".join(f"{v:.7g}" for v in row) for n, row in enumerate(volts))
    heads = ["Time," + ",".join(f"Channel {letter}" for letter in LETTERS)]
    path.write_text("\n".join([*heads, "(s)" + 8 * ",(V)", "", *rows]) + "\n")


def mat(path, volts, step):
    channels = {letter: volts[:, n : n + 1] for n, letter in enumerate(LETTERS)}
    times = {"Tinterval": np.array([[step]]), "Tstart": np.array([[0.0]])}
    scipy.io.savemat(path, channels | times, format="5")


def tdms(path, volts, step):
    from nptdms import ChannelObject, TdmsWriter

    told = {"wf_increment": step, "unit_string": "V"}
    with TdmsWriter(path) as writer:
        writer.write_segment([
            ChannelObject("run", letter, volts[:, n].copy(), told)
            for n, letter in enumerate(LETTERS)
        ])  # fmt: skip


NO_TDMS = pytest.mark.skipif(
    importlib.util.find_spec("nptdms") is None, reason="nptdms is not installed"
)


@pytest.mark.campaign(over="make")
@pytest.mark.parametrize(
    "make", [csv, mat, pytest.param(tdms, marks=NO_TDMS)], ids=lambda make: make.__name__
)
def test_what_an_oscilloscope_wrote_is_uploaded_imported_and_reduced(
    page, asperity, measured, tmp_path, make
):
    name = f"scope.{make.__name__}"
    make(tmp_path / name, *measured)
    upload = page.ask("PUT", f"/api/files/{name}", (tmp_path / name).read_bytes())
    assert upload.status == 200, upload.error
    job, answer = done(page, "rig import", "my-rig.toml", arguments={"file": name})
    assert answer["answer"]["samples"] == len(measured[0])
    assert "REC.nc" in job["files"]
    # It is named as what it is: a file of the folder.
    recording = f"jobs/{job['id']}/REC.nc"
    job, answer = done(page, "rig reduce", arguments={"recordings": [recording]})
    code, printed, errors = asperity(*shlex.split(job["line"])[1:], cwd=page.folder)
    assert code == 0, errors
    assert steady(json.loads(printed)) == steady(answer["answer"])
    # And what was measured is what it was before it was exported.
    code, printed, errors = asperity("rig", "reduce", ANSWERS / "rig.nc", "--json")
    assert code == 0, errors
    before, after = (found["segments"][0] for found in (json.loads(printed), answer["answer"]))
    for key in ("torque_change_percent", "frequency_Hz"):
        assert after[key] == pytest.approx(before[key], rel=1e-4), key
