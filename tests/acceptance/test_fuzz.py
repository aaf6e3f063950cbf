"""Ten thousand inputs that are wrong in every way that could be thought of.

Each is a shipped case made small, with keys, bytes of its file, a file it names or the command
line changed at random. Whatever it is, the command answers, or says in one line what is wrong, and
says so before it takes a minute. The inputs are the same ones every time.
"""

import contextlib
import io
import json
import os
import random
import signal
import tomllib
import traceback
import warnings
from pathlib import Path
from typing import get_args

import pytest

from asperity.casefile import names_file
from asperity.cli import show
from asperity.cli.main import main
from asperity.commands import case_tables
from asperity.files.shipped import shipped_cases
from asperity.runs import run
from asperity.units import quantity_of, split_unit

pytestmark = pytest.mark.slow

ANSWERED, INTERRUPTED, USAGE, NOT_CONVERGED = 0, 130, 2, 3
LONGEST = 60.0  # seconds without a word, of this process, however busy the machine is
INPUTS = 100  # of each test
TESTS = 100

BODY = ["solve.duration=6 ms", "vibration.start=1 ms", "solve.step=1 us"]
BLOCK = [
    "block.elements=[2, 1, 1]", "block.element=hex8", "solve.duration=1.2 ms",
    "vibration.start=0.2 ms", "solve.step=2 us",
]  # fmt: skip
TEETH = [
    'drive.deflection=[["22 N m", "50 urad"], ["366 N m", "365 urad"]]',
    "drive.effective_radius=9.8 mm", "drive.tangential_compliance=2.9 nm/N",
    "solve.duration=3 ms",
]  # fmt: skip
DRIVE = ["drive", "shaft", "vibration", "friction", "operation", "actuator", "mount", "solve"]
RIG = [
    'plan.modes=["transverse"]', 'plan.lubricants=["oil"]', "plan.excluded=[]",
    'plan.waveforms=["sine"]', 'plan.steel_supplies=["1 V"]', "plan.repeats=1",
    'plan.frequencies=["750 Hz"]', "plan.before=0.5 s", "plan.shaken=0.5 s", "plan.idle=0.1 s",
    "plan.sample_rate=2 kHz",
]  # fmt: skip
# Command, cases, settings that make them small, how many inputs of a hundred.
COMMANDS = {
    "slide": (["table-4.3", "table-4.4", "table-4.1-L1", "table-4.1-L6"], BODY, 30),
    "check": (["table-4.3", "gearset-3", "normal-pin", "block-longitudinal"], [], 10),
    "new": (["gear", "slide", "block", "drive", "rig"], [], 2),
    "size": (["gearset-3"], [], 2),
    "compare": (["gearset-2", "gearset-3"], [], 2),
    "static": (["normal-pin", "table-4.4"], [], 2),
    "branches": (["normal-pin", "table-4.3"], [], 4),
    "rate": (["gearset-2", "gearset-3"], [], 24),
    "methods": (["gearset-2", "gearset-3"], [], 12),
    "sweep": (["table-4.3", "table-4.1-L2", "gearset-3"], BODY, 8),
    "export": (["block-longitudinal", "block-transverse"], BLOCK, 6),
    "sensitivity": (["gearset-2", "gearset-3"], [], 4),
    "block": (["block-longitudinal", "block-transverse"], BLOCK, 4),
    "flank": (["gearset-3", "gearset-3b"], [], 1),
    "drive": (["drive-screw", "drive-thesis", "drive-actuator"], TEETH, 4),
    "directions": (["drive-screw"], TEETH, 1),
    "locking": (["drive-actuator"], TEETH, 1),
    "control": (["drive-actuator"], [*TEETH, "drive.stroke=16 deg", "control.failures="], 2),
    "rig plan": (["rig-final"], [], 4),
    "rig run": (["rig-final"], RIG, 4),
}
ROOMS = {
    "check": ["slider", "friction", "vibration", "solve", "gearset", "operation", "rating"],
    "new": ["gearset", "operation", "rating", "slider", "friction", "vibration"],
    "size": ["gearset", "operation", "rating"],
    "compare": ["gearset", "operation", "rating"],
    "slide": ["slider", "friction", "vibration", "solve"],
    "static": ["slider", "friction", "vibration", "solve", "normal"],
    "branches": ["slider", "friction", "vibration", "solve", "normal"],
    "sweep": ["slider", "friction", "vibration", "solve"],
    "rate": ["gearset", "operation", "rating"],
    "sensitivity": ["gearset", "operation", "rating"],
    "methods": ["gearset", "operation", "rating", "vibration", "friction"],
    "block": ["slider", "friction", "vibration", "solve", "block", "contact"],
    "export": ["slider", "friction", "vibration", "solve", "block", "contact"],
    "flank": ["gearset", "hob", "disc", "modification", "mount", "blank", "measuring"],
    "drive": DRIVE,
    "directions": DRIVE,
    "locking": DRIVE,
    "control": [*DRIVE, "control", "control"],
    "rig plan": ["plan", "limits", "twin", "drives", "rig"],
    "rig run": ["plan", "limits", "twin", "drives", "rig", "sonotrode", "channels", "steel_disc"],
}
ODD = [
    "", " ", "0", "-0", "-1", "1e308", "1e-320", "1e400", "nan", "inf", "-inf", "9" * 4301,
    "0x" + "f" * 4000, "true", "auto", "split", "[]", "[1, 2]", "[[1], [2]]", "{ a = 1 }",
    "{ a.b.c = 1 }", "'" + "x" * 5000 + "'", '"a\\u0000b"', '"a\\u001b[2J"', '"a\\nb"',
    '"\\u202ea"', "=HYPERLINK(1)", "1979-05-27", "07:32:00", "1 kg", "1 m^9^9^9", "((((",
    "1 m" * 40, "\u03bc", "1 \u03bcm", "\udcff", "a\0b", "/dev/zero", ".", "nowhere.toml",
    "[1e999]", "\x1b", "1e9 1e9", "+.e3", "a" * 300,
]  # fmt: skip


