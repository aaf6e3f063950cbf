"""Which reader a file goes to, by its first bytes."""

import dataclasses
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from asperity.errors import InputError, plain, shown
from asperity.files import store
from asperity.tribometer.importing.columns import Columns
from asperity.tribometer.importing.dates import in_future, said_to_begin
from asperity.tribometer.importing.heads import Declaration
from asperity.tribometer.importing.join import joined, renamed
from asperity.tribometer.importing.mat import read_mat
from asperity.tribometer.importing.programs import channel_of, refuse_known
from asperity.tribometer.importing.tdms import read_tdms
from asperity.tribometer.importing.text import read_text
from asperity.tribometer.importing.waves import read_mdf, read_sigrok, read_wav
from asperity.units import to_si

TEXT, MAT, TDMS, OWN = "text", "mat", "TDMS", "recording"
WAV, SIGROK, MDF = "WAV", "sigrok", "MDF"
_READERS: Mapping[str, Callable[[Path, str, Declaration], Columns]] = {
    TEXT: read_text, MAT: read_mat, TDMS: read_tdms, WAV: read_wav, SIGROK: read_sigrok,
    MDF: read_mdf,
}  # fmt: skip
_MEANT = {
    ".sr": "session of sigrok", ".tdms": "TDMS file", ".mf4": "MDF file", ".wav": "WAV file",
    ".nc": "recording", ".h5": "HDF5 file",
}  # fmt: skip
_HDF5 = b"\x89HDF\r\n\x1a\n"
_HEAD = 256
_MOST_RATE = 1e10


def declaration_of(
    rate: str = "", columns: str = "", units: str = "", start: str = ""
) -> Declaration:
    """Read what somebody says of a file.

    Parameters
    ----------
    rate : str
        Samples a second, with its unit: ``20 kHz``.
    columns, units : str
        Of all columns in order, separated by commas; a column called ``-`` is left out.
    start : str
        When it began: a day, with or without its time.

    Raises
    ------
    InputError
        A rate or a day that is none, a column without a name, or two of one name.
    """
    try:
        found = to_si(rate, "Hz") if rate else 0.0
    except InputError as error:
        raise InputError(f'--rate: {error}, as in --rate "20 kHz"') from None
    if rate and not 0.0 < found <= _MOST_RATE:
        raise InputError(f"--rate is {shown(rate)}; it must be above 0 and at most 10 GHz")
    names = tuple(one.strip() for one in columns.split(",")) if columns else ()
    named = [one for one in names if one != "-"]
    if not all(names) or len({*named}) < len(named):
        raise InputError(
            f"--columns is {shown(columns)}; it must name every column once, - for one to leave out"
        )
    units_told = tuple(one.strip() for one in units.split(",")) if units else ()
    return Declaration(found, names, units_told, said_to_begin(start) if start else None)


def form_of(path: Path, name: str) -> str:
    """Return the format of a file, by its first bytes.

    Raises
    ------
    InputError
        There is no such file, or it is of a kind that is known and not read.
    """
    store.keep_input(path)
    try:
        if not path.is_file():
            reason = "it is a folder; give a file" if path.is_dir() else "no such file"
            if path.exists() and not path.is_dir():
                reason = "it is no regular file; save what it holds to a file"
            raise InputError(f"{name} cannot be read: {reason}")
        with path.open("rb") as opened:
            head = opened.read(_HEAD)
    except OSError as error:
        raise InputError(f"{name} cannot be read: {store.reason(error)}") from None
    ending = path.suffix.lower()
    if head.startswith(b"TDSm"):
        return TDMS
    if head.startswith(_HDF5):
        return MAT if ending == ".mat" else OWN
    if head.startswith(b"MATLAB") or ending == ".mat":
        return MAT
    if head[:4] in (b"RIFF", b"RIFX", b"RF64") and head[8:12] == b"WAVE":
        return WAV
    if head.startswith(b"PK") and ending == ".sr":
        return SIGROK
    if head.startswith((b"MDF ", b"UnFinMF")):
        return MDF
    refuse_known(head, ending, name)
    if what := _MEANT.get(ending):
        raise InputError(
            f"{name} is called {ending} and is no {what}, or a damaged one; export it again, or as "
            "CSV"
        )
    return TEXT


def read_export(path: Path, name: str, declaration: Declaration = Declaration()) -> Columns:  # noqa: B008
    """Read what a laboratory's program wrote; refuses what is no such file.

    Parameters
    ----------
    path : Path
        The file.
    name : str
        What messages call it.
    declaration : Declaration
        What somebody says of it that it does not say itself.
    """
    form = form_of(path, name)
    if form == OWN:
        raise InputError(f"{name} is HDF5 of no known kind; export it as .csv, .mat or .tdms")
    return renamed(_READERS[form](path, name, declaration), channel_of(path.stem))


def read_joined(files: Sequence[str], declaration: Declaration) -> Columns:
    """Read the files of one recording, a file some of its channels.

    Notes say by what it is dated, where it is.
    """
    read = joined([(plain(one), read_export(Path(one), plain(one), declaration)) for one in files])
    if declaration.began is not None:
        late = in_future(declaration.began, "look at --start")
        return dataclasses.replace(
            read, began=(declaration.began, "--start"), notes=(*read.notes, *late)
        )
    if read.began is None:
        return read
    began, by = read.began
    note = f"begun {began:%Y-%m-%d %H:%M:%S} UTC, by {by}"
    late = in_future(began, "say when it began: --start")
    return dataclasses.replace(read, notes=(*read.notes, note, *late))
