"""What a case file of each kind begins with, and what is asked about it."""

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any, NamedTuple

from asperity.errors import InputError, nearest
from asperity.files import store
from asperity.files.shipped import shipped_cases
from asperity.tribometer.deposit import BEGUN_AUTHORS, BEGUN_TITLE

Values = dict[str, dict[str, Any]]


class Question(NamedTuple):
    """Something that is asked before a file is written.

    Attributes
    ----------
    path : str
        The ``table.key`` it fills, or ``ratio``.
    words : str
        What is asked.
    optional : bool
        Whether it is left out where nothing is answered.
    unless : str
        A ``table.key=value`` with which it is not asked.
    """

    path: str
    words: str
    optional: bool = False
    unless: str = ""

    def counts(self, values: Values) -> bool:
        """Return whether it is to be asked beside what is answered already."""
        path, _, text = self.unless.partition("=")
        table, _, key = path.partition(".")
        return not self.unless or str(values.get(table, {}).get(key)) != text


class Assumption(NamedTuple):
    """Something that a file begins with, that nobody is asked about and that no table knows.

    Attributes
    ----------
    mend : str
        What to do about it.
    instead : tuple of str
        Each a ``table.key``: where all of them are given it is left out.
    """

    mend: str
    instead: tuple[str, ...] = ()


class Kind(NamedTuple):
    """A kind of case file.

    Attributes
    ----------
    title : str
        First line of the file; ``{name}`` is the file's.
    values : mapping
        What it begins with, by table and key, as a file has it.
    questions : tuple of Question
        What is asked.
    tables : tuple of str
        Whose other keys stand in the file as comments.
    then : tuple of str
        Commands to go on with.
    case : str
        One that ships and whose values it begins with, beside `values`.
    follows : mapping
        What a ``table.key`` begins with once others are given: a text with their places in it.
    assumed : mapping
        What is said of a ``table.key`` that it begins with where nobody gives it.
    """

    title: str
    values: Mapping[str, Mapping[str, Any]]
    questions: tuple[Question, ...]
    tables: tuple[str, ...]
    then: tuple[str, ...]
    case: str = ""
    follows: Mapping[str, str] = MappingProxyType({})
    assumed: Mapping[str, Assumption] = MappingProxyType({})

    def begun(self) -> Values:
        """Return a copy of what it begins with."""
        values = {table: dict(keys) for table, keys in self.values.items()}
        if self.case:
            return store.read_toml(shipped_cases()[self.case]) | values
        return values


_BODY: Values = {
    "slider": {
        "drive_velocity": "0.5 mm/s",
        "normal_force": "55 N",
        "drive_stiffness": "96068 N/m",
        "mass": "0.5 kg",
    },
    "friction": {"model": "dahl", "mu": 0.1, "max_deflection": "68.75 nm", "law": "vector"},
    "vibration": {
        "frequency": "4 kHz",
        "velocity_ratio": 6.0,
        "direction": "0 deg",
        "start": "10 ms",
    },
}
_ASKED_OF_A_BODY = (
    Question("slider.drive_velocity", "velocity at which it is pulled"),
    Question("slider.normal_force", "force that presses it on its base"),
    Question("slider.mass", "its mass"),
    Question("slider.drive_stiffness", "stiffness of what pulls it"),
    Question("friction.mu", "coefficient of friction"),
    Question("friction.max_deflection", "deflection of the asperities at which it slides"),
    Question("vibration.frequency", "frequency of the vibration"),
    Question("vibration.velocity_ratio", "peak velocity of the vibration over that of the drive"),
    Question("vibration.direction", "its direction; 0 deg along the drive, 90 deg across"),
)

_GEARS: Values = {
    "gearset": {
        "name": "my worm gear",
        "worm_material": "case-hardened steel",
        "wheel_material": "CuSn12Ni2-C-GZ",
    },
    "operation": {
        "worm_speed": "1500 rpm",
        "output_torque": "300 N m",
        "life": "25000 h",
        "lubricant": "ISO VG 220 polyglycol",
    },
}
_ASKED_OF_GEARS = (
    Question("ratio", "ratio of the speeds"),
    Question("operation.output_torque", "rated torque of the wheel"),
    Question("operation.worm_speed", "speed of the worm"),
    Question("operation.life", "life that is required"),
    Question("gearset.wheel_material", "material of the wheel (asperity materials lists)"),
    Question("operation.lubricant", "lubricant (asperity lubricants lists)"),
)

