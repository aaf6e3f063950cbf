"""What is shown and claimed of the sliding body."""

import functools

from asperity.thesis.exhibits import FigureOf, TableOf
from asperity.thesis.ledger import Claim

_PLACE = "asperity.thesis.sliding"
_figure = functools.partial(FigureOf, module=f"{_PLACE}.figures")
_claim = functools.partial(
    Claim,
    module=f"{_PLACE}.claims",
    cases=(*(f"table-4.1-L{n}" for n in range(1, 7)), "table-4.3", "table-4.4"),
)
_reading = functools.partial(_claim, module=f"{_PLACE}.readings")
_table = functools.partial(TableOf, module=f"{_PLACE}.tables")

_LINES = "Exponential scheme (full line) and two-phase scheme (dashed)"

FIGURES = (
    _figure(
        "2.7", "Dahl's friction force from rest",
        "The exponent sets how the contact yields: 0 is elastic up to the full force, 2 creeps "
        "towards it. Full force and deflection limit of Table 4.3.",
    ),
    _figure(
        "2.14", "Rigid friction in a cycle of longitudinal vibration",
        "While the base outruns the body, friction pushes the body forward. The thesis gives "
        "no numbers; those of simulation L2 are used, with v_a = 2 v_d.",
        cases=("table-4.1-L2",),
    ),
    _figure(
        "2.15", "Dahl friction in a cycle of longitudinal vibration",
        "At 4 kHz and v_a = 0.75 mm/s against v_d = 0.5 mm/s the asperities give way before "
        "the force can turn: it falls, but keeps its sign. The thesis gives no other numbers; "
        "those of Table 4.3 are used, with its compliant drive and with a rigid one.",
        cases=("table-4.3", "table-4.1-L4"),
    ),
    _figure(
        "2.16", "Rigid friction in a cycle of transverse vibration",
        "Friction keeps its size and opposes the slip, which swings about the drive: what is left "
        "along the drive is smaller. The thesis gives no numbers; those of simulation L2 are used, "
        "with the base moving across the drive.",
        cases=("table-4.1-L2",),
    ),
    _figure(
        "4.3", "Rigid drive, vibration slower than the drive",
        "Simulations L1 (rigid friction) and L3 (asperities): the drive force stays at "
        "mu F_N once the asperities are stretched.",
        cases=("table-4.1-L1", "table-4.1-L3"),
    ),
    _figure(
        "4.4", "Rigid drive, vibration faster than the drive",
        "Simulations L2 (rigid friction) and L4, L5, L6 with softer and softer asperities, "
        "from rest; L6 has not settled yet at the end.",
        cases=("table-4.1-L2", "table-4.1-L4", "table-4.1-L5", "table-4.1-L6"),
    ),
    _figure(
        "4.17", "Longitudinal vibration: what is left of the drive force",
        "Table 4.3. Line: periodic states; markers: 1 s marched with either scheme; dashed: "
        "rigid friction and rigid drive.",
        cases=("table-4.3",),
    ),
    _figure(
        "4.18", "Drive force when longitudinal vibration sets in, k = 6",
        f"Table 4.3. {_LINES}. The last millisecond, enlarged, shows the undulation that the "
        "two-phase scheme puts into the drive force by stretching the drive with the base's "
        "motion; it is not physical.",
        cases=("table-4.3",),
    ),
    _figure(
        "4.19", "Friction under longitudinal vibration, k = 6",
        f"Table 4.3, two cycles at the end of the march. {_LINES}.",
        cases=("table-4.3",),
    ),
    _figure(
        "4.20", "Transverse vibration: what is left of the drive force",
        "Table 4.4. Lines: periodic states of the three relaxation laws; markers: 1 s marched "
        "with law split and either scheme; dotted: rigid friction and rigid drive with the "
        "transferred part of the vibration, eta_y k.",
        cases=("table-4.4",),
    ),
    _figure(
        "4.21", "Drive force when transverse vibration sets in, k = 20",
        f"Table 4.4. {_LINES}. Enlarged: the last millisecond.",
        cases=("table-4.4",),
    ),
    _figure(
        "4.22", "Friction under transverse vibration, k = 20",
        f"Table 4.4, two cycles at the end of the march. {_LINES}. Along the drive the force "
        "changes in size, across it in size and sign.",
        cases=("table-4.4",),
    ),
    _figure(
        "4.23", "What is left of the drive force in every direction of vibration",
        "Table 4.4. Lines: periodic states; filled markers: 25 directions marched for 1 s; "
        "open diamonds: LuGre friction without damping and Stribeck terms, at k = 2 and 20.",
        cases=("table-4.4",),
    ),
)  # fmt: skip

