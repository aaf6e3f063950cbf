"""What a command line answers: its exit code, the JSON it prints, and what is in its files.

Texts are split into words and numbers, since a number may be printed with its last digit moved.
Long arrays are kept as a few samples and moments.
"""

import contextlib
import csv
import hashlib
import io
import json
import math
import os
import re
import shlex
import tomllib
from pathlib import Path
from unittest import mock

import numpy as np

HERE = Path(__file__).parent

_MOST_KEPT_WHOLE = 24
_SAMPLES = 16

# Of a deck and a subroutine.
_REMARKS = {
    ".inp": re.compile(r"^\*\*.*$", re.MULTILINE),
    ".f": re.compile(r"^[Cc!*].*$", re.MULTILINE),
}
_NUMBER = re.compile(r"(?<![\w.])[-+]?(?:\d+\.?\d*|\.\d+)(?:[eEdD][-+]?\d+)?(?![\w.])")


def command_lines(group):
    """Command lines of a group, `ordinary` or `slow`, as they are written in ``commands.toml``."""
    return tomllib.loads((HERE / "commands.toml").read_text("utf-8"))[group]["commands"]


def arguments(line, out):
    """Arguments of a command line, with ``--json``."""
    short = tomllib.loads((HERE / "commands.toml").read_text("utf-8"))["short"]
    short |= {"OUT": out, "WAVE": HERE / "wave.csv", "RIGID": HERE / "rigid.toml"}
    short |= {"RECORDING": HERE / "rig.nc", "RATIOS": HERE / "ratios.csv"}
    for name, meant in short.items():
        line = re.sub(rf"\b{name}\b", lambda _, meant=meant: str(meant), line)
    return [*shlex.split(line), "--json"]


def observe(line, folder):
    """Run a command line in this process, as a user without results of before, and look at it.

    Parameters
    ----------
    line : str
        As in ``commands.toml``.
    folder : path
        An empty folder, for the command's files and for what it keeps.

    Returns
    -------
    dict
        ``code``, the exit code; ``json``, what is printed; ``files``, what is in each file.
    """
    out = folder / "out"
    printed = io.StringIO()
    with (
        mock.patch.dict(os.environ, ASPERITY_CACHE=str(new_cache(folder))),
        contextlib.redirect_stdout(printed),
        contextlib.redirect_stderr(io.StringIO()),
    ):
        from asperity.cli.main import main

        try:
            main(arguments(line, out))
        except SystemExit as ended:
            code = ended.code
    answer = json.loads(printed.getvalue()) if printed.getvalue() else None
    # The JSON that is written is the JSON that is printed; a test of its own says so.
    written = sorted(path for path in out.rglob("*") if path.is_file() and path.suffix != ".json")
    files = {str(path.relative_to(out)): _content(path) for path in written}
    return {"code": code or 0, "json": answer, "files": files}


def new_cache(folder):
    """Make a cache in a folder, with nothing but this machine's compiled kernels."""
    from asperity.files.folders import cache_folder

    cache = folder / "cache" / "asperity"
    cache.mkdir(parents=True)
    if (kernels := cache_folder("kernels")) is not None:
        (cache / "kernels").symlink_to(kernels)
    return cache.parent


def _content(path):
    """What a file says, as far as it can be compared: {name: {units, dims, value}}."""
    read = {
        ".nc": _netcdf,
        ".csv": _csv,
        ".vtu": _vtu,
        ".stl": _surfaces,
        ".glb": _surfaces,
        ".inp": _text,
        ".f": _text,
    }.get(path.suffix)
    return {} if read is None else read(path)


def _netcdf(path):
    import xarray as xr

    with xr.open_dataset(path, engine="h5netcdf", decode_cf=False) as data:
        return {
            str(name): {
                "units": data[name].attrs.get("units"),
                "dims": list(map(str, data[name].dims)),
                "value": digest(data[name].to_numpy()),
            }
            for name in data.variables
        }


def _csv(path):
    with path.open(newline="", encoding="utf-8") as file:
        heads, *rows = csv.reader(line for line in file if not line.startswith("#"))
    columns = zip(*rows, strict=True)
    return {head: {"value": _cells(column)} for head, column in zip(heads, columns, strict=True)}


def _cells(column):
    """The numbers of a column, not a number where there is none, and the words that are there."""
    numbers, words = [], []
    for cell in column:
        try:
            numbers.append(float(cell))
        except ValueError:
            numbers.append(math.nan)
            words.append(cell)
    return digest(np.array(numbers)) | {"words": _hash(words)}


def _vtu(path):
    head, _, data = path.read_bytes().partition(b'<AppendedData encoding="raw">\n_')
    found = re.findall(rb'type="(\w+)" Name="([^"]*)".*?offset="(\d+)"', head)
    arrays = {}
    for kind, name, offset in found:
        start = int(offset) + 8
        length = int.from_bytes(data[start - 8 : start], "little")
        values = np.frombuffer(data[start : start + length], kind.decode().lower())
        arrays[name.decode()] = {"value": digest(values)}
    return arrays


def _surfaces(path):
    import trimesh

    scene = trimesh.load_scene(path, process=False)
    return {
        f"{name}.{part}": {"value": digest(np.asarray(getattr(mesh, part)))}
        for name, mesh in scene.geometry.items()
        for part in ("vertices", "faces")
    }


def _text(path):
    # A deck names its case, which may stand anywhere.
    text = _REMARKS[path.suffix].sub("", path.read_text("utf-8")).replace(f"{HERE}/", "")
    numbers = [float(re.sub("[dD]", "e", number)) for number in _NUMBER.findall(text)]
    # Where a line of numbers is broken depends on how many digits each has.
    words = " ".join(_NUMBER.sub("#", text).split())
    return {
        "words": {"value": hashlib.sha256(words.encode()).hexdigest()[:16]},
        "numbers": {"value": digest(np.array(numbers))},
    }


def digest(array):
    """An array as a list where it is short; else samples evenly over it, and moments."""
    array = np.asarray(array)
    if array.dtype.kind not in "biuf":
        words = [str(value) for value in array.ravel()]
        kept = words if len(words) <= _MOST_KEPT_WHOLE else _hash(words)
        return {"shape": list(array.shape), "words": kept}
    flat = array.ravel().astype(float)
    missing = np.isnan(flat)
    there = np.where(missing, 0.0, flat)
    if flat.size <= _MOST_KEPT_WHOLE:
        samples = flat
    else:
        samples = flat[np.linspace(0, flat.size - 1, _SAMPLES).astype(int)]
    kept = {
        "shape": list(array.shape),
        "missing": int(missing.sum()),
        "samples": [None if np.isnan(value) else float(value) for value in samples],
    }
    if flat.size > _MOST_KEPT_WHOLE:
        kept |= {
            "largest": float(np.abs(there).max()),
            "mean": float(there.mean()),
            "size": float(np.sqrt((there**2).mean())),
            # Where a value stands counts, too.
            "weighted": float((there * np.cos(np.arange(flat.size))).mean()),
        }
    return kept


def _hash(words):
    return hashlib.sha256("\0".join(words).encode()).hexdigest()[:16]