KINDS: Mapping[str, Kind] = MappingProxyType(
    {
        "gear": Kind(
            "A worm gearset",
            {**_GEARS, "rating": {}},
            _ASKED_OF_GEARS,
            ("gearset", "operation", "rating"),
            ("rate", "sensitivity", "optimise", "flank"),
        ),
        "duty": Kind(
            "What a worm gearset has to do",
            {
                "requirements": {"ratio": 40, "ratio_tolerance": "3 %", "self_locking": "any"},
                "operation": {
                    key: value for key, value in _GEARS["operation"].items() if key != "life"
                },
                "spectrum": {"step": "", "duty": "S1"},
                "project": {"units": "si"},
            },
            (
                Question("requirements.ratio", "ratio of the speeds"),
                Question("requirements.ratio_tolerance", "by how much teeth may miss that ratio"),
                Question("requirements.self_locking", "self-locking: any, wanted or avoided"),
                *_ASKED_OF_GEARS[1:3],
                Question("spectrum.step", "loads of its life; more of them behind a semicolon"),
                Question("spectrum.duty", "S1, S2 15 min or S3 15 %"),
                Question(
                    "housing.iron",
                    "mass of iron and steel in the gearbox, as 12 kg: how warm it gets in its duty "
                    "goes by that",
                    optional=True,
                    unless="spectrum.duty=S1",
                ),
                Question(
                    "housing.aluminium",
                    "mass of aluminium in it",
                    optional=True,
                    unless="spectrum.duty=S1",
                ),
                _ASKED_OF_GEARS[-1],
                Question("project.units", "units that are shown: si or us"),
            ),
            ("requirements", "operation", "spectrum", "housing", "project", "gearset"),
            ("size",),
            follows=MappingProxyType(
                {
                    "spectrum.step": "{operation[output_torque]}, {operation[worm_speed]}, 25000 h",
                }
            ),
        ),
        "slide": Kind(
            "A body pulled over a vibrating base",
            {**_BODY, "solve": {"method": "periodic"}},
            _ASKED_OF_A_BODY,
            ("slider", "friction", "vibration", "solve"),
            ("slide", "sweep"),
        ),
        "block": Kind(
            "An elastic block pulled over a vibrating base",
            {
                **_BODY,
                "block": {
                    "size": ["30 mm", "20 mm", "10 mm"],
                    "youngs_modulus": "209 GPa",
                    "poissons_ratio": 0.3,
                    "elements": [4, 3, 2],
                    "element": "hex8i",
                },
                "solve": {"method": "settled"},
            },
            _ASKED_OF_A_BODY,
            ("slider", "friction", "vibration", "block", "contact", "solve"),
            ("block", "slide"),
        ),
        "drive": Kind(
            "A worm gearset that is loaded and shaken",
            {
                **_GEARS,
                "mount": {"backlash": "0.2 mm"},
                "friction": {"model": "dahl", "mu": 0.05, "max_deflection": "70 nm"},
                "drive": {
                    "load_inertia": "0.01 kg m**2",
                    "worm_inertia": "1e-5 kg m**2",
                    "worm_mass": "0.5 kg",
                    "contact_damping": "0.01 s/m",
                },
                "shaft": {"torsional_stiffness": "4000 N m/rad"},
                "vibration": {
                    "mode": "torsional",
                    "frequency": "20 kHz",
                    "displacement_amplitude": "10 um",
                },
            },
            (
                *_ASKED_OF_GEARS,
                Question("drive.load_inertia", "inertia of the wheel and of what it drives"),
                Question("drive.worm_inertia", "inertia of the worm and its shaft"),
                Question("friction.mu", "friction of the teeth (asperity rate tells it)"),
                Question("vibration.mode", "how it is shaken"),
                Question("vibration.frequency", "frequency of the vibration"),
                Question("vibration.displacement_amplitude", "its amplitude"),
            ),
            (
                "gearset",
                "mount",
                "operation",
                "friction",
                "drive",
                "shaft",
                "vibration",
                "actuator",
            ),
            ("drive", "directions", "locking", "rate"),
            assumed=MappingProxyType(
                {
                    "shaft.torsional_stiffness": Assumption(
                        "give that of your shaft, or shaft.diameter and shaft.span in its place; "
                        "deflection and resonances go by it",
                        ("shaft.diameter", "shaft.span"),
                    ),
                    "drive.worm_mass": Assumption("give that of your worm with its shaft"),
                    "friction.max_deflection": Assumption(
                        "give what your surfaces slide after, if it was measured"
                    ),
                    "drive.contact_damping": Assumption("give what was measured, if it was"),
                    "mount.backlash": Assumption("give the play of your gearset"),
                }
            ),
        ),
        "rig": Kind(
            "A disc-on-disc tribometer and what is to be tested on it",
            {
                # With these reports can be made, and packages as soon as they are replaced.
                "conditions": {"laboratory": "(your laboratory)", "operator": "(your name)"},
                "package": {
                    "title": BEGUN_TITLE,
                    "authors": list(BEGUN_AUTHORS),
                    "licence": "",
                },
            },
            (
                Question(
                    "rig.platform_mass", "mass of the platform that presses the discs together"
                ),
                Question("rig.dead_mass", "mass that is laid on it"),
                Question("steel_disc.diameter", "diameter of the steel disc"),
                Question("bronze_disc.diameter", "diameter of the bronze disc"),
                Question("steel_disc.thickness", "thickness of the steel disc"),
                Question("bronze_disc.thickness", "thickness of the bronze disc"),
                Question("lubricant.name", "lubricant"),
                Question("plan.repeats", "how often each cell of the plan is run"),
                Question("conditions.laboratory", "laboratory, for reports"),
                Question("conditions.operator", "who makes the tests"),
            ),
            (
                "rig",
                "steel_disc",
                "bronze_disc",
                "drives",
                "sonotrode",
                "channels",
                "lubricant",
                "limits",
                "plan",
                "reduction",
                "twin",
                "scope",
                "controller",
                "supplies",
                "guardian",
                "conditions",
                "package",
            ),
            ("rig plan", "rig run"),
            case="rig-final",
        ),
    }
)
"""By the name that ``asperity new`` takes."""

RATIO = "40"
"""Ratio of a gearset that nobody asked otherwise of."""


def kind_of(name: str) -> Kind:
    """Return a kind by its name; raises InputError where there is none."""
    if name not in KINDS:
        known = *KINDS, "bearing", "plastic"
        raise InputError(f"{name} is not a kind of case file{nearest(name, known)}")
    return KINDS[name]
