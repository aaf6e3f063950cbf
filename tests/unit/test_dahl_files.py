"""Dahl's law as other programs take it, step by step: C compiled and MATLAB against the package.

MATLAB's text is run by Octave where there is one. Elsewhere, and beside it, `translated` reads it:
each line becomes the line of Python that says the same, and a line that it does not know fails.
That checks the arithmetic and the structure, not a compiler of MathWorks.
"""

import ctypes
import math
import re
import shutil
import subprocess

import numpy as np
import pytest
from apparatus.grid import grid, slow

from asperity.errors import InputError
from asperity.friction import KEEPS, VECTOR, Friction, advance_loaded
from asperity.slider import Model, Slider
from asperity.slider.dahl_files import dahl_files

pytestmark = pytest.mark.usefixtures("plain_kernels")

COMPILER = shutil.which("cc") or shutil.which("gcc")
OCTAVE = shutil.which("octave-cli") or shutil.which("octave")
STRICT = ["-std=c99", "-pedantic", "-Wall", "-Wextra", "-Werror", "-O2", "-shared", "-fPIC"]
compiled = pytest.mark.skipif(COMPILER is None, reason="there is no C compiler here")
EXPONENTS = 0.0, 1.0 / 3.0, 1.0, 1.5, 2.0, 4.0
POWERS = 1.0, 2.0 / 3.0
KINDS = grid(
    EXPONENTS,
    [*KEEPS],
    POWERS,
    ordinary=[
        (exponent, [*KEEPS][n % 2], POWERS[n // 2 % 2]) for n, exponent in enumerate(EXPONENTS)
    ],
)


def body(exponent=1.0, keeps="stiffness", power=1.0, **friction):
    from asperity.normal import Normal

    given = {"mu": 0.13, "max_deflection": "68.75 nm", "exponent": exponent, "keeps": keeps}
    law = Friction(**(given | friction), load_exponent=power)
    slider = Slider(
        drive_velocity="0.5 mm/s", normal_force="55 N", mass="0.5 kg", drive_stiffness="96068 N/m"
    )
    normal = Normal(law="linear", stiffness="100 MN/m") if power != 1.0 else None
    return Model(slider, law, normal=normal)


def history(seed, steps):
    """Slips from a thousandth of the deflection to hundreds of it, loads to 0 and back.

    Of loads some stand, some fall by little or by much, some are below zero; slips turn at random,
    and now and then go on straight, back or not at all.
    """
    rng = np.random.default_rng(seed)
    size = 68.75e-9 * 10.0 ** rng.uniform(-3.0, 2.5, steps)
    angle = rng.uniform(0.0, 2.0 * math.pi, steps)
    kind = rng.integers(0, 6, steps)
    for n in range(1, steps):
        if kind[n] == 0:
            angle[n] = angle[n - 1]
        elif kind[n] == 1:
            angle[n] = angle[n - 1] + math.pi
    size[kind == 2] = 0.0
    dt = 10.0 ** rng.uniform(-7.0, -3.0, steps)
    velocity = (size / dt)[:, None] * np.column_stack([np.cos(angle), np.sin(angle)])
    load = 55.0 * rng.uniform(0.05, 2.0, steps)
    which = rng.integers(0, 8, steps)
    for n in range(1, steps):
        if which[n] in (0, 1):
            load[n] = load[n - 1]
        elif which[n] in (2, 3):
            load[n] = load[n - 1] * rng.uniform(0.9, 1.0)
        elif which[n] == 4:
            load[n] = -1.0
    return velocity, load, dt


def ours(model, velocity, load, dt):
    """Deflections in m and forces in N as the package has them."""
    friction = model.friction
    length, full, at = friction.max_deflection, model.full_friction, model.slider.normal_force
    sx = sy = 0.0
    before = 1.0
    found = []
    for (vx, vy), newtons, step in zip(velocity, load, dt, strict=True):
        after = (max(newtons, 0.0) / at) ** friction.load_exponent
        sx, sy, fx, fy = advance_loaded(
            sx, sy, vx * step / length, vy * step / length, 0.0, 0.0, before, after,
            friction.exponent, VECTOR, friction.keeps_code,
        )  # fmt: skip
        before = after
        found.append((length * sx, length * sy, full * fx, full * fy))
    return np.array(found)


def marched(step, velocity, load, dt):
    state, found = [0.0, 0.0, 55.0], []
    for pair, newtons, length in zip(velocity.tolist(), load.tolist(), dt.tolist(), strict=True):
        state, force = step(state, pair, newtons, length)
        assert state[2] == max(newtons, 0.0)
        found.append((state[0], state[1], force[0], force[1]))
    return np.array(found)


def agree(theirs, exact):
    """Whether all is the same to 1e-12 of the largest deflection and force."""
    assert np.isfinite(theirs).all()
    scale = np.abs(exact).max(axis=0)
    assert (scale > 0.0).all()
    np.testing.assert_array_less(np.abs(theirs - exact) / scale, 1e-12)


def in_c(model, folder, about=("a case",)):
    """The function, compiled without a word of the compiler; next is state itself."""
    for name, text in dahl_files(model, about).items():
        (folder / name).write_text(text)
    call = [COMPILER, *STRICT, "asperity_dahl.c", "-o", "dahl.so", "-lm"]
    subprocess.run(call, cwd=folder, check=True)
    function = ctypes.CDLL(str(folder / "dahl.so")).asperity_dahl
    function.restype = None
    three, two = ctypes.c_double * 3, ctypes.c_double * 2
    function.argtypes = [three, two, ctypes.c_double, ctypes.c_double, three, two]

    def step(state, velocity, load, dt):
        both, force = three(*state), two()
        function(both, two(*velocity), load, dt, both, force)
        return list(both), list(force)

    return step


LINES = [
    (r"function (\w+) = (\w+)\((.*)\)", r"def \2(\3):"),
    (r"function \[(.*)\] = (\w+)\((.*)\)", r"def \2(\3):"),
    (r"if (.*)", r"if \1:"),
    (r"elseif (.*)", r"elif \1:"),
    (r"else", r"else:"),
    (r"\[(.*)\] = (.*);", r"\1 = \2"),
    (r"(\w+(?:\(\d\))?) = (.*);", r"\1 = \2"),
]


def translated(text):
    """MATLAB's text as the Python that says the same, line by line; unknown lines fail."""
    lines, depth, gives = [], 0, ""
    for line in text.splitlines():
        code = line.partition("%")[0].strip()
        if not code:
            continue
        if code == "end":
            depth -= 1
            if depth == 0:
                lines.append(f"    return {gives}")
            continue
        for pattern, python in LINES:
            if re.fullmatch(pattern, code):
                said = re.sub(f"^{pattern}$", python, code)
                break
        else:
            raise AssertionError(f"a line that is not known: {line}")
        if code.startswith("function"):
            assert depth == 0
            gives = re.match(r"function \[?([\w, ]+?)\]? =", code)[1]
        indent = depth - code.startswith("else")
        said = said.replace("^", "**").replace("&&", "and").replace("||", "or")
        said = re.sub(r"\b(state|velocity|next|force)\((\d)\)", r"\1[\2 - 1]", said)
        lines.append("    " * indent + said)
        depth += code.startswith(("function", "if "))
    assert depth == 0
    return "\n".join(lines)


def in_matlab(model):
    names = {"zeros": lambda rows, _: [0.0] * rows, "sqrt": math.sqrt, "exp": math.exp}
    names |= {"expm1": math.expm1, "abs": abs, "max": max, "min": min}
    names["__builtins__"] = {}
    exec(translated(dahl_files(model, ["a case"])["asperity_dahl.m"]), names)
    return names["asperity_dahl"]


@pytest.mark.ordinary(1)
@compiled
@pytest.mark.parametrize(("exponent", "keeps", "power"), KINDS)
def test_the_law_in_c_is_the_law_of_the_package(exponent, keeps, power, tmp_path):
    model = body(exponent, keeps, power)
    step = in_c(model, tmp_path)
    for seed in range(4):
        past = history(seed, 2000)
        agree(marched(step, *past), ours(model, *past))


@pytest.mark.parametrize(("exponent", "keeps", "power"), KINDS)
def test_the_lines_for_matlab_say_the_law_of_the_package(exponent, keeps, power):
    model = body(exponent, keeps, power)
    step = in_matlab(model)
    for seed in range(4):
        past = history(seed, 500)
        agree(marched(step, *past), ours(model, *past))


@pytest.mark.ordinary(1)
@compiled
@pytest.mark.parametrize("exponent", [0.0, slow(0.5), slow(1.0), 2.0])
def test_from_any_state_a_step_is_that_of_the_package(exponent, tmp_path):
    """Also from a deflection above the limit, which no history of Dahl's comes to."""
    model = body(exponent)
    steps = in_c(model, tmp_path), in_matlab(model)
    rng = np.random.default_rng(11)
    above = 0
    for _ in range(2000):
        size, before, after = rng.uniform(0.1, 2.0, 3)
        start, end = rng.uniform(0.0, 2.0 * math.pi, 2)
        size *= before
        slip = 10.0 ** rng.uniform(-2.0, 1.0)
        s = size * math.cos(start), size * math.sin(start)
        d = slip * math.cos(end), slip * math.sin(end)
        above += size > before > after
        exact = advance_loaded(
            *s, *d, 0.0, 0.0, before, after, exponent, VECTOR, KEEPS["stiffness"]
        )
        length = 68.75e-9
        state, velocity = (
            [length * s[0], length * s[1], 55.0 * before],
            [length * d[0], length * d[1]],
        )
        for step in steps:
            found, force = step(state, velocity, 55.0 * after, 1.0)
            again = [found[0] / length, found[1] / length, force[0] / 7.15, force[1] / 7.15]
            np.testing.assert_allclose(again, exact, rtol=0.0, atol=2e-12)
    assert above > 300


@pytest.mark.skipif(OCTAVE is None, reason="there is no Octave here")
@pytest.mark.parametrize("exponent", [0.0, 1.0, 1.5])
def test_the_law_in_octave_is_the_law_of_the_package(exponent, tmp_path):
    model = body(exponent)
    velocity, load, dt = history(1, 300)
    (tmp_path / "asperity_dahl.m").write_text(dahl_files(model, ["a case"])["asperity_dahl.m"])
    np.savetxt(tmp_path / "in.txt", np.column_stack([velocity, load, dt]), fmt="%.17g")
    (tmp_path / "go.m").write_text(
        "a = load('in.txt'); s = [0; 0; 55]; b = zeros(rows(a), 4);\n"
        "for n = 1:rows(a)\n"
        "  [s, f] = asperity_dahl(s, a(n, 1:2)', a(n, 3), a(n, 4)); b(n, :) = [s(1:2)', f'];\n"
        "end\n"
        "file = fopen('out.txt', 'w'); fprintf(file, '%.17g %.17g %.17g %.17g\\n', b');\n"
        "fclose(file);\n"
    )
    subprocess.run([OCTAVE, "--norc", "go.m"], cwd=tmp_path, check=True)
    agree(np.loadtxt(tmp_path / "out.txt"), ours(model, velocity, load, dt))


def test_from_rest_the_force_rises_as_dahl_wrote_it():
    step = in_matlab(body())
    for slip in (1e-9, 68.75e-9, 1e-6):
        state, force = step([0.0, 0.0, 55.0], [slip / 1e-6, 0.0], 55.0, 1e-6)
        assert force[0] == pytest.approx(0.13 * 55.0 * -math.expm1(-slip / 68.75e-9), rel=1e-14)
        assert (state[1], force[1]) == (0.0, 0.0)


def test_a_step_in_two_halves_is_the_step():
    step = in_matlab(body(exponent=1.5))
    state, velocity = [3e-8, -4e-8, 55.0], [0.02, 0.03]
    whole, _ = step(state, velocity, 55.0, 2e-6)
    half, _ = step(state, velocity, 55.0, 1e-6)
    assert step(half, velocity, 55.0, 1e-6)[0] == pytest.approx(whole, rel=1e-13)


def test_a_stiffness_is_written_as_the_deflection_it_gives(tmp_path):
    stiff = body(max_deflection=None, tangential_stiffness="104 MN/m")
    past = history(3, 50)
    agree(marched(in_matlab(stiff), *past), ours(body(), *past))


@compiled
def test_a_comment_cannot_be_left_by_the_name_of_a_case(tmp_path):
    about = ["*/ int main = 1; /*", "a\n#error", "??/", "a\\", "@length@", "a\nend"]
    in_c(body(), tmp_path, about)
    translated(dahl_files(body(), about)["asperity_dahl.m"])


def test_a_share_of_the_vibration_that_reaches_the_contact_is_told():
    files = dahl_files(body(transfer=0.71), [])
    assert all("friction.transfer = 0.71" in text for text in files.values())
    assert not any("transfer" in text for text in dahl_files(body(), []).values())


def test_other_laws_are_refused_in_one_line():
    with pytest.raises(InputError, match=r"^friction.law is 'split'; .* set friction.law to"):
        dahl_files(body(law="split"), [])
    with pytest.raises(InputError, match=r"^friction.model is 'coulomb'; .* 'dahl'"):
        dahl_files(body(model="coulomb", keeps="deflection"), [])
