"""Files that stand all or not at all."""

import contextlib
import os
import shutil
from collections.abc import Iterator
from pathlib import Path

from asperity.errors import StorageError
from asperity.files.leftovers import temporary_beside
from asperity.files.store import flush_folder, reason, refuse_input


@contextlib.contextmanager
def written_together(folder: Path) -> Iterator[Path]:
    """Give a folder to write files to, which stand in another one when all of them are whole.

    Parameters
    ----------
    folder : path
        Where they are to stand; it must exist. Where one of them cannot be written, none does.

    Raises
    ------
    StorageError
        They cannot be written.
    InputError
        One of them is what the command reads.
    """
    made = temporary_beside(folder / "together")
    try:
        made.mkdir()
        yield made
        files = [path for path in sorted(made.rglob("*")) if path.is_file()]
        places = [folder / path.relative_to(made) for path in files]
        for place in places:
            refuse_input(place)
        for path, place in zip(files, places, strict=True):
            place.parent.mkdir(parents=True, exist_ok=True)
            os.replace(path, place)
    except StorageError as error:
        error.args = (str(error).replace(str(made), str(folder)), *error.args[1:])
        raise
    except OSError as error:
        raise StorageError(f"{folder} cannot be written to: {reason(error)}") from error
    finally:
        shutil.rmtree(made, ignore_errors=True)
    flush_folder(folder)
