"""What is shown of the flanks of worm and wheel, and of gearset 3 in space."""

import functools

from asperity.thesis.exhibits import FigureOf
from asperity.thesis.ledger import Claim

_PLACE = "asperity.thesis.flanks"
_CASES = ("gearset-3b",)
_figure = functools.partial(FigureOf, module=f"{_PLACE}.figures", cases=_CASES)
_claim = functools.partial(Claim, module=f"{_PLACE}.claims", cases=_CASES)
_solid = functools.partial(FigureOf, module=f"{_PLACE}.solids", cases=_CASES)

_OTHERS = (
    "Mao's and Litvin's gears are not at hand; this is gearset 3 with a centre distance of 2.9 in."
)
_CAD = (
    "The thesis's CAD model is lost; this is gearset 3 as reconstructed, with a centre distance of "
    "2.9 in."
)

_FLANKS = (
    _figure(
        "2.9", "Contact pressure before and after lead angle correction and tip relief",
        "Hertzian pressure along the contact lines at 24 angles of the worm, rated torque, by one "
        "stiffness per length of line: no finite elements as in Mao's figure, and a worm gearset "
        "with an identical hob instead of his helical gears. (a) The worm's axis stands 0.1 deg "
        "askew; 0.07 deg of lead correction brings the load back from the edge. (b) A tip relief "
        "of 80 um from the pitch line, and one of 10 um over the outer half of the addendum.",
    ),
    _figure(
        "2.10", "Formation of contact on worm and wheel",
        f"{_OTHERS} Where one tooth is within 6 um of the worm, at five instants while it is at "
        "all: above on the worm's thread, below on the wheel's flank; lines: nearest places. (a) "
        "Identical hob: contact lines. (b) The same with the worm's axis 0.1 deg askew and 0.05 mm "
        "too far away: contact at the edge. (c) A hob of 1.12 times the diameter, tilted by 2 deg: "
        "ellipses about the middle. Unloaded.",
    ),
    _figure(
        "2.11", "Mesh check with dye: 12 % oversized hob without and with a tilt of 2 deg",
        "Gearset 3 with a centre distance of 2.9 in instead of the gearset photographed, which is "
        "not named; dye 6 um thick, unloaded. Without tilt the wheel bears near a face edge; with "
        "2 deg in the middle, as the thesis found.",
    ),
    _figure(
        "2.12", "Contact near the wheel's addendum at low and at high torque",
        "The steering gear's worm of steel and wheel of polymer are not at hand; this is gearset 3 "
        "with a centre distance of 2.9 in and the worm of figure 2.13, relieved by 30 um towards "
        "its tip. Lines of contact at 24 angles of the worm that carry, with one stiffness per "
        "length of line.",
    ),
    _figure(
        "2.13", "Worm profile modified between pitch line and tip",
        "A steering worm's dimensions are not given; the worm of gearset 3 stands in. The relief "
        "grows with the third power from the pitch line to 30 um at the tip; in the left picture "
        "it is drawn ten times as large.",
    ),
)  # fmt: skip

_SOLIDS = (
    _solid(
        "7.1", "Gearset 3 in space, and what a machining simulation leaves of a flank",
        f"{_CAD} Right: the exact flank, and one cut at every 30 deg of the hob alone, its facets "
        "enlarged 30 times. Those of the thesis's model, at the edges of the teeth, came from its "
        "tool's path, which is lost; shaft and hub are left out.",
    ),
    _solid(
        "7.2", "Gearset 3 simplified for a simulation",
        f"{_CAD} The worm and nine teeth with their rim; shaft and hub are left out, as the "
        "thesis does.",
    ),
    _solid(
        "7.3", "The worm as a rigid shell",
        "Its surface alone, open at both ends, as quadrilaterals; every corner lies on the exact "
        "surface. A simulation here takes the worm without facets, by its distance function; the "
        "mesh is for others.",
    ),
    _solid(
        "7.4", "Topology and mesh of a wheel tooth",
        "The thesis had to blend facets into one face a flank. Here each flank, fillet and tip is "
        "one face from the start, and the corners of the mesh lie on it exactly. The mesh is of "
        "structured hexahedra, of intermediate density.",
    ),
    _solid(
        "7.11", "Mesh densities of the wheel: coarse, intermediate, fine",
        "As in the thesis the element sizes are 100, 75 and 50 % of the coarse one, which is "
        "a fifth of the axial module here, as Table 7.4 is lost. A tooth of the wheel; the worm "
        "needs no mesh.",
    ),
)  # fmt: skip

FIGURES = (*_FLANKS, *_SOLIDS)

CLAIMS = (
    _claim(
        "2.1", "2.6", "A wheel cut by a hob 12 % oversized bears at the edge; with the hob tilted "
        "by 2 deg in the middle.", "edge, middle",
    ),
    _claim("2.2", "2.6", "An oversized hob makes misalignment matter less.", "yes"),
    _claim(
        "2.3", "2.6", "Oversize alone leaves contact at the edge at higher lead angles.", "yes",
    ),
)  # fmt: skip
