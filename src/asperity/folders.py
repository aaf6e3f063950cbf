"""Where the user's caches stand."""

import os
import secrets
from pathlib import Path


def cache_folder(name: str) -> Path | None:
    """Return a writable folder for things that can be made again, or None where there is none.

    It stands in ``asperity/<name>`` under the folder the environment variable ``ASPERITY_CACHE``
    names, else under ``XDG_CACHE_HOME``, else under ``~/.cache``.
    """
    base = os.environ.get("ASPERITY_CACHE") or os.environ.get("XDG_CACHE_HOME")
    try:
        folder = (Path(base) if base else Path.home() / ".cache") / "asperity" / name
        folder.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        folder.mkdir(mode=0o700, exist_ok=True)
        # Permission bits do not tell about read-only file systems, so write and see.
        probe = folder / f".probe-{secrets.token_hex(6)}"
        probe.touch()
        probe.unlink()
    except (OSError, RuntimeError, ValueError):
        return None
    return folder.absolute()
