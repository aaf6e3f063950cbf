"""The commands, in the order of the help."""

from asperity.commands.command import Addition, Argument, Command, Option
from asperity.commands.of_rig import RIG_COMMANDS

_AN_AXIS = "An axis: 1,2,3 or start:stop:step, with units; again for another axis."

GROUPS = {"rig": "A disc-on-disc tribometer: plan, procedure, recordings and their reduction."}
"""Commands that have a name in common, and what they are about."""

COMMANDS = (
    Command(
        "slide",
        "Pull a body over a vibrating base: drive force, friction, power.",
        "With --out also report.html, slide.nc, slide.png and slide.json.",
        module="asperity.slider.slide",
        needs=("slider", "friction"),
        counts="steps",
    ),
    Command(
        "static",
        "Pull a body on a vibrating base steadily: the largest force under which it holds.",
        "The drive is left out; the body needs slider.mass. With --out also report.html, "
        "static.json, static.nc and static.png.",
        module="asperity.slider.static",
        needs=("slider", "friction"),
        counts="pulls",
    ),
    Command(
        "block",
        "Pull an elastic block over a vibrating base: the same by finite elements.",
        "With --out also report.html, block.nc, block.png, block_pressure.png, block.json and "
        "block.pvd, an animation for ParaView.",
        module="asperity.block.solve",
        needs=("slider", "friction", "block"),
        counts="increments",
    ),
    Command(
        "sweep",
        "Solve a case over a grid of values; what is done is kept, and found by the next run.",
        "With --out also report.html, sweep.nc, sweep.json and, for one or two axes, sweep.png.",
        module="asperity.sweep.run",
        needs=("slider", "friction"),
        either=("gearset",),
        read="asperity.sweep.axes:read_first",
        counts="points",
        options=(
            Option("over", _AN_AXIS, "TABLE.KEY=VALUES", many=True, one_of="axes"),
            Option(
                "points",
                "Values that change together, a row a point, under headings table.key [unit].",
                "POINTS.csv",
                one_of="axes",
            ),
            Option(
                "cluster",
                "A Dask scheduler to send the work to, instead of this machine's cores.",
                "ADDRESS",
                elsewhere=(),
            ),
        ),
    ),
    Command(
        "branches",
        "Follow a body's periodic state along one axis and back: where it has two.",
        "With --out also report.html, branches.json, branches.nc and branches.png.",
        module="asperity.sweep.branches",
        needs=("slider", "friction"),
        read="asperity.sweep.axes:read_first",
        counts="states",
        options=(
            Option(
                "over",
                "The axis: 1,2,3 or start:stop:step, with units.",
                "TABLE.KEY=VALUES",
                default=None,
                many=True,
            ),
        ),
    ),
    Command(
        "rate",
        "Rate a worm gearset: friction, efficiency, losses, load capacity, self-locking.",
        "With --out also report.html, rate.json, rate.nc, rate.csv and rate.xlsx, a workbook of "
        "live formulas.",
        module="asperity.rating.rate_command",
        additions=(
            Addition("asperity.shafts.study:beside_rating", tables=("worm_shaft", "wheel_shaft")),
            Addition("asperity.flanks.study.rated_play:beside_rating", tables=("tolerances",)),
            Addition("asperity.flanks.study.pattern:beside_rating", option="pattern"),
        ),
        brief=True,
        needs=("gearset", "operation"),
        draws=False,
        options=(
            Option(
                "standard",
                "iso14521, bs721, agma6034 or all.",
                "NAME",
                default="all",
                choices=("iso14521", "bs721", "agma6034", "all"),
            ),
            Option(
                "pattern",
                "Show contact pattern and lines in the report of --out: cuts the flanks.",
                default=False,
            ),
        ),
    ),
    Command(
        "shafts",
        "Shafts and bearings of a worm gearset: reactions, deflection, strength, lives.",
        "By DIN 743, ISO 281, ISO 76. --out: report.html and shafts.json, .nc, .png, .xlsx (live).",
        module="asperity.shafts.study",
        needs=("gearset", "operation"),
    ),
    Command(
        "sensitivity",
        "Raise each input of a worm gearset alone, to 40 %, and follow its efficiency.",
        "With --out also report.html, sensitivity.nc, sensitivity.png and sensitivity.json.",
        module="asperity.studies.sensitivity",
        needs=("gearset", "operation"),
    ),
    Command(
        "methods",
        "Compare oils, additives, coatings and vibration by a worm gearset's efficiency.",
        "The vibration is that of the case's [vibration], with the law of [friction]. With --out "
        "also report.html, methods.nc, methods.png and methods.json.",
        module="asperity.studies.methods",
        options=(
            Option(
                "also",
                "More ways: literature, for what else chapter 2 of the thesis reports, or a file "
                "of your own; again for another.",
                "NAME",
                many=True,
            ),
        ),
        needs=("gearset", "operation"),
    ),
    Command(
        "optimise",
        "Find a worm gearset's most efficient design that keeps its load capacity.",
        "Pressure angle, diameter factor, module and roughness are free; every safety that "
        "holds goes on to. Also what a higher permissible torque costs. With --over the flanks "
        "under load, as relief finds them. With --out also report.html, optimise.nc, "
        "optimise.png and optimise.json, or those of relief.",
        module="asperity.drive.studies.optimum",
        counts="points",
        options=(
            Option(
                "free",
                "What may change: pressure_angle, diameter_factor, axial_module, "
                "worm_roughness; all if left out.",
                "NAME,NAME",
            ),
            Option(
                "bounds",
                "How far, as pressure_angle='20:25 deg'; again for another.",
                "NAME=LOW:HIGH",
                many=True,
            ),
            Option(
                "keep",
                "A safety that may not fall, as S_delta, agma6034 or all; again for another.",
                "SAFETY",
                many=True,
            ),
            Option(
                "over",
                "In their place a key of modification, hob or disc, as "
                "modification.tip_relief=0,20,40 um: against forces on edges, pressure and error "
                "of the loaded flanks, and half-way between; again for another.",
                "TABLE.KEY=VALUES",
                many=True,
            ),
            Option(
                "at",
                "With --over: loads and mountings to bear with, as for relief; again for another.",
                "TABLE.KEY=VALUES",
                many=True,
            ),
        ),
        needs=("gearset", "operation"),
    ),
    Command(
        "flank",
        "Cut a worm wheel exactly: its contact, transmission error, backlash and mesh.",
        "With --out also report.html, flank.json, flank.nc, pictures, tooth and worm as mesh and "
        "surface, and gearset.glb, both turning.",
        module="asperity.flanks.study.flank",
        needs=("gearset",),
        options=(
            Option(
                "density",
                "Of the mesh: coarse, intermediate, fine, or an element size as '0.5 mm'.",
                "SIZE",
                default="intermediate",
            ),
            Option("step", "Also write worm, wheel and both in mesh as STEP.", default=False),
            Option("dxf", "Also write a drawing with dimensions and data as DXF.", default=False),
        ),
    ),
    Command(
        "crossed",
        "Take a worm with a helical wheel in place of its own: geometry, sliding, pressure.",
        "Such wheels are moulded of plastics; their strength is not rated. With --out also "
        "report.html, crossed.json and crossed.nc.",
        module="asperity.rating.crossed",
        needs=("gearset",),
        draws=False,
    ),
    Command(
        "rexs",
        "Write a worm gearset in the exchange format of gearbox programs, REXS.",
        "It is of version 1.5; asperity new gear --from reads such files, of any version.",
        module="asperity.flanks.export.rexs.export",
        needs=("gearset",),
        draws=False,
        out="GEARSET.rexs",
    ),
    Command(
        "drive",
        "Load a worm gearset, and shake it: torque, powers, contact lost, what it is worth.",
        "With --out also report.html, drive.json, drive.nc and pictures.",
        module="asperity.drive.solve",
        needs=("gearset", "operation", "drive"),
        counts="cycles",
        options=(Option("static", "Leave the vibration out.", default=False),),
    ),
    Command(
        "misalign",
        "Load a worm gearset wherever its mounting may bring it: pressures, edges, error.",
        "Without --over at corners, sides and middle of the case's [tolerances]. With --out also "
        "report.html, misalign.json, misalign.nc and pictures.",
        module="asperity.drive.studies.misalign",
        needs=("gearset", "operation", "drive"),
        counts="points",
        options=(Option("over", _AN_AXIS, "TABLE.KEY=VALUES", many=True),),
    ),
    Command(
        "roots",
        "Find the stresses at the roots of a loaded worm wheel's teeth over a pitch.",
        "Three teeth are meshed finely about their fillets; a minute. With --out also report.html, "
        "roots.json, roots.nc and pictures.",
        module="asperity.drive.root_stress.study",
        needs=("gearset", "operation", "drive"),
        counts="meshes",
    ),
    Command(
        "relief",
        "Find the relief of a worm gearset that takes the load off its edges.",
        "Each design counts by the worst of its loads and mountings. With --out also report.html, "
        "relief.json, relief.nc and relief.png.",
        module="asperity.drive.studies.relief",
        needs=("gearset", "operation", "drive"),
        counts="points",
        options=(
            Option(
                "over",
                "Values of a key of modification, hob or disc; again for another. Left out: tip "
                "relief from 0 to 40 um, then, where the wheel's tip bears most, root relief from "
                "0 to 80 um.",
                "TABLE.KEY=VALUES",
                many=True,
            ),
            Option(
                "at",
                "Loads and mountings to bear with, as mount.axial_offset=-20,20 um; again for "
                "another. Left out: the load, a third of it, and the corners of [tolerances].",
                "TABLE.KEY=VALUES",
                many=True,
            ),
        ),
    ),
    Command(
        "wear",
        "Let a loaded worm wheel bed in: pressure, error, efficiency, pattern over its turns.",
        "By Archard's law with [wear], or as ISO/TR 14521 has it. With --out also report.html, "
        "wear.json, wear.nc and pictures.",
        module="asperity.drive.wear.solve",
        needs=("gearset", "operation", "drive"),
        counts="steps",
        options=(
            Option("depth", "Largest depth at which it ends.", "LENGTH", default="20 um"),
            Option("revolutions", "Turns of the wheel after which it ends.", "N"),
        ),
    ),
    Command(
        "directions",
        "Shake a worm gearset each way: what a micrometre and a watt save, and what forces.",
        "With --out also report.html, directions.json, directions.nc and directions.png.",
        module="asperity.drive.directions",
        needs=("gearset", "operation", "drive"),
        counts="ways",
    ),
    Command(
        "locking",
        "Take a worm gearset's motor off: whether it holds, and how much shaking sets it free.",
        "With --out also report.html, locking.json, locking.nc and locking.png.",
        module="asperity.drive.locking",
        needs=("gearset", "operation", "drive"),
        counts="amplitudes",
    ),
    Command(
        "control",
        "Switch a drive's vibration in a stroke, by a sensor or a clutch, and let each part fail.",
        "With --out also report.html, control.json, control.nc and pictures.",
        module="asperity.drive.control.study",
        needs=("gearset", "operation", "drive", "control"),
        counts="thousandths of strokes",
    ),
    Command(
        "fit",
        "Fit a friction law to measured ratios or forces: intervals, and what data cannot tell.",
        "With --out also report.html, fit.json, fit.nc and fit.png.",
        module="asperity.tribometer.fit.study",
        counts="fits and ends",
        arguments=(
            Argument(
                "data", "DATA.csv", "Columns ratio or force [N], sd if known, keys with units."
            ),
        ),
        options=(
            Option("free", "Keys to fit, separated by commas.", "KEYS", default=None),
            Option(
                "law",
                "split, unsplit, vector or all; left out: the case's.",
                "LAW",
                choices=("split", "unsplit", "vector", "all"),
            ),
            Option("next", "Also name so many measurements to make.", "N", default="0", most=100),
            Option(
                "model",
                "slide, block or drive: whose answer it is.",
                "NAME",
                default="slide",
                choices=("slide", "block", "drive"),
            ),
        ),
    ),
    *RIG_COMMANDS,
)
"""In the order of the help."""
