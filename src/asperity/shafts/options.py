"""The table `[bearings]` of a case file: what is asked of the bearings of both shafts."""

from typing import Annotated, Any, ClassVar, Literal

from pydantic import BeforeValidator

from asperity.casefile import Table
from asperity.shafts.rolling.life import AT_REST, CLEANLINESS, RELIABILITY, Kind
from asperity.units import Quantity


def _percent(value: Any) -> Any:
    if isinstance(value, str):
        value = value.removesuffix("%").strip()
        return int(value) if value.isdigit() else value
    return int(value) if isinstance(value, float) and value.is_integer() else value


class BearingOptions(Table):
    """What is asked of the bearings.

    Parameters
    ----------
    life : float or str, optional
        Life that they must reach, s. Left out: that of the operation.
    reliability : {90, 95, 96, 97, 98, 99}
        Percent of them that reach it; "95 %" in a file.
    contamination : {'high', 'normal', 'slight', 'typical', 'severe', 'bronze'}, optional
        Cleanliness of the oil in the words of ISO 281, 'high' the cleanest, each with the least
        e_C of its range; 'bronze' is an oil bath with what a bronze wheel wears off, 0.3, of our
        own. Left out: L10h alone is told, without what the oil does.
    static_safety : float, optional
        Least static safety :math:`s_0` under the peak load. Left out: 1 of ball and 1.5 of roller
        bearings, for normal running (ISO 76, from memory).
    raises : {'clockwise', 'anticlockwise'}, optional
        Rotation of the worm that raises a load that never reverses, as a hoist's: its axial force
        keeps its sign. Left out: both rotations, with the worm or the load driving.
    """

    table: ClassVar[str] = "bearings"

    life: Annotated[float, Quantity("s", what="a time", example="10000 h", gt=0)] | None = None
    reliability: Annotated[
        Literal[90, 95, 96, 97, 98, 99],
        BeforeValidator(_percent, json_schema_input_type=Literal[90, 95, 96, 97, 98, 99] | str),
    ] = 90
    contamination: Literal["high", "normal", "slight", "typical", "severe", "bronze"] | None = None
    static_safety: (
        Annotated[float, Quantity("", what="a factor", example="2.0", gt=0, le=100)] | None
    ) = None
    raises: Literal["clockwise", "anticlockwise"] | None = None

    @property
    def a_1(self) -> float:
        """Life factor of the reliability."""
        return RELIABILITY[self.reliability]

    def at_rest(self, elements: Kind) -> float:
        """Return the least static safety that is asked of a bearing.

        Parameters
        ----------
        elements : {'ball', 'roller'}
            What it rolls on.

        Returns
        -------
        float
            s_0.
        """
        return AT_REST[elements] if self.static_safety is None else self.static_safety

    @property
    def e_c(self) -> float | None:
        """Factor of the oil's cleanliness."""
        return None if self.contamination is None else CLEANLINESS[self.contamination]
