"""The commands of the tribometer, in the order of the help."""

from asperity.commands.command import Argument, Command, Option

_ASTM = ("G99", "G133")
_COLUMNS = (
    Option("rate", "Samples a second, where the file tells no times: 20 kHz.", "RATE"),
    Option("columns", "Headings of all columns, where it has none: time,A,B.", "NAMES"),
    Option("units", "Units of all columns, where it tells none: s,V,mV.", "UNITS"),
)
_RECORDINGS = Argument("recordings", "REC...", "Recordings of a rig.", many=True)
_RIG = Option("config", "The rig's configuration; left out: the one in each recording.", "CONFIG")

RIG_COMMANDS = (
    Command(
        "rig plan",
        "Lay out a series of tests: cells, files, order, time, and what it will not tell.",
        "With --out also report.html, plan.json, plan.nc and plan.png.",
        module="asperity.tribometer.plan.study",
        needs=("rig", "plan"),
        case="CONFIG",
    ),
    Command(
        "rig run",
        "Carry out a plan by the procedure, on instruments or on the simulated rig.",
        "Needs --out: the folder of its recordings and of journal.jsonl, from which --resume goes "
        "on. Also writes run.json, run.nc and run.png.",
        module="asperity.tribometer.procedure.study",
        counts="cells",
        needs=("rig", "steel_disc", "bronze_disc", "drives", "channels", "plan"),
        case="CONFIG",
        options=(
            # From a page nothing is moved that somebody's hands may be in.
            Option(
                "backend",
                "sim, replay, hardware or manual.",
                "NAME",
                default="sim",
                elsewhere=("sim", "replay"),
                choices=("sim", "replay", "hardware", "manual"),
            ),
            Option("recordings", "The folder of the run that a replay plays.", "DIR"),
            Option("resume", "Go on with the run in --out, at its cell.", default=False),
            Option(
                "acknowledge",
                "Who has looked at the rig after an interlock latched, and what was done.",
                "TEXT",
                elsewhere=(),
            ),
        ),
    ),
    Command(
        "rig look",
        "Tell what is understood of a file before it is imported: columns, units, times.",
        "With --out also report.html, look.json, look.nc and look.png.",
        module="asperity.tribometer.importing.look",
        read="asperity.tribometer.importing.look:read",
        arguments=(Argument("files", "FILE...", "Of one recording.", many=True),),
        case="",
        options=_COLUMNS,
    ),
    Command(
        "rig import",
        "Make a recording of an oscilloscope's or logger's file: text, .mat, TDMS, WAV and more.",
        "Without --out the file is looked at only; --look FILE tells what is understood of it, as "
        "asperity rig look FILE does.",
        module="asperity.tribometer.importing.study",
        arguments=(Argument("file", "FILE", "What the instrument or its program exported."),),
        options=(
            Option(
                "join", "Another file of the same recording; again for each.", "FILE", many=True
            ),
            *_COLUMNS,
            Option(
                "start", "When it began, where the file does not say: 2026-05-01 14:30.", "DATE"
            ),
        ),
        needs=("rig", "steel_disc", "bronze_disc", "drives", "channels"),
        case="CONFIG",
        draws=False,
        out="REC.nc",
    ),
    Command(
        "rig check",
        "Check what recordings say of their own sensors: zeros, signs, ratios, drive, tones.",
        "With --out also report.html, check.json, check.nc and check.png, a small picture of each "
        "finding.",
        module="asperity.tribometer.checking",
        read="asperity.tribometer.checking:read",
        counts="recordings",
        arguments=(_RECORDINGS,),
        case="",
        options=(_RIG,),
    ),
    Command(
        "rig reduce",
        "Reduce recordings: what vibration does to torque, power and efficiency.",
        "With --out also report.html, reduce.json, reduce.nc, reduce.csv, measurements.csv, which "
        "asperity fit takes, budget.csv and reduce.png.",
        module="asperity.tribometer.reduction.study",
        read="asperity.tribometer.reduction.study:read",
        counts="recordings",
        arguments=(_RECORDINGS,),
        case="",
        options=(
            _RIG,
            Option("budget", "Tell what every number is uncertain by (GUM).", default=False),
        ),
    ),
    Command(
        "rig report",
        "Put the recordings of a folder on one page: cells, pictures, what was left out.",
        "Writes report.html, reduce.json, reduce.nc and tables (.csv) into DIR, or into --out.",
        module="asperity.tribometer.report.study",
        read="asperity.tribometer.report.study:read",
        counts="recordings",
        arguments=(Argument("folder", "DIR", "A folder of recordings."),),
        case="",
        options=(
            Option(
                "standard",
                "With the headings of ASTM G99 or G133 as well: G99, G133.",
                "NAME",
                choices=_ASTM,
            ),
            Option("config", "A case with [conditions], in place of the recordings'.", "CASE"),
        ),
        draws=False,
        into="folder",
    ),
    Command(
        "rig package",
        "Put a folder of recordings together for a repository: data, results, metadata, licence.",
        "Needs --out: a new or empty folder for recordings, journal, results, datacite.json, "
        "ro-crate-metadata.json and check sums.",
        module="asperity.tribometer.package.study",
        read="asperity.tribometer.report.study:read",
        counts="recordings",
        arguments=(Argument("folder", "DIR", "A folder of recordings."),),
        case="",
        options=(
            Option(
                "config",
                "A case with [package] (title, authors, licence) and [conditions].",
                "CASE",
            ),
            Option(
                "standard",
                "Report with the headings of ASTM G99 or G133.",
                "NAME",
                choices=_ASTM,
            ),
            Option("archive", "Write one file, package.zip, in place of many.", default=False),
        ),
        draws=False,
    ),
)
"""Their names have ``rig`` in common."""
