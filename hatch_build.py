"""How wheels are made: with a library of compiled kernels where there is a C compiler.

Compiling takes some seven processor minutes, the first time; what is made is kept in the user's
cache. ``ASPERITY_LIBRARY=0`` in the environment leaves the library out, which makes a wheel for all
machines; with ``ASPERITY_LIBRARY=1`` a library that cannot be made is an error.
"""

import os
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

from hatchling import build as _hatchling
from hatchling.build import *  # noqa: F403
from hatchling.builders.hooks.plugin.interface import BuildHookInterface

from asperity.kernels.building.compiler import hindrance

ROOT = Path(__file__).parent
# What the modules of kernels import, and what compiles them.
NEEDED = ("numba", "numpy", "pydantic", "scipy")


def get_requires_for_build_wheel(config_settings=None):
    """Return what a wheel with a library needs; one without needs nothing."""
    needed = _hatchling.get_requires_for_build_wheel(config_settings)
    if _said() == "0" or hindrance() is not None:
        return needed
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    return [*needed, *(line for line in project["dependencies"] if line.startswith(NEEDED))]


class LibraryHook(BuildHookInterface):
    """Puts the library into a wheel, and tells whom the wheel is for then."""

    def initialize(self, version, build_data):
        """Make the library, but for an installation that runs from the sources."""
        if version == "editable" or self.target_name != "wheel" or _said() == "0":
            return
        self._made = tempfile.TemporaryDirectory()
        folder = Path(self._made.name)
        why = hindrance() or _library(folder)
        if why is not None:
            if _said() == "1":
                raise RuntimeError(f"no library of kernels: {why}")
            self.app.display_warning(
                f"no library of kernels: {why}; each is compiled at its first call instead"
            )
            return
        build_data["pure_python"] = False
        build_data["tag"] = "py3-none-linux_x86_64"
        for file in folder.iterdir():
            build_data["force_include"][str(file)] = f"asperity/kernels/native/made/{file.name}"

    def finalize(self, version, build_data, artifact_path):
        """Remove what stands in the wheel now."""
        if hasattr(self, "_made"):
            self._made.cleanup()


def _said():
    return os.environ.get("ASPERITY_LIBRARY", "")


def _library(folder):
    """Make the library in a folder; return why there is none, or None."""
    with tempfile.TemporaryDirectory() as beside:
        # By another name: pip keeps from what is built in an environment all that its packages add
        # to the path, the sources themselves where they are installed to be edited.
        sources = Path(beside) / "src"
        sources.symlink_to(ROOT / "src", target_is_directory=True)
        paths = [str(sources), os.environ.get("PYTHONPATH", "")]
        done = subprocess.run(
            [sys.executable, "-m", "asperity.kernels.building.library", str(folder)],
            env=os.environ | {"PYTHONPATH": os.pathsep.join(filter(None, paths))},
            stderr=subprocess.PIPE,
            text=True,
            check=False,
        )
    if done.returncode:
        last = (done.stderr.strip().splitlines() or [f"status {done.returncode}"])[-1]
        return last.removeprefix("no library of kernels: ")
    sys.stderr.write(done.stderr)
    return None
