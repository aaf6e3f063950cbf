"""Samples in files of other fields: WAV, sigrok's sessions, MDF 4."""

import configparser
import io
import warnings
import zipfile
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from asperity.errors import InputError, MissingExtraError, plain
from asperity.tribometer.importing.columns import Columns
from asperity.tribometer.importing.dates import begun_by_stamp
from asperity.tribometer.importing.heads import Declaration
from asperity.units import to_si

_MOST_BYTES = 4_000_000_000
_HEAD_BYTES = 1 << 20
_FULL = {"i": lambda kind: -float(np.iinfo(kind).min), "f": lambda kind: 1.0}


@np.errstate(all="ignore")  # a damaged file may hold numbers that signal when they are touched
def read_wav(path: Path, name: str, declaration: Declaration = Declaration()) -> Columns:  # noqa: B008
    """Read a WAV file of 8 to 32 bits or of floats: a recorder's or a sound card's.

    Raises
    ------
    InputError
        No such file, or a damaged one.
    """
    from scipy.io import wavfile

    _says_all(name, declaration)
    notes = ["its full scale is taken as 1 V; a channel's points say what it is worth"]
    try:
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            rate, values = wavfile.read(path)
    except Exception as error:
        raise InputError(f"{name} cannot be read: not a WAV file, or damaged") from error
    if any("EOF" in str(one.message) or "incomplete" in str(one.message) for one in caught):
        notes.append("the file is cut off; what is there is taken")
    values = values.reshape(len(values), -1)
    if values.dtype.kind == "u":  # 8 bits, about 128
        scaled = values.astype(np.float32) / 128.0 - 1.0
    else:
        full = _FULL[values.dtype.kind](values.dtype)
        scaled = values.astype(np.float64 if values.dtype.itemsize > 2 else np.float32) / full
    if rate <= 0:
        raise InputError(f"{name} tells a rate of {rate} Hz")
    return Columns(
        tuple(str(n + 1) for n in range(values.shape[1])), ("V",) * values.shape[1],
        tuple(scaled.T), interval=1.0 / rate, notes=tuple(notes), program="WAV",
    )  # fmt: skip


def read_sigrok(path: Path, name: str, declaration: Declaration = Declaration()) -> Columns:  # noqa: B008
    """Read the analog channels of a session of sigrok (.sr, version 2).

    Raises
    ------
    InputError
        No such file, a damaged one, or one without analog channels.
    """
    _says_all(name, declaration)
    try:
        with zipfile.ZipFile(path) as archive:
            sizes = {one.filename: one.file_size for one in archive.infolist()}
            if sizes.get("metadata", _HEAD_BYTES + 1) > _HEAD_BYTES:
                raise InputError(f"{name} is an archive without a session of sigrok in it")
            words = configparser.ConfigParser()
            words.read_file(io.StringIO(archive.read("metadata").decode("utf-8")))
            device = dict(words["device 1"])
            analog = {
                key: device[f"analog{key}"] for key in range(1, 65) if f"analog{key}" in device
            }
            if not analog:
                raise InputError(f"{name} has no analog channels")
            first = int(device.get("total probes", 0))
            if sum(sizes.values()) > _MOST_BYTES:
                raise InputError(f"{name} unpacks to more than {1e-9 * _MOST_BYTES:g} GB")
            values = tuple(
                _samples(archive, sizes, f"analog-1-{_index(device, key, first)}-")
                for key in analog
            )
            interval = 1.0 / to_si(device["samplerate"], "Hz")
    except InputError:
        raise
    except Exception as error:
        raise InputError(f"{name} cannot be read: not a session of sigrok, or damaged") from error
    return Columns(
        tuple(plain(one) for one in analog.values()), ("V",) * len(analog), values,
        interval=interval, program="sigrok",
    )  # fmt: skip


def _index(device: Mapping[str, str], key: int, logic: int) -> int:
    """Return the number that a channel's files have: all channels are counted, logic ones first."""
    return key if key > logic else key + logic


def _samples(archive: zipfile.ZipFile, sizes: Mapping[str, int], stem: str) -> np.ndarray:
    parts = sorted(
        (one for one in sizes if one.startswith(stem)), key=lambda one: int(one[len(stem) :])
    )
    if not parts:
        raise ValueError(f"no samples {stem}")
    return np.concatenate([np.frombuffer(archive.read(one), "<f4") for one in parts])


def read_mdf(path: Path, name: str, declaration: Declaration = Declaration()) -> Columns:  # noqa: B008
    """Read MDF 4 (and 3), as data loggers of vehicles write it, by asammdf.

    Raises
    ------
    MissingExtraError
        asammdf is not installed.
    InputError
        No such file, a damaged one, or channels of several rates.
    """
    _says_all(name, declaration)
    try:
        from asammdf import MDF
    except ImportError:
        raise MissingExtraError("MDF needs asammdf; install it: pip install asammdf") from None
    try:
        with MDF(path) as file:
            stamp = file.header.start_time
            signals = [
                one for one in file.iter_channels()
                if one.samples.dtype.kind in "fiu" and one.samples.ndim == 1 and len(one) > 1
            ]  # fmt: skip
    except Exception as error:
        raise InputError(f"{name} cannot be read: not an MDF file, or damaged") from error
    if not signals:
        raise InputError(f"{name} has no channel that holds samples")
    first = signals[0].timestamps
    same = [one for one in signals if np.array_equal(one.timestamps, first)]
    if len(same) < len(signals):
        raise InputError(
            f"{name}: its channels are of different rates; save those of one group in a file"
        )
    return Columns(
        tuple(plain(one.name) for one in same), tuple(one.unit or "V" for one in same),
        tuple(one.samples for one in same), times=np.asarray(first, dtype=float),
        program="MDF", start=float(first[0]), began=begun_by_stamp(stamp, "its header"),
    )  # fmt: skip


def _says_all(name: str, declaration: Declaration) -> None:
    if declaration.rate:
        raise InputError(f"{name} tells its own rate; leave --rate out")
