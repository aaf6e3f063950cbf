"""Ways to less friction side by side: what each is worth in one gearset."""

import dataclasses
import math
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from asperity.errors import InputError, nearest
from asperity.results import Result, quantity
from asperity.results.table import Table
from asperity.sources import Source
from asperity.studies.layout import labelled, percent, points, words
from asperity.studies.shaken import Shaken

if TYPE_CHECKING:
    import xarray as xr


@dataclasses.dataclass(frozen=True)
class Compared:
    """A gearset with one way to less friction.

    Attributes
    ----------
    key, name : str
        Short name, and what it is.
    kind : {'as it is', 'oil', 'additive', 'coating', 'vibration'}
        Family.
    base_friction, friction : float
        Base and mean coefficient of tooth friction.
    efficiency, total_efficiency : float
        Of the teeth and of the gearbox, the worm driving; the power of a vibration does not count.
    back_driving_efficiency : float
        Of the teeth, the wheel driving; the worm locks itself where it is not above zero.
    gain : float
        Rise of the efficiency of the teeth, as a share of one.
    source : Source
        Who reports the friction.
    vibration : Shaken or None
        What is imposed.
    vibration_power : float
        Power that it puts into the contact, W.
    efficiency_with_vibration : float
        Efficiency of the teeth with that power counted.
    """

    key: str
    name: str
    kind: str
    base_friction: float
    friction: float
    efficiency: float
    total_efficiency: float
    back_driving_efficiency: float
    gain: float
    source: Source
    vibration: Shaken | None
    vibration_power: float
    efficiency_with_vibration: float

    @property
    def locks(self) -> bool:
        """Whether the worm locks itself while it slides."""
        return self.back_driving_efficiency <= 0.0

    def to_json(self) -> dict[str, Any]:
        """Return everything by key; the units are part of the keys."""
        answer: dict[str, Any] = {
            "key": self.key,
            "name": self.name,
            "kind": self.kind,
            "mu_0T": self.base_friction,
            "mu_zm": self.friction,
            "eta_z1_2": self.efficiency,
            "eta_ges": self.total_efficiency,
            "eta_z2_1": self.back_driving_efficiency,
            "self_locking": self.locks,
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
        raise InputError(f"{key!r} is not compared here{known}")

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
        rows, over = self.rows, ("way",)

        def column(get: Callable[["Compared"], float]) -> Any:
            return np.array([get(row) for row in rows])

        def imposed(get: Callable[["Shaken"], float]) -> Any:
            return np.array([np.nan if r.vibration is None else get(r.vibration) for r in rows])

        dataset = labelled(
            f"Ways to less friction in {self.name or 'a worm gearset'}",
            {"way": (over, words(r.key for r in rows), "1", "way to less friction")},
            name=(over, words(r.name for r in rows), "1", "what it is"),
            kind=(over, words(r.kind for r in rows), "1", "family"),
            source=(over, words(str(r.source) for r in rows), "1", "who reports its friction"),
            mu_0T=(over, column(lambda r: r.base_friction), "1", "base coefficient of friction"),
            mu_zm=(over, column(lambda r: r.friction), "1", "mean coefficient of tooth friction"),
            eta_z1_2=(over, column(lambda r: r.efficiency), "1", "efficiency of the teeth"),
            eta_ges=(over, column(lambda r: r.total_efficiency), "1", "efficiency of the gearbox"),
            eta_z2_1=(
                over, column(lambda r: r.back_driving_efficiency), "1",
                "efficiency of the teeth, wheel driving",
            ),
            velocity_ratio=(
                over, imposed(lambda v: v.velocity_ratio), "1",
                "peak velocity of the vibration over the sliding velocity",
            ),
            velocity_amplitude=(
                over, imposed(lambda v: v.velocity), "m/s", "peak velocity of the vibration",
            ),
            vibration_power=(
                over, column(lambda r: r.vibration_power), "W", "power of the vibration",
            ),
            eta_z1_2_with_power=(
                over, column(lambda r: r.efficiency_with_vibration), "1",
                "efficiency of the teeth with the power of the vibration counted",
            ),
        )  # fmt: skip
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
        rows = [
            [
                row.name,
                f"{row.base_friction:.4f}",
                f"{row.friction:.4f}",
                percent(row.efficiency),
                points(row.gain),
                percent(row.total_efficiency),
                row.locks,
            ]
            for row in self.rows
        ]
        assumed = [f"{what} is assumed: {text}" for what, text in self.assumed.items()]
        names: dict[str, list[str]] = {}
        for row in self.rows:
            names.setdefault(str(row.source), []).append(row.name)
        sources = [f"friction of {'; '.join(of)}: {source}" for source, of in names.items()]
        return (
            Table.of(
                ("", "mu_0T", "mu_zm", "eta_z", "points", "eta_ges", "locks"),
                rows,
                title="Efficiency of the teeth eta_z and of the gearbox eta_ges in percent",
                remarks=(*self.notes, *assumed, *sources),
            ),
        )
