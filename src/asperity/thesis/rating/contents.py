"""What is shown and claimed of worm gearsets by their ratings."""

import functools

from asperity.thesis.exhibits import FigureOf, TableOf
from asperity.thesis.ledger import Claim

_PLACE = "asperity.thesis.rating"
_CASES = ("gearset-2", "gearset-3")
_figure = functools.partial(FigureOf, module=f"{_PLACE}.figures", cases=_CASES)
_table = functools.partial(TableOf, module=f"{_PLACE}.tables", cases=_CASES)
_claim = functools.partial(Claim, module=f"{_PLACE}.claims", cases=_CASES)
_word = functools.partial(_claim, module=f"{_PLACE}.words")

FIGURES = (
    _figure(
        "3.1", "Efficiency of gearset 2 with each way to less friction",
        "By ISO/TR 14521, with the friction that the thesis quotes for each; oils by the standard "
        "and, hatched, a vibration of 20 um at 20 kHz by our own friction model stand beside them. "
        "The quoted vibrations are 20 times as fast as the sliding. Bars leave the power of a "
        "vibration out, as the thesis does; diamonds count what of it goes into the contact.",
    ),
    _figure(
        "3.2", "Efficiency of gearset 2 over each of its inputs",
        "By ISO/TR 14521; one input is raised at a time, in steps of 5 %, with the centre distance "
        "as it is. Crosses: above these the film parameter h* is not above zero, and there is no "
        "answer.",
    ),
    _figure(
        "3.3", "Friction by two standards",
        "Base friction by ISO/TR 14521 in mineral oil, tooth friction of gearsets 2 and 3 with its "
        "size, geometry, material and roughness factors, and friction by AGMA 6034, which knows "
        "the sliding velocity alone; markers: the gearsets at 1440 rpm.",
    ),
    _figure(
        "3.4", "Efficiencies as they are and at the optimum",
        "By ISO/TR 14521 and AGMA 6034; gearsets 1 and 4 are lost, and so are the bounds of the "
        "optimum (Table 3.6 here).",
    ),
    _figure(
        "3.5", "Permissible torques as they are and at the optimum",
        "M_26k, M_w and M_s by BS 721, from tables that are from memory; T_G,all by AGMA 6034. "
        "Gearsets 1 and 4 are lost.",
    ),
)  # fmt: skip

TABLES = (
    _table(
        "3.2", "Efficiency of gearset 2: inputs and results",
        "By ISO/TR 14521. The thesis's table is lost; its column holds what the text repeats of "
        "it, the last one where the number here is from.",
    ),
    _table(
        "3.3", "Friction and efficiency of gearset 2 with each way to less friction",
        "What the thesis has of the oils' viscosities is lost, and without influence on the "
        "efficiency. Rows that are not in the thesis: oils by the formulas of ISO/TR 14521, and "
        "vibration by our own friction model.",
    ),
    _table(
        "3.4", "What each input does to the efficiency of gearset 2",
        "The thesis's table is lost; its column holds what the text of 3.2.3 says. Elasticity: "
        "relative change of the efficiency over that of the input, at the gearset as it is.",
    ),
    _table(
        "3.5", "Efficiency and load capacity of gearsets 2 and 3 as they are",
        "By ISO/TR 14521, AGMA 6034 and, from tables that are from memory, BS 721. The thesis's "
        "table is lost, gearsets 1 and 4 with it. The required life is 500 000 turns of the wheel, "
        "a tenth of it for strength (3.3.1).",
    ),
    _table(
        "3.6", "Constraints of the optimum",
        "The thesis's table is lost. The bounds of alpha_n, q_1, m_x1, Ra_1 and x_2 are assumed; "
        "that M_w and M_s may not fall is the thesis's.",
    ),
    _table(
        "3.7", "Efficiency and load capacity of gearsets 2 and 3 at the optimum",
        "As Table 3.5, within the constraints of Table 3.6. The thesis's table is lost; its column "
        "holds what the text of 3.3.5 says.",
    ),
)  # fmt: skip

CLAIMS = (
    _claim("3.1", "3.2.1", "Gearset 2: efficiency of the mesh and of the gearbox, eta_z, eta_ges.",
          "38 %, 31 %"),
    _claim("3.2", "3.2.2", "Gearset 2: base friction mu_0T in mineral oil.", "0.0715"),
    _claim("3.3", "3.2.2", "Friction of the methods as quoted (polyalphaolefin 0.0550, polyglycol "
          "0.0170, Fe3O4 -30 %, diamond -50 %, MoS2/Ti -42 %, superfinished -49 %, DLC -30 %, "
          "transverse vibration -90 %, longitudinal -95 %): vibration gives the best efficiency of "
          "gearset 2, then polyglycol; polyalphaolefin adds 6 %.", "order, +6 %"),
    _claim("3.4", "3.2.3", "U raised by over 27 % or m_x1 by over 37 % makes the calculation of "
          "gearset 2 fail.", "h* <= 0"),
    _claim("3.5", "3.2.3", "alpha_n, c, n_1 raise eta_z; U, q_1, m_x1, Ra_1 lower it; alpha_n and "
          "Ra_1 little, c most.", "signs"),
    _claim("3.6", "3.3.5", "The optimum over alpha_n, q_1, m_x1, Ra_1 without lowering M_w and "
           "M_s: alpha_n 30 deg, Ra_1 0.8 um, eta_z 7 % more.", "30 deg, 0.8 um, +7 %"),
    _claim("3.7", "3.3.4", "T_G,all > M_26k for gearsets 1 to 3; eta_AGMA is much higher than "
          "eta_z.", "order"),
    _claim("3.8", "7.2.4, 7.4", "Gearset 3: mu_zm, eta_z, v_g.", "0.1344, 73 %, 1510.8 mm/s"),
    _claim("7.1", "7.2.2", "Torsional stiffness of the worm shaft.", "4394 N m/rad"),
    _word("1.1", "1.1", "15:1, 150 N m: 80 % instead of 50 % efficiency saves torque and power.",
          "20 to 12.5 N m, 37 %", cases=()),
    _word("2.6", "2.4", "Friction of bronze on hardened steel at the most common sliding speeds.",
          "0.05 to 0.10"),
    _word("3.9", "3.3.4", "eta_ges < eta_z; M_w and M_s > M_26k; M_w > T_2; M_s > T_R.", "order"),
    _word("3.10", "3.3.5", "At the optimum M_w rises a little, M_s stays; eta_AGMA does not rise "
          "in all cases; q_1 and sigma_a rise for gearset 3 only.", "in words"),
    _word("3.11", "3.4", "Efficiency of gearset 2 at its optimum.", "45 %"),
    _word("3.12", "6.4.7, 3.3.4", "The sliding velocity of gearsets 1 to 4 rises with their size.",
          "1.05 to 2.40 m/s"),
    _word("3.13", "3.3.4", "Of gearset 4, the largest, M_26k > T_G,all, other than of 1 to 3.",
          "the order turns"),
    _word("3.14", "3.2.1", "Self-locking wants q_1 as low as possible.", "yes"),
    _word("7.9", "7.2.4", "Contact pressure of gearset 3 at 23 N m and 366 N m.",
          "194.3, 778 N/mm2"),
)  # fmt: skip
