"""What is shown and claimed of the elastic block."""

import functools

from asperity.thesis.contact.elastic import (
    LONGITUDINAL,
    TRANSVERSE,
    base_or_body,
    equal_ratios,
    from_rest,
    over_direction,
    over_ratio,
)
from asperity.thesis.exhibits import FigureOf
from asperity.thesis.ledger import Claim

_PLACE = "asperity.thesis.contact"
_ALONG = ("block-longitudinal", "table-4.3")
_ACROSS = ("block-transverse", "table-4.4")
_figure = functools.partial(FigureOf, module=f"{_PLACE}.figures")
_block = functools.partial(_figure, has_full=True)
_claim = functools.partial(Claim, module=f"{_PLACE}.claims", cases=(*_ALONG, *_ACROSS))

_BESIDE = (
    "Lines: the sliding body of chapter 4; markers: the elastic block, its friction read after it "
    "has settled from the sliding body's periodic state, over sixteen cycles or more until four "
    "parts of them agree within 0.1 %. Below: how far it is from the sliding body, from one that "
    "has the block's compliance as a spring between itself and its asperities, and from one that "
    "rocks on it as the block does."
)
_REST = "From rest over 0.3 s, with the same increments for the sliding body and the block."

FIGURES = (
    _figure(
        "5.2", "Contact at nodes and integrated over the surface",
        "A rigid cylinder on a block of 8-node elements nearly as wide as the contact's "
        "half-width, with the same law of pressure and the same load. Above: it stands between two "
        "lines of nodes; so coarse, neither is Hertz's pressure point by point, at nodes too low, "
        "integrated as much too high in the middle. Below, what tells them apart: how "
        "far it goes while it moves over an element; held at nodes alone it sinks between them, "
        "integrated less than half as much.",
    ),
    _figure(
        "5.3", "Linear and two-stage pressure over overclosure",
        "The thesis takes the linear law. The other is given a tenth of its stiffness up to an "
        "overclosure of 1 % of an element, 5 mm on the base of the shipped block, and all of it "
        "from 3 %; dotted: these two. The pressure under the elastic block, 46 kPa, stays within "
        "the first 0.001 um.",
        cases=_ALONG,
    ),
    _block(
        "5.5", "Longitudinal vibration: the elastic block", f"Table 4.3. {_BESIDE}", cases=_ALONG,
        parts=functools.partial(over_ratio, LONGITUDINAL),
    ),
    _block(
        "5.6", "Drive force of the elastic block, longitudinal, k = 6",
        f"Table 4.3. {_REST}", cases=_ALONG,
        parts=functools.partial(from_rest, LONGITUDINAL),
    ),
    _block(
        "5.7", "Friction of the elastic block, longitudinal, k = 6",
        f"Table 4.3, two cycles at the end. {_REST}", cases=_ALONG,
        parts=functools.partial(from_rest, LONGITUDINAL),
    ),
    _block(
        "5.8", "Transverse vibration: the elastic block", f"Table 4.4. {_BESIDE}", cases=_ACROSS,
        parts=functools.partial(over_ratio, TRANSVERSE),
    ),
    _block(
        "5.9", "Drive force of the elastic block, transverse, k = 20",
        f"Table 4.4. {_REST}", cases=_ACROSS,
        parts=functools.partial(from_rest, TRANSVERSE),
    ),
    _block(
        "5.10", "Friction of the elastic block, transverse, k = 20",
        f"Table 4.4, two cycles at the end. {_REST}", cases=_ACROSS,
        parts=functools.partial(from_rest, TRANSVERSE),
    ),
    _block(
        "5.11", "The elastic block in every direction of vibration",
        "Table 4.4. Lines: the sliding body of chapter 4; markers: the elastic block. Below: how "
        "far it is from the sliding body.", cases=_ACROSS,
        parts=over_direction,
    ),
    _block(
        "7.8", "Transverse vibration of the base or of the block",
        f"Table 4.4. {_BESIDE}", cases=_ACROSS,
        parts=functools.partial(over_ratio, TRANSVERSE, on_body=True),
    ),
    _block(
        "7.9", "Longitudinal vibration of the base or of the block",
        f"Table 4.3. {_BESIDE}", cases=_ALONG,
        parts=functools.partial(over_ratio, LONGITUDINAL, on_body=True),
    ),
)  # fmt: skip

CLAIMS = (
    _claim("5.1", "5.3", "Finite element ratios equal chapter 4's.", "agree", parts=equal_ratios),
    _claim("5.3", "5.3.1, App. A", "Height of the block of 0.5 kg.", "0.03 m; 0.053 m"),
    _claim(
        "7.14", "7.3.5", "(98) to (141) are the partial derivatives of (79) to (97).", "yes",
        module=f"{_PLACE}.derivatives", cases=(),
    ),
    _claim("7.8", "7.3.6", "Vibrating the body or the base gives the same ratios.", "agree",
           parts=base_or_body),
)  # fmt: skip
