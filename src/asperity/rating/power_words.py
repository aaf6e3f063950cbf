"""What the verdict says of efficiency and losses, by who drives."""

from collections.abc import Iterator
from typing import NamedTuple

from asperity.rating.inputs import Inputs
from asperity.rating.result import Rating
from asperity.rating.standing import efficiency_outside
from asperity.results.words import Number, Sentence

_POWERS = (
    "eta_ges", "eta_z1_2", "input_power_W", "loss_total_W", "eta_ges2_1", "eta_z2_1",
    "output_power_W",
)  # fmt: skip


def power_lines(inputs: Inputs, iso: Rating) -> Iterator[str]:
    """Yield efficiency and losses of a rating by ISO/TR 14521.

    The worm drives, but where the load does in all parts of a duty cycle: there its power goes in,
    and what the teeth leave of it is another part.
    """
    outside = bool(efficiency_outside(iso))
    if load_drives(inputs):
        yield from _let_down(iso, outside=outside)
        return
    yield Sentence(
        "efficiency ", _number(iso, "eta_ges", ".1f", 100.0), " % of the gearbox, ",
        _number(iso, "eta_z1_2", ".1f", 100.0),
        f" % of the teeth ({'OUTSIDE ITS RANGE' if outside else 'ISO/TR 14521'})",
    )  # fmt: skip
    if float(iso["eta_ges"]) > float(iso["eta_z1_2"]):
        yield "the gearbox comes out above its teeth: the standard's loss has 0.1 for 2 pi/60"
    yield Sentence(
        "losses ", _number(iso, "loss_total_W", ".4g"), " W of ",
        _number(iso, "input_power_W", ".4g"), " W: ", _parts(iso, "loss_meshing_W"),
    )  # fmt: skip


def load_drives(inputs: Inputs) -> bool:
    """Whether the load drives in all parts of a duty cycle."""
    return bool(inputs.duty) and all(part.back for part in inputs.duty)


class Power(NamedTuple):
    """Efficiency and losses by who drives; None of a load that is to drive and cannot."""

    gearbox: float | None  #: Efficiency of it
    teeth: float | None  #: That of the teeth
    put_in: float  #: W
    lost: float | None  #: W


def power_of(inputs: Inputs, iso: Rating) -> Power:
    """Return efficiency and losses of a rating by ISO/TR 14521, of the worm or of the load."""
    values = {key: float(iso[key]) for key in _POWERS}
    if not load_drives(inputs):
        own = "eta_ges", "eta_z1_2", "input_power_W", "loss_total_W"
        return Power(*(values[key] for key in own))
    put_in = values["output_power_W"]
    if values["eta_ges2_1"] <= 0.0:
        return Power(None, None, put_in, None)
    return Power(values["eta_ges2_1"], values["eta_z2_1"], put_in, _lost(iso))


def _lost(iso: Rating) -> float:
    """Return the losses where the load drives, W."""
    worm, back = float(iso["loss_meshing_W"]), float(iso["loss_meshing_back_W"])
    return float(iso["loss_total_W"]) - worm + back


def _let_down(iso: Rating, *, outside: bool) -> Iterator[str]:
    """Yield the same where the load drives."""
    where = f"the load driving{', OUTSIDE ITS RANGE' if outside else ''}"
    if float(iso["eta_ges2_1"]) <= 0.0:
        by = "OUTSIDE ITS RANGE" if outside else "ISO/TR 14521"
        yield f"no efficiency: the load is to drive, which the gearset does not let it ({by})"
        return
    yield Sentence(
        "efficiency ", _number(iso, "eta_ges2_1", ".1f", 100.0), " % of the gearbox, ",
        _number(iso, "eta_z2_1", ".1f", 100.0), f" % of the teeth ({where})",
    )  # fmt: skip
    yield Sentence(
        f"losses {_lost(iso):.4g} W of ", _number(iso, "output_power_W", ".4g"), " W: ",
        _parts(iso, "loss_meshing_back_W"),
    )  # fmt: skip


def _number(iso: Rating, key: str, form: str, times: float = 1.0) -> Number:
    return Number.of(float(iso[key]), form, f"iso14521.{key}", times)


def _parts(iso: Rating, teeth: str) -> Sentence:
    keys = {
        "teeth": teeth,
        "idling": "loss_idle_W",
        "bearings": "loss_bearing_W",
        "seals": "loss_seal_W",
    }
    # Three digits say enough, and the line stays one.
    shares = (
        Sentence(f"{name} ", _number(iso, key, ".0f" if float(iso[key]) >= 100.0 else ".3g"))
        for name, key in keys.items()
    )
    return Sentence.joined(shares, " + ")