class Announced(KeyboardInterrupt):
    """A work has been announced that takes more than a minute."""


class Silent(BaseException):
    """A minute has passed without a word."""


def magnitude(rng):
    """Return a number that is near one mostly, and anywhere that floats are at times."""
    exponent = rng.choice([rng.gauss(0, 0.3), rng.gauss(0, 3), rng.uniform(-330, 330)])
    sign = "-" if rng.random() < 0.1 else ""
    return f"{sign}{10 ** (exponent % 1):.4g}e{int(exponent // 1)}"


def changed_number(rng, text):
    parts = split_unit(text)
    if parts is None:
        return rng.choice(ODD)
    try:
        value = float(parts[0]) * float(magnitude(rng))
    except OverflowError:
        value = float("inf")
    return f"{value!r} {parts[1]}".strip()


def setting(rng, command, raw):
    tables = case_tables()
    name = rng.choice(ROOMS[command] if rng.random() < 0.95 else list(tables))
    model = tables[name]
    key = rng.choice(list(model.model_fields))
    if rng.random() < 0.5 and raw.get(name):
        key = rng.choice(list(raw[name]))
    quantity, annotation = quantity_of(model, key), model.model_fields[key].annotation
    old = raw.get(name, {}).get(key)
    words = [word for part in (annotation, *get_args(annotation)) for word in get_args(part)]
    chosen = rng.random()
    if chosen < 0.25:
        value = rng.choice(ODD)
    elif names_file(model, key):
        value = rng.choice(["broken.csv", "broken.toml", "/dev/zero", "."])
    elif quantity is not None:
        value = changed_number(rng, str(old or quantity.example))
    elif any(isinstance(word, str) for word in words) and chosen < 0.9:
        value = rng.choice([word for word in words if isinstance(word, str)])
    elif isinstance(old, int | float):
        value = str(type(old)(old * rng.choice([-1, 0, 0.5, 1, 2, 3])))
    else:
        value = rng.choice([*ODD, str(rng.randint(-2, 9)), magnitude(rng)])
    path = f"{name}.{key}" if rng.random() < 0.98 else rng.choice(["a.b", name, f"{name}.x.y", "="])
    return f"{path}={value}"


def broken(rng, content):
    """Return the bytes of a file with a few of them changed."""
    content = bytearray(content)
    for _ in range(rng.randint(1, 4)):
        at = rng.randrange(len(content)) if content else 0
        kind = rng.randrange(6)
        if kind == 0:
            content[at : at + 1] = bytes([rng.randrange(256)])
        elif kind == 1:
            del content[at : at + rng.randint(1, 30)]
        elif kind == 2:
            content[at:at] = rng.choice(ODD).encode(errors="surrogateescape")
        elif kind == 3:
            lines = bytes(content).split(b"\n")
            lines.insert(rng.randrange(len(lines)), rng.choice(lines))
            content = bytearray(b"\n".join(lines))
        elif kind == 4:
            digits = [n for n, byte in enumerate(content) if chr(byte).isdigit()] or [at]
            digit = rng.choice(digits)
            content[digit : digit + 1] = b"%d" % rng.randrange(10)
        else:
            content[at:at] = rng.choice([b"[x]\n", b"a.b.c = 1\n", b'"""', b"[[a]]", b"\xff", b"{"])
    return bytes(content)


