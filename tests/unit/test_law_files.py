"""The mean friction law as other programs take it: C compiled, CSV and MATLAB read back."""

import ctypes
import dataclasses
import shutil
import subprocess

import numpy as np
import pytest
from scipy.interpolate import PchipInterpolator, PPoly
from scipy.io import loadmat

from asperity.errors import InputError
from asperity.slider import FrictionMap, HomogenisedLaw, pieces
from asperity.slider import cycle_mean_law as hl
from asperity.slider.law_files import WRITERS

pytestmark = pytest.mark.usefixtures("plain_kernels")

COMPILER = shutil.which("cc") or shutil.which("gcc")
STRICT = ["-std=c99", "-pedantic", "-Wall", "-Wextra", "-Werror", "-O2", "-shared", "-fPIC"]
compiled = pytest.mark.skipif(COMPILER is None, reason="there is no C compiler here")


def made_up(seed, full=5.5, viscous=0.3):
    """A law with an uneven table that is not symmetric."""
    rng = np.random.default_rng(seed)
    forward = np.cumsum(rng.uniform(1e-4, 1e-3, 40))
    backward = -np.cumsum(rng.uniform(1e-4, 1e-3, 35))[::-1]
    velocity = np.concatenate([backward, [0.0], forward])
    table = rng.uniform(-1.0, 1.0, (velocity.size, hl.COLUMNS))
    table[:, hl.FORCE] = np.tanh(900.0 * velocity) + viscous * velocity
    return HomogenisedLaw(velocity, table, full, 0.0, viscous)


@pytest.fixture(scope="module")
def curve():
    return FrictionMap([made_up(1)])


@pytest.fixture(scope="module")
def surface():
    laws = [made_up(2), made_up(3, 6.5, 0.0), made_up(4, 8.0, 0.1)]
    return FrictionMap(laws, np.array([0.1, 0.3, 0.9]), "vibration.velocity_amplitude", "m/s")


def library(laws, folder, about=("a case",)):
    """The functions of a law compiled without a word of the compiler."""
    files = WRITERS["c"](laws, about)
    for name, text in files.items():
        (folder / name).write_text(text)
    source = next(folder / name for name in files if name.endswith(".c"))
    subprocess.run([COMPILER, *STRICT, source.name, "-o", "law.so"], cwd=folder, check=True)
    found = ctypes.CDLL(str(folder / "law.so"))
    for name in ("asperity_friction", "asperity_friction_slope"):
        function = getattr(found, name)
        function.restype = ctypes.c_double
        function.argtypes = [ctypes.c_double] * (2 if laws.key else 1)
    return found


def velocities(laws, count):
    """At random in and beyond the tables, at their places and ends, and just beside them."""
    rng = np.random.default_rng(7)
    places = np.concatenate([law.velocity for law in laws.laws])
    ends = np.concatenate([places, np.nextafter(places, np.inf), np.nextafter(places, -np.inf)])
    scale = 10.0 ** rng.uniform(-3.0, 3.0, count - ends.size)
    return np.concatenate([ends, places.max() * scale * rng.standard_normal(scale.size)])


@compiled
def test_a_law_in_c_is_the_law_in_python(curve, tmp_path):
    found = library(curve, tmp_path)
    at = velocities(curve, 100_000)
    ours = curve(at)
    theirs = np.array([found.asperity_friction(v) for v in at.tolist()])
    assert (np.abs(theirs - ours) <= 1e-12 * np.maximum(np.abs(ours), 1.0)).all()
    law = curve.laws[0]
    slopes = np.array([found.asperity_friction_slope(v) for v in at[:5000].tolist()])
    exact = np.array([pieces.value_and_slope(v, *law.arguments)[1] for v in at[:5000]])
    assert np.abs(slopes - law.full_friction * exact).max() <= 1e-12 * np.abs(slopes).max()


@compiled
def test_a_map_in_c_is_the_map_in_python(surface, tmp_path):
    found = library(surface, tmp_path)
    at = velocities(surface, 100_000)
    value = np.random.default_rng(8).choice([-1.0, 0.1, 0.2, 0.3, 0.55, 0.9, 1e9], at.size)
    ours = surface(at, value)
    theirs = np.array([found.asperity_friction(*pair) for pair in zip(at, value, strict=True)])
    assert (np.abs(theirs - ours) <= 1e-12 * np.maximum(np.abs(ours), 1.0)).all()


def test_a_map_is_linear_between_its_laws_and_has_the_nearest_beyond(surface):
    first, second, last = (law(np.array([0.001, -0.004, 5.0])) for law in surface.laws)
    at = np.array([0.001, -0.004, 5.0])
    assert np.array_equal(surface(at, 0.0), first)
    assert np.array_equal(surface(at, 2.0), last)
    assert np.abs(surface(at, 0.25) - (0.25 * first + 0.75 * second)).max() < 1e-14
    assert isinstance(surface(0.001, 0.25), float)
    with pytest.raises(InputError, match="values that rise"):
        FrictionMap(surface.laws, np.array([0.1, 0.1, 0.2]))


@compiled
def test_a_comment_cannot_be_left_by_the_name_of_a_case(curve, tmp_path):
    library(curve, tmp_path, ["*/ int main = 1; /*", "a\n#error", "??/", "a\\"])


@pytest.mark.parametrize("kind", ["c", "csv"])
def test_a_file_says_where_the_law_is_no_prediction(curve, kind):
    (law,) = curve.laws
    loose = FrictionMap([dataclasses.replace(law, unsettled=(float(law.velocity[3]),))])
    said = ["".join(WRITERS[kind](each, ["a case"]).values()) for each in (curve, loose)]
    told = [" ".join(text.split()) for text in said]
    assert ["no prediction" in text for text in told] == [False, True]
    assert f"{law.velocity[3]:.3g} m/s" in told[1]


def test_csv_has_the_table_with_units(curve, tmp_path):
    (text,) = WRITERS["csv"](curve, ["a case"]).values()
    lines = text.splitlines()
    rows = [line for line in lines if not line.startswith("#")]
    assert lines[0] == "# a case"
    assert rows[0].startswith("velocity [m/s],friction [N],highest [N]")
    numbers = np.array([[float(cell) for cell in row.split(",")] for row in rows[1:]])
    inside = np.linspace(*curve.laws[0].velocity[[0, -1]], 101)
    again = PchipInterpolator(numbers[:, 0], numbers[:, 1])(inside)
    assert np.abs(again - curve(inside)).max() <= 1e-12


def test_matlab_has_the_cubics_in_newton(curve, surface, tmp_path):
    for laws in (curve, surface):
        for name, content in WRITERS["mat"](laws, ["a case"]).items():
            (tmp_path / name).write_bytes(content)
    read = loadmat(tmp_path / "law.mat", simplify_cells=True)
    law = curve.laws[0]
    inside = np.linspace(*law.velocity[[0, -1]], 101)
    again = PPoly(read["coefs"].T, read["breaks"])(inside)
    assert np.abs(again - curve(inside)).max() <= 1e-12
    assert (read["full_friction"], read["viscous"]) == (5.5, 0.3 * 5.5)
    read = loadmat(tmp_path / "map.mat", simplify_cells=True)
    assert read["key"] == "vibration.velocity_amplitude"
    assert np.array_equal(read["value"], surface.values)
    assert (
        np.abs(read["laws"][1]["friction"] - surface.laws[1](surface.laws[1].velocity)).max()
        < 1e-12
    )
