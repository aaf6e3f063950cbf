"""What the verdict says of a load spectrum and of a housing."""

import math
from collections.abc import Iterator, Sequence
from typing import Any

from asperity.rating.duty import DutyMean, DutyPart, duty_mean
from asperity.rating.endurance import Endurance
from asperity.rating.inputs import Inputs
from asperity.rating.result import Rating
from asperity.rating.starting import Starting, starting_line
from asperity.results.words import Number, Sentence

_MOST_PARTS = 3


def loads_line(inputs: Inputs) -> str:
    """Return how many loads there are, for how long, and in which duty."""
    spectrum, how = inputs.operation.spectrum, inputs.how
    hours = float(inputs.total(part.hours for part in inputs.loads))
    count = len(inputs.duty)
    duty = "" if spectrum is None or how.kind == "S1" else f", {' '.join(spectrum.duty.split())}"
    if how.kind == "S3":
        duty += f" of {inputs.cycle / 60.0:.4g} min"
    named = f", {spectrum.duty_class}" if spectrum is not None and spectrum.duty_class else ""
    return f"{count} load{'s' * (count > 1)} in {hours:.4g} h{named}{duty}"


def duty_lines(
    inputs: Inputs,
    ratings: dict[str, Rating],
    parts: Sequence[DutyPart],
    lasts: Sequence[Endurance],
    starts: Sequence[Starting],
) -> Iterator[str]:
    """Yield the lines of a spectrum and a housing; none without them."""
    operation, iso = inputs.operation, ratings.get("iso14521")
    if operation.steps is not None:
        if mean := duty_mean(inputs, parts):
            yield _over_all(inputs, mean)
        yield from _shares(parts)
        if lasts:
            hours = float(inputs.total(part.hours for part in inputs.loads))
            yield lasts[0].sentence(hours, "endurance.0")
        if "agma6034" in ratings:
            factor = operation.service_factor
            times = "" if factor is None else f", times a service factor of {factor:g}"
            yield f"AGMA 6034 has no load spectra: the load nearest to its limit{times}"
    if iso is not None and operation.housing is not None:
        yield _oil(inputs, iso)
    if starts:
        yield starting_line(starts)


def _over_all(inputs: Inputs, mean: DutyMean) -> Sentence:
    """Return what the loads come to together, and of which one the losses before are."""
    torque, speed = float(inputs.output_torque), float(inputs.worm_speed)
    occurs = any(
        math.isclose(torque, float(p.torque)) and math.isclose(speed, float(p.speed))
        for p in inputs.duty
    )
    return mean.sentence(torque, speed, occurs=occurs, key="duty_mean")


def _shares(parts: Sequence[DutyPart]) -> Iterator[Sentence]:
    """Yield which loads do most of the wear, where it has an answer."""
    order = sorted(enumerate(parts), key=lambda pair: -(pair[1].share or 0.0))
    said = [
        Sentence(
            f"{part.torque:.4g} N m ",
            Number.of(part.share, ".0f", f"duty_cycle.{place}.wear_share", 100.0),
            " %",
        )
        for place, part in order[:_MOST_PARTS]
        if part.share is not None
    ]
    if said:
        yield Sentence("of all wear by ISO/TR 14521: ", Sentence.joined(said))


def _oil(inputs: Inputs, iso: Rating) -> Sentence:
    """Return the temperature of the oil by the balance and by the standard."""
    name = "theta_S_max_degC" if "theta_S_max_degC" in iso else "theta_S_degC"
    values: Any = iso
    said: list[str] = [
        "oil ",
        Number.of(float(values["theta_h_degC"]), ".0f", "iso14521.theta_h_degC"),
        " degC by heat balance, ",
        Number.of(float(values[name]), ".0f", f"iso14521.{name}"),
    ]
    said.append(" as given" if inputs.oil_temperature is not None else " by ISO's formula (S1)")
    housing = inputs.operation.housing
    measured = housing is not None and housing.idle_loss is not None
    idle = Number.of(float(values["loss_idle_W"]), ".3g", "iso14521.loss_idle_W")
    said += ["; idling ", idle, f" W {'measured' if measured else 'by formula'}"]
    return Sentence(*said)
