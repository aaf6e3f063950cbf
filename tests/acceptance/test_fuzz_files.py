"""Files of recordings that are wrong in every way that could be thought of.

Each is a good file with bytes changed, cut or repeated at random: text of several instruments,
MATLAB, TDMS, WAV, netCDF, a session of sigrok, a table of measurements and a configuration.
Whatever it is, the command answers or says in one line what is wrong. The files are the same ones
every time.
"""

import importlib.util
import random
import resource
import shutil

import h5py
import numpy as np
import pytest
import scipy.io
from apparatus import laboratory_files as formats
from apparatus.rig_signals import record, run_of
from scipy.io import wavfile

from asperity.cli.main import main
from asperity.files.shipped import shipped_cases

pytestmark = pytest.mark.slow

FILES = 200  # of each test
TESTS = 50
LOOKED_AT = {"run.wav", "run.lvm", "tds.csv", "rigol.csv", "clock.csv", "run.sr"}
MOST_MEMORY = 1_500_000_000  # bytes above what the process has, for files of less than 1 MB
OK, USAGE, NOT_CONVERGED = 0, 2, 3


def mutated(rng, content):
    """Return the bytes of a file with some of them changed."""
    content = bytearray(content)
    for _ in range(rng.randint(1, 5)):
        at = rng.randrange(len(content)) if content else 0
        kind = rng.randrange(6)
        if kind == 0:
            content[at : at + 1] = bytes([rng.randrange(256)])
        elif kind == 1:
            del content[at : at + rng.choice([1, 10, 1000])]
        elif kind == 2:
            del content[at:]
        elif kind == 3:
            content[at:at] = content[at : at + rng.choice([1, 50, 2000])]
        elif kind == 4:
            content[at : at + 8] = rng.choice([b"\xff" * 8, b"\0" * 8, b"9" * 8, b",;\t\n\"'-+"])
        else:
            content[at : at + 4] = rng.randrange(1 << 32).to_bytes(4, "little")
    return bytes(content)


@pytest.fixture(scope="module")
def good(tmp_path_factory):
    """Good files by their name, with the command that reads each."""
    folder = tmp_path_factory.mktemp("good")
    rows = np.column_stack((1e-3 * np.arange(300), np.random.default_rng(0).normal(size=(300, 8))))
    head = "Time," + ",".join(f"Channel {letter}" for letter in "ABCDEFGH")
    lines = [head, "(s)" + ",(V)" * 8, ""]
    lines += [",".join(f"{value:.5g}" for value in row) for row in rows]
    (folder / "run.csv").write_text("\n".join(lines), "utf-8")
    variables = {name: rows[:, n + 1 : n + 2] for n, name in enumerate("ABCDEFGH")}
    variables["Tinterval"] = np.array([[1e-3]])
    for version in ("4", "5"):
        scipy.io.savemat(folder / f"run-{version}.mat", variables, format=version)
    with h5py.File(folder / "run-7.mat", "w", userblock_size=512) as file:
        for name, value in variables.items():
            file[name] = value
    record(folder / "run.nc", run_of(frequencies=(250.0,), duration=5.0), rate=1500.0)
    (folder / "data.csv").write_text(
        "vibration.velocity_ratio,ratio,sd\n2,0.46,0.01\n3,0.26,0.01\n6,0.12,0.01\n", "utf-8"
    )
    (folder / "rig.toml").write_bytes(shipped_cases()["rig-final"].read_bytes())
    shutil.copy(folder / "run.nc", folder / "whole.nc")
    wavfile.write(folder / "run.wav", 1000, rows[:, 1:].astype(np.float32))
    (folder / "run.lvm").write_text("\n".join(formats.labview()), "utf-8")
    (folder / "tds.csv").write_text("\n".join(formats.tektronix_tds2000()), "utf-8")
    (folder / "rigol.csv").write_text("\n".join(formats.rigol_ds1054z()), "utf-8")
    (folder / "clock.csv").write_text("\n".join(formats.iso()), "utf-8")
    formats.sigrok(folder / "run.sr")
    if importlib.util.find_spec("nptdms") is not None:
        from nptdms import ChannelObject, TdmsWriter

        with TdmsWriter(folder / "run.tdms") as writer:
            told = {"wf_increment": 1e-3, "unit_string": "V"}
            writer.write_segment(
                [ChannelObject("scope", name, rows[:, n + 1], told)
                 for n, name in enumerate("ABCDEFGH")]
            )  # fmt: skip
    return folder


def arguments(folder, name):
    if name == "data.csv":
        return ["fit", name, "table-4.3", "--free", "friction.max_deflection"]
    if name == "rig.toml":
        return ["rig", "reduce", str(folder / "whole.nc"), "--config", name]
    if name.endswith(".nc"):
        return ["rig", "reduce", name]
    if name in LOOKED_AT:
        return ["rig", "look", name]
    return ["rig", "import", name, "rig-final"]


@pytest.mark.campaign(over="part")
@pytest.mark.parametrize("part", range(TESTS))
def test_no_file_ends_in_a_traceback(good, part, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    rng = random.Random(part)
    names = sorted(path.name for path in good.iterdir() if path.name != "whole.nc")
    wrong = []
    for _ in range(FILES):
        name = rng.choice(names)
        (tmp_path / name).write_bytes(mutated(rng, (good / name).read_bytes()))
        capsys.readouterr()
        before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        try:
            main([*arguments(good, name), "--json"])
        except SystemExit as ended:
            code, errors = ended.code or 0, capsys.readouterr().err.splitlines()
            if code not in (OK, USAGE, NOT_CONVERGED) or (code == USAGE and len(errors) != 1):
                wrong.append(f"{part}: {name} ended with {code}: {errors}")
        except Exception as error:
            wrong.append(f"{part}: {name}: {type(error).__name__}: {error}")
        grown = 1024 * (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before)
        if grown > MOST_MEMORY:
            wrong.append(f"{part}: {name} took {grown / 1e9:.1f} GB")
    assert not wrong, "\n".join(wrong)