def arguments(rng, folder):
    """Return a command line; what files it names are written to the folder."""
    command = rng.choices(list(COMMANDS), [weight for *_, weight in COMMANDS.values()])[0]
    cases, small, _ = COMMANDS[command]
    case = rng.choice(cases)
    gears = command == "sweep" and case == "gearset-3"
    small = [] if gears else small
    text = shipped_cases().get(case, shipped_cases()["gearset-3"]).read_bytes()
    raw = tomllib.loads(text.decode())
    given = [case]
    if command == "size":
        asked = {"ratio": "40", "output-torque": "300 N m", "worm-speed": "1500 rpm"}
        asked[rng.choice(list(asked))] = changed_number(rng, rng.choice(list(asked.values())))
        given = [part for name, value in asked.items() for part in (f"--{name}", value)]
        given += rng.choice([[], ["--rank", rng.choice(["margin", "x"])]])
    elif command == "new":
        given += [f"new-{rng.randrange(10**9)}.toml", "--defaults"]
        given += rng.choice([[], ["--ratio", changed_number(rng, "40")]])
    elif rng.random() < 0.35:
        Path(folder / "broken.toml").write_bytes(broken(rng, text))
        given = ["broken.toml"]
    given += ["gearset-3"] if command == "compare" else []
    given += [part for one in small for part in ("--set", one)]
    for _ in range(
        rng.choice([0, 1, 1, 1, 2, 3]) if given[0] == "broken.toml" else rng.randint(1, 3)
    ):
        given += ["--set", setting(rng, "rate" if gears else command, raw)]
    if command in ("sweep", "branches"):
        axes = [
            "friction.mu=0.1,0.2",
            "vibration.velocity_ratio=1:3:1",
            "friction.law=split,vector",
        ]
        if gears:
            axes = [
                "gearset.diameter_factor=7:10:1",
                "operation.output_torque=100,300 N m",
                "gearset.wheel_material=CuSn12-C-GZ,CuSn12Ni2-C-GZ",
            ]
        axis = rng.choice(axes)
        if rng.random() < 0.5:
            axis = (
                axis.partition("=")[0] + "=" + rng.choice([*ODD, "1:2", "1:2:0", "1:1e9:1", ",,"])
            )
        given += ["--over", axis]
        if command == "sweep" and rng.random() < 0.2:
            tables = ["drive-thesis", "broken.csv", "/dev/zero", "nowhere.csv"]
            given += ["--points", rng.choice(tables)]
    if command == "export":
        given += ["--to", rng.choice(["abaqus", "calculix", "csv", "x"]), "--out", "out"]
    if command == "rate":
        given += ["--standard", rng.choice(["all", "iso14521", "bs721", "agma6034", "iso"])]
    if command == "methods":
        also = ["literature", "broken.csv", "broken.toml", "/dev/zero", "nowhere.toml"]
        given += rng.choice([[], ["--also", rng.choice(also)]])
    if command == "flank":
        given += ["--density", rng.choice(["coarse", "3 mm", "0", "x"])]
    if rng.random() < 0.7:
        given.append("--json")
    if rng.random() < 0.01:
        given.insert(rng.randrange(len(given)), rng.choice(["--x", "--out", "", "--set", *ODD]))
    if command == "rig run":
        given += ["--out", f"run-{rng.randrange(10**9)}"]
    return [*command.split(), *given]


def trouble(given):
    """Run a command line; returns what is wrong with how it ended, nothing if it ended well."""
    output, errors = io.StringIO(), io.StringIO()
    code = None
    with (
        contextlib.redirect_stdout(output),
        contextlib.redirect_stderr(errors),
        warnings.catch_warnings(),
    ):
        warnings.simplefilter("error")
        try:
            main(given)
        except SystemExit as end:
            code = end.code
        except Silent:
            return "a minute without a word"
        except BaseException:
            return traceback.format_exc()
    lines = errors.getvalue().splitlines()
    if code == INTERRUPTED:
        return ""
    if code not in (ANSWERED, USAGE, NOT_CONVERGED):
        return f"ended with {code}: {lines}"
    if code != ANSWERED and not lines:
        return f"ended with {code} and not a word"
    if code == USAGE and (len(lines) > 1 or not lines[0].isprintable()):
        return f"more than a line: {lines}"
    if code == ANSWERED and "--json" in given:
        try:
            json.loads(output.getvalue(), parse_constant=lambda name: 1 / 0)
        except (ValueError, ZeroDivisionError):
            return f"not a JSON object: {output.getvalue()[:200]}"
    return ""


@pytest.fixture(scope="module")
def _compiled():
    """Compile the kernels, which once takes a while, before the clock runs."""
    for command in ("slide", "methods", "block", "flank"):
        (case, *_), small, _ = COMMANDS[command]
        settings = [part for one in small for part in ("--set", one)]
        assert not trouble([command, case, *settings, "--json"])


