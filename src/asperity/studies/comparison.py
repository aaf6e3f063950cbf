"""Ways to less friction side by side: what each is worth in one gearset."""

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, ClassVar

from asperity.errors import InputError, nearest, shown
from asperity.results import Quantities, Result, labelled, quantity
from asperity.results.dataset import along, described
from asperity.results.table import Cell, Table, table_of_rows
from asperity.sources import Source
from asperity.studies.layout import points
from asperity.studies.vibrated_friction import Shaken

if TYPE_CHECKING:
    import xarray as xr


class Compared(Quantities):
    """A gearset with one way to less friction.

    Efficiencies are those of the gears: the power of a vibration does not count but in
    `efficiency_with_vibration`. The worm locks itself where the efficiency with the wheel driving
    is not above zero.

    Attributes
    ----------
    kind : {'as it is', 'oil', 'additive', 'coating', 'vibration'}
        Family.
    gain : float
        Rise of the efficiency of the teeth, as a share of one.
    source : Source
        Who reports the friction.
    vibration : Shaken or None
        What is imposed.
    """

    key: str = quantity("", "", "way to less friction", variable="way")
    name: str = quantity("", "", "what it is")
    kind: str = quantity("", "", "family")
    base_friction: float = quantity(
        "mu_0T", "", "base coefficient of friction", key="mu_0T", variable="mu_0T"
    )
    friction: float = quantity(
        "mu_zm", "", "mean coefficient of tooth friction", key="mu_zm", variable="mu_zm"
    )
    efficiency: float = quantity(
        "eta_z1-2", "", "efficiency of the teeth", key="eta_z1_2", variable="eta_z1_2"
    )
    total_efficiency: float = quantity(
        "eta_ges", "", "efficiency of the gearbox", key="eta_ges", variable="eta_ges"
    )
    back_driving_efficiency: float = quantity(
        "eta_z2-1", "", "efficiency of the teeth, wheel driving", key="eta_z2_1",
        variable="eta_z2_1",
    )  # fmt: skip
    gain: float
    source: Source
    vibration: Shaken | None
    vibration_power: float = quantity("P_v", "W", "power of the vibration", only="file")
    efficiency_with_vibration: float = quantity(
        "eta_z1-2", "", "efficiency of the teeth with the power of the vibration counted",
        variable="eta_z1_2_with_power", only="file",
    )  # fmt: skip

    @property
    @labelled("", "", "whether the worm locks itself", key="self_locking", only="json")
    def locks(self) -> bool:
        """Whether the worm locks itself while it slides."""
        return self.back_driving_efficiency <= 0.0

    @property
    @labelled("", "", "who reports its friction", variable="source", only="file")
    def reported(self) -> str:
        """Who reports its friction, and how far that can be relied upon."""
        return str(self.source)

    @property
    @labelled("k", "", "peak velocity of the vibration over the sliding velocity", only="file")
    def velocity_ratio(self) -> float | None:
        """Peak velocity of the vibration over the sliding velocity."""
        return None if self.vibration is None else self.vibration.velocity_ratio

    @property
    @labelled("v_a", "m/s", "peak velocity of the vibration", only="file")
    def velocity_amplitude(self) -> float | None:
        """Peak velocity of the vibration, m/s."""
        return None if self.vibration is None else self.vibration.velocity

    def to_json(self) -> dict[str, Any]:
        """Return everything by key; the units are part of the keys."""
        answer = super().to_json() | {
            "gain_points": 100.0 * self.gain,
            "source": self.source.name,
            "confidence": self.source.confidence,
            "note": self.source.note,
            "vibration": None,
        }
        if self.vibration is not None:
            answer["vibration"] = {
                "direction_deg": math.degrees(self.vibration.direction),
                "frequency_Hz": self.vibration.frequency,
                "velocity_amplitude_m_s": self.vibration.velocity,
                "displacement_amplitude_um": 1e6 * self.vibration.amplitude,
                "velocity_ratio": self.vibration.velocity_ratio,
                "friction_share": self.vibration.share,
                "computed": self.vibration.computed,
                "power_W": self.vibration_power,
                "eta_z1_2_with_power": self.efficiency_with_vibration,
            }
        return answer


class Comparison(Result):
    """Ways to less friction in one gearset.

    Attributes
    ----------
    name : str
        Of the gearset.
    sliding_velocity : float
        At its mean diameter, m/s.
    output_power : float
        At the wheel, W.
    rows : tuple of Compared
        The gearset as it is, then one for each way.
    assumed : mapping of str to str
        What was assumed for the tables of a case file that were left out, by table.
    notes : tuple of str
        What a reader of the numbers should know.
    """

    title: ClassVar[str] = "Ways to less friction"
    stem: ClassVar[str] = "methods"
    drawings: ClassVar[Mapping[str, str]] = {"methods": "asperity.studies.plots:plot_comparison"}

    name: str
    sliding_velocity: float = quantity("v_g", "m/s", "sliding velocity", key="sliding_velocity_m_s")
    output_power: float = quantity("P_2", "W", "power at the wheel")
    rows: tuple[Compared, ...]
    assumed: Mapping[str, str]

    def __getitem__(self, key: str) -> Compared:
        """Return a row by its key."""
        for row in self.rows:
            if row.key == key:
                return row
        known = nearest(key, [row.key for row in self.rows])
        raise InputError(f"{shown(key)} is not compared here{known}")

    def to_json(self) -> dict[str, Any]:
        """Return everything by key; the units are part of the keys."""
        return {
            "name": self.name,
            "sliding_velocity_m_s": self.sliding_velocity,
            "output_power_W": self.output_power,
            "methods": [row.to_json() for row in self.rows],
            "assumed": dict(self.assumed),
            "notes": list(self.notes),
        }

    def to_dataset(self) -> "xr.Dataset":
        """Return friction, efficiencies and vibrations over the methods."""
        title = f"Ways to less friction in {self.name or 'a worm gearset'}"
        dataset = described(title, **along("way", self.rows))
        dataset.attrs |= {
            "sliding_velocity_m_s": self.sliding_velocity,
            "output_power_W": self.output_power,
            "notes": "; ".join(self.notes),
        }
        return dataset

    def heading(self) -> str:
        """Return the gearset's name."""
        return self.name or "worm gearset"

    def tables(self) -> tuple[Table, ...]:
        """Return friction and efficiency with each method, with the sources and notes below."""
        assumed = [f"{what} is assumed: {text}" for what, text in self.assumed.items()]
        names: dict[str, list[str]] = {}
        for row in self.rows:
            names.setdefault(str(row.source), []).append(row.name)
        sources = [f"friction of {'; '.join(of)}: {source}" for source, of in names.items()]
        return (
            table_of_rows(
                self.rows,
                {
                    "": "name",
                    "mu_0T": Cell("base_friction", ".4f"),
                    "mu_zm": Cell("friction", ".4f"),
                    "eta_z": Cell("efficiency", ".1f", 100.0),
                    "points": Cell(lambda row: points(row.gain), right=True),
                    "eta_ges": Cell("total_efficiency", ".1f", 100.0),
                    "locks": Cell("locks", right=True),
                },
                within="methods",
                title="Efficiency of the teeth eta_z and of the gearbox eta_ges in percent",
                remarks=(*self.notes, *assumed, *sources),
            ),
        )