TABLES = (
    _table(
        "4.1", "Six bodies on a rigid drive",
        "The thesis's inputs survive in its text; v_a against v_d, and s_max, tell them apart. "
        "Forces are of periodic states.",
        cases=tuple(f"table-4.1-L{n}" for n in range(1, 7)),
    ),
    _table(
        "4.3", "The body under longitudinal vibration",
        "The inputs as the thesis prints them and as the shipped case has them; k_t follows. "
        "Below, what they give.",
        cases=("table-4.3",),
    ),
    _table(
        "4.4", "The body under transverse vibration",
        "The inputs as the thesis prints them and as the shipped case has them; k_t follows. A "
        "direction of 270 deg gives the ratios of 90 deg (claim 4.10). Below, what they give.",
        cases=("table-4.4",),
    ),
)  # fmt: skip

CLAIMS = (
    _claim(
        "4.1", "4.2.3",
        "L1 and L3: no reduction for v_a < v_d. L2: a square wave. L4 to L6: smoother as s_max "
        "grows, until the force keeps its sign.",
        "in words",
    ),
    _claim(
        "4.2", "4.3.1", "Drive stiffness from the digitised point.", "96068 N/m",
    ),
    _claim(
        "4.3", "4.5.4",
        "Longitudinal: no reduction for k <= 1; the pre-existing and the coupled model agree.",
        "agree",
    ),
    _claim(
        "4.4", "4.5.4, 4.5.5", "Breakaway: time and drive force.",
        "about 0.12 s at 5.5 N, 0.11 s at 5.08 N",
    ),
    _claim("4.5", "4.5.5", "Transverse: reduction also for k <= 1.", "yes"),
    _claim(
        "4.6", "4.5.6",
        "Drive force symmetric about a direction of 180 deg; longitudinal always lowest.",
        "yes, yes",
    ),
    _claim(
        "4.7", "App. A.5", "LuGre with zero damping and Stribeck terms equals Dahl.", "exact",
    ),
    _claim(
        "4.8", "3.2.2", "At k = 20 vibration saves, transverse and longitudinal.",
        "-90 %, -95 % (0.10, 0.05; after Gutowski and Leus)",
    ),
    _reading(
        "2.4", "2.7.2", "Longitudinal, 4 kHz, v_a = 0.75 mm/s just above v_d = 0.5 mm/s: the mean "
        "of friction falls, its sign stays.", "yes",
    ),
    _reading(
        "2.5", "2.7.1", "Normal vibration without loss of contact saves friction (Hess and Soom).",
        "up to 10 %", cases=(),
    ),
    _reading("4.9", "4.5.4", "eta_y has no influence on longitudinal vibration.", "none"),
    _reading(
        "4.10", "4.5.5", "F_x and F_y of the coupled model, theta = 270 deg, match the "
        "pre-existing transverse model.", "exact",
    ),
    _reading(
        "4.11", "4.5.4, App. B",
        "F_d undulates in longitudinal vibration; less towards transverse.",
        "yes",
    ),
    _reading(
        "4.12", "4.5.4", "The drive force under vibration is its mean over one cycle, (60), (61).",
        "method",
    ),
    _reading(
        "5.2", "App. A", "Finite element runs at 1e-5 s agree very well with the analytical ones.",
        "agree",
    ),
)  # fmt: skip