@pytest.fixture
def watched(monkeypatch, new_user, tmp_path, _compiled):
    """A folder to work in; a word about a long work ends it, a minute without one as well."""
    for name, value in new_user().items():
        monkeypatch.setenv(name, value)
    monkeypatch.chdir(tmp_path)

    def note(line):
        if "take about" in line:
            raise Announced
        show_note(line)

    def silent(*_):
        raise Silent

    show_note = show.note
    monkeypatch.setattr(show, "note", note)
    monkeypatch.setattr(run, "_LOOK_SECONDS", 0.3)
    before = signal.signal(signal.SIGPROF, silent)
    yield tmp_path
    signal.setitimer(signal.ITIMER_PROF, 0)
    signal.signal(signal.SIGPROF, before)


@pytest.mark.skipif(os.name != "posix", reason="an alarm tells of a minute without a word")
@pytest.mark.campaign(over="part")
@pytest.mark.parametrize("part", range(TESTS))
def test_no_input_ends_in_a_traceback_or_takes_a_minute_without_a_word(watched, part):
    rng = random.Random(part)
    wrong = []
    (watched / "broken.csv").write_bytes(b"0,0\n1,nan\n")
    for _ in range(INPUTS):
        given = arguments(rng, watched)
        signal.setitimer(signal.ITIMER_PROF, LONGEST)
        if found := trouble(given):
            wrong.append(f"asperity {given}\n{found}")
        signal.setitimer(signal.ITIMER_PROF, 0)
    assert not wrong, "\n\n".join(wrong)


GEARBOX = {
    "rate": ("actuator-duty", ["spectrum", "housing", "requirements", "tolerances"]),
    "shafts": ("actuator-shafts", ["worm_shaft", "wheel_shaft", "bearings", "spectrum"]),
}
"""Commands with their cases and the tables of a whole gearbox."""


def inline(value):
    """Return a value as TOML in a line."""
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key} = {inline(part)}" for key, part in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(inline, value)) + "]"
    return json.dumps(value)


def leaf_changed(rng, value):
    """Return a value, with one of the numbers and words within it changed."""
    if isinstance(value, dict) and value:
        key = rng.choice(list(value))
        if rng.random() < 0.1:
            return {name: part for name, part in value.items() if name != key}
        return {**value, key: leaf_changed(rng, value[key])}
    if isinstance(value, list) and value:
        at = rng.randrange(len(value))
        if rng.random() < 0.1:
            return [*value, value[at]] if rng.random() < 0.5 else value[:at] + value[at + 1 :]
        return [*value[:at], leaf_changed(rng, value[at]), *value[at + 1 :]]
    if rng.random() < 0.3:
        return rng.choice([word for word in ODD if word.isprintable()])
    return changed_number(rng, str(value))


def of_gearbox(rng, command):
    """Return a command line over the tables of a gearbox, one to three settings of it wrong."""
    case, tables = GEARBOX[command]
    raw = tomllib.loads(shipped_cases()[case].read_text("utf-8"))
    given = [case]
    for _ in range(rng.choice([1, 1, 1, 2, 3])):
        name = rng.choice(tables)
        nested = [key for key, part in raw.get(name, {}).items() if isinstance(part, list)]
        if nested and rng.random() < 0.6:
            key = rng.choice(nested)
            changed = inline(leaf_changed(rng, raw[name][key]))
            given += ["--set", f"{name}.{key}={changed}"]
        else:
            given += ["--set", flat_setting(rng, name, raw)]
    return [command, *given, "--json"]


def flat_setting(rng, name, raw):
    """Return a setting of a key of one table."""
    model = case_tables()[name]
    key = rng.choice(list(model.model_fields))
    quantity = quantity_of(model, key)
    old = raw.get(name, {}).get(key)
    value = rng.choice(ODD)
    if quantity is not None and rng.random() < 0.7:
        value = changed_number(rng, str(old or quantity.example))
    return f"{name}.{key}={value}"


@pytest.mark.skipif(os.name != "posix", reason="an alarm tells of a minute without a word")
@pytest.mark.campaign(over="part")
@pytest.mark.parametrize("part", range(10))
def test_no_table_of_a_gearbox_ends_in_a_traceback(watched, part):
    rng = random.Random(f"gearbox {part}")
    wrong = []
    for _ in range(INPUTS):
        given = of_gearbox(rng, rng.choice(list(GEARBOX)))
        signal.setitimer(signal.ITIMER_PROF, LONGEST)
        if found := trouble(given):
            wrong.append(f"asperity {given}\n{found}")
        signal.setitimer(signal.ITIMER_PROF, 0)
    assert not wrong, "\n\n".join(wrong)
