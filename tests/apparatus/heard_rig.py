"""A laboratory's rig that the reduction never saw, and the faults its sensors and cables have.

Simpler than life and of its own making: motors V = k w + R i, discs that push each other with equal
forces, encoders of 32 pulses a turn counted for a second behind a lag, run-out, drift, white and
lasting noise, hum, twelve bits. All of it follows from a seed. A fault is a function of a `Run`,
which it changes.
"""

import dataclasses
import datetime
import json
import math
from collections.abc import Callable
from typing import Any

import numpy as np

from asperity.casefile import read_case
from asperity.tribometer.recording import Recorder, Source
from asperity.tribometer.tables import TABLES

TORQUE = 0.6448
RADII = 0.030, 0.0225
GEARS = 30.0, 60.0
GEAR_EFFICIENCY = 0.7
SUPPLIES = 1.0, 3.0, 5.5
RATIOS = {1.0: (0.12, 0.4), 3.0: (0.6, 0.85), 5.5: (0.88, 0.95)}
"""Torque with vibration over that without, by the supply: between these."""
CONSTANT, RESISTANCE, DRAG, BRONZE_DRAG = 0.0515, 0.30, 0.095, 0.091
BRONZE_SUPPLY = 0.9
ACCELERATION = (
    'channels.acceleration={channel="I", points=[["0 V","0 m/s**2"],["5 V","500 m/s**2"]]}'
)
RANGES = {
    "torque_steel": 5.0, "torque_bronze": 5.0, "speed_steel": 5.0, "speed_bronze": 5.0,
    "drive_voltage": 20.0, "load_cell": 0.05, "current_steel": 1.0, "current_bronze": 1.0,
    "acceleration": 5.0,
}  # fmt: skip
_BITS = 16  # counts: twelve bits in sixteen
_ROUNDS = 3  # after which torques are those of the discs' own angles to 1e-6 N m
_RISE = 0.15  # s in which discs start and stop, and vibration comes up


@dataclasses.dataclass
class Settings:
    """What a run is made of; times in s, torques in N m, volts in V.

    Attributes
    ----------
    white, coloured, memory, hum : float
        Deviation of the torques' noise from sample to sample, of that which lasts, for how long,
        and peak of the mains.
    runout, drift : float
        Shares of the torque: amplitude over a turn of each disc, and change over an hour.
    zeros : dict
        What each sensor shows at rest, in its unit.
    zero_drift : float
        Change of the torque's zero over the run, N m.
    events : bool
        Whether the recording tells what was commanded.
    turned : float
        How long before the recording the discs came to rest, as after a trial run, which encoders
        still show; 0: they stood long since.
    first : float, optional
        How long they then stand before the first cell; left out, as long as between cells.
    """

    volts: float = 1.0
    frequencies: tuple[float, ...] = (250.0, 500.0, 750.0)
    ratios: tuple[float, ...] = (0.31, 0.22, 0.14)
    waveform: str = "sine"
    rest: float = 6.0
    part: float = 8.0
    rate: float = 8e3
    white: float = 8e-3
    coloured: float = 4e-3
    memory: float = 0.2
    hum: float = 1e-3
    runout: float = 0.01
    drift: float = 0.05
    zeros: dict[str, float] = dataclasses.field(default_factory=dict)
    zero_drift: float = 0.0
    events: bool = True
    acceleration: float = 0.0
    overtone: float = 0.03
    bearing: float = 0.01
    effect_late: float = 0.0
    drive_late: float = 0.0
    seed: int = 0
    turned: float = 0.0
    first: float | None = None


@dataclasses.dataclass
class Run:
    """Volts of every channel over time, what was told, and when cells begin, shake and end."""

    given: Settings
    time: np.ndarray
    volts: dict[str, np.ndarray]
    events: list[tuple[float, str, str]]
    lines: dict[str, Any]
    spans: list[tuple[float, float, float]]
    missing: dict[str, np.ndarray] = dataclasses.field(default_factory=dict)
    configured: list[str] = dataclasses.field(default_factory=list)
    rng: np.random.Generator = dataclasses.field(default_factory=np.random.default_rng)

    def si(self, name: str) -> np.ndarray:
        """Return a signal in its unit."""
        return self.lines[name].of(self.volts[name])

    def put(self, name: str, values: np.ndarray) -> None:
        """Take a signal in its unit."""
        self.volts[name] = (values - self.lines[name].offset) / self.lines[name].gain

    def within(self, begin: float, end: float) -> np.ndarray:
        """Where the time lies between two."""
        return (self.time >= begin) & (self.time < end)


def sound_settings(seed: int) -> Settings:
    """Settings of a rig as laboratories have them, drawn by a seed."""
    rng = np.random.default_rng((seed, 1))
    volts = float(rng.choice(SUPPLIES))
    frequencies = sorted(rng.choice((250.0, 500.0, 750.0, 1000.0), 3, replace=False).tolist())
    return Settings(
        volts=volts,
        frequencies=tuple(frequencies),
        ratios=tuple(rng.uniform(*RATIOS[volts], 3).tolist()),
        waveform=str(rng.choice(("sine", "sine", "triangle"))),
        rest=float(rng.uniform(4.0, 8.0)),
        part=float(rng.uniform(6.0, 9.0)),
        white=float(rng.uniform(2e-3, 12e-3)),
        coloured=float(rng.uniform(1e-3, 5e-3)),
        memory=float(rng.uniform(0.1, 0.5)),
        hum=float(rng.uniform(0.0, 3e-3)),
        runout=float(rng.uniform(0.0, 0.02)),
        drift=float(rng.uniform(-0.15, 0.15)),
        zeros={
            "torque_steel": float(rng.normal(0.0, 1e-3)),
            "torque_bronze": float(rng.normal(0.0, 1e-3)),
            "current_steel": float(rng.normal(0.0, 3e-3)),
            "current_bronze": float(rng.normal(0.0, 3e-3)),
        },
        events=bool(rng.random() < 0.5),
        acceleration=float(rng.choice((0.0, rng.uniform(40.0, 250.0)))),
        overtone=float(rng.uniform(0.0, 0.1)),
        bearing=float(rng.uniform(0.0, 0.03)),
        seed=seed,
    )


def made(given: Settings, fault: Callable[[Run], None] | None = None) -> Run:
    """Return a run of three cells: at rest, sliding, with vibration, at rest."""
    rng = np.random.default_rng((given.seed, 2))
    count = len(given.frequencies)
    first = given.rest if given.first is None else given.first
    total = first + count * (2.0 * given.part + given.rest)
    time = np.arange(round(total * given.rate)) / given.rate
    on, shaken, drive = np.zeros(time.size), np.zeros(time.size), np.zeros(time.size)
    phase, vibrates = np.zeros(time.size), np.zeros(time.size)
    events, spans = [], []
    for place, (frequency, ratio) in enumerate(zip(given.frequencies, given.ratios, strict=True)):
        start = first + place * (2.0 * given.part + given.rest)
        begin, end = start + given.part, start + 2.0 * given.part
        spans.append((start, begin, end))
        on[(time >= start) & (time < end)] = 1.0
        late = begin + given.drive_late
        here = (time >= late) & (time < end)
        drive[here] = 1.0
        phase[here] = frequency * (time[here] - late)
        acts = (time >= late + given.effect_late) & (time < end)
        shaken[acts], vibrates[acts] = 1.0 - ratio, 1.0
        events += [
            (start, "steel_supply", f"{given.volts:g} V"),
            (start, "bronze_supply", f"{BRONZE_SUPPLY:g} V"),
            (begin, "vibration", f"{given.waveform} {frequency:g} Hz"),
            (end, "vibration", "off"), (end, "steel_supply", "off"), (end, "bronze_supply", "off"),
        ]  # fmt: skip
    on, shaken = _risen(on, given.rate), _risen(shaken, given.rate)
    lasting = [_lasting(given, time.size, rng) for _ in range(2)]
    start_angles = rng.uniform(0.0, 2.0 * math.pi, 2)
    share = 1.0 + given.drift * (time - 0.5 * total) / 3600.0
    bronze = on * _bronze_speed()
    speed, force = on * _speed(given, TORQUE), np.zeros(time.size)
    for _ in range(_ROUNDS):
        # A disc that is braked is behind, and so is its run-out.
        swung = share.copy()
        for turning, gear, begun in zip((speed, bronze), GEARS, start_angles, strict=True):
            swung += given.runout * np.cos(np.cumsum(turning) / given.rate / gear + begun)
        force = TORQUE / RADII[0] * on * (1.0 - shaken) * swung + lasting[0] / RADII[0] * on
        speed = on * np.maximum(_speed(given, RADII[0] * force), 0.0)
    torque = RADII[0] * force
    hum = given.hum * np.sin(2.0 * math.pi * 50.0 * time) + given.hum / 3.0 * np.sin(
        2.0 * math.pi * 150.0 * time
    )
    noise = rng.standard_normal((9, time.size), dtype=np.float32)
    zeros = given.zeros
    drift = given.zero_drift * (time / total)
    wave = _wave(given.waveform, phase)
    signals = {
        "torque_steel": torque + on * given.bearing + hum + given.white * noise[0] + drift,
        "torque_bronze": -RADII[1] * force + on * given.bearing + hum + given.white * noise[1],
        "speed_steel": _encoder(speed, given) + 0.3 * noise[2],
        "speed_bronze": _encoder(bronze, given) + 0.03 * noise[3],
        "drive_voltage": 5.0 * drive + 7.0 * drive * wave + 0.02 * noise[4],
        "load_cell": 0.014 + 2e-4 * noise[5],
        "current_steel": on * _current(torque) + 0.02 * noise[6],
        "current_bronze": on * BRONZE_DRAG / CONSTANT + 0.02 * noise[7],
    }
    # Sensors move a little with everything that turns: run-out of the torques' noise at rest, too.
    signals["torque_steel"] += lasting[1] * 0.3
    settings = [f'drives.steel_supply="{given.volts:g} V"']
    if given.acceleration:
        tone = np.sin(2.0 * math.pi * phase - 0.7) + given.overtone * np.sin(4.0 * math.pi * phase)
        signals["acceleration"] = given.acceleration * vibrates * tone + 0.5 * noise[8]
        settings.append(ACCELERATION)
    for name, value in zeros.items():
        signals[name] = signals[name] + value
    channels = read_case("rig-final", TABLES, settings)["channels"].mapped()
    lines = {name: channel.line() for name, channel in channels.items()}
    run = Run(
        given, time, {}, events, lines, spans,
        configured=settings,
        rng=np.random.default_rng((given.seed, 3)),
    )  # fmt: skip
    for name, values in signals.items():
        run.put(name, values)
    if fault is not None:
        fault(run)
    return run


def truths(given: Settings) -> list[dict[str, float]]:
    """What is true of each cell: changes of torque and power, %, and the torque before, N m."""
    return [_truth(given, ratio) for ratio in given.ratios]


def _truth(given: Settings, ratio: float) -> dict[str, float]:
    before, shaken = (TORQUE * one + given.bearing for one in (1.0, ratio))
    speeds = _speed(given, TORQUE), _speed(given, TORQUE * ratio)
    return {
        "torque": 100.0 * (shaken / before - 1.0),
        "power": 100.0 * (shaken * speeds[1] / (before * speeds[0]) - 1.0),
        "level": before,
    }


def _current(torque):
    return (DRAG + torque / (GEARS[0] * GEAR_EFFICIENCY)) / CONSTANT


def _speed(given, torque):
    return (given.volts - RESISTANCE * _current(torque)) / CONSTANT


def _bronze_speed():
    return (BRONZE_SUPPLY - RESISTANCE * BRONZE_DRAG / CONSTANT) / CONSTANT


def _risen(course, rate):
    from scipy.signal import lfilter

    keep = math.exp(-1.0 / (rate * _RISE / 4.0))
    return lfilter([1.0 - keep], [1.0, -keep], course)


def _lasting(given, count, rng):
    from scipy.signal import lfilter

    keep = math.exp(-1.0 / (given.rate * given.memory))
    kicks = given.coloured * math.sqrt(1.0 - keep * keep) * rng.standard_normal(count)
    return lfilter([1.0], [1.0, -keep], kicks, zi=[keep * given.coloured * rng.standard_normal()])[
        0
    ]


def _wave(waveform, phase):
    if waveform == "triangle":
        return 1.0 - 4.0 * np.abs((phase + 0.25) % 1.0 - 0.5)
    return np.sin(2.0 * math.pi * phase)


def _encoder(speed, given, pulses=32):
    """Pulses counted for a second at a time, behind a filter of 0.2 s."""
    from scipy.signal import lfilter

    gate = round(given.rate)
    earlier = round(3.0 * given.rate) if given.turned else 0
    if given.turned:
        stood = np.zeros(round(given.turned * given.rate))
        ran = np.full(earlier, np.median(speed[speed > 0.5 * speed.max()]))
        speed, earlier = np.concatenate((ran, stood, speed)), earlier + stood.size
    turns = np.cumsum(speed) / given.rate / (2.0 * math.pi)
    counted = np.floor(turns[gate - 1 :: gate] * pulses)
    shown = np.diff(counted, prepend=0.0) * 2.0 * math.pi / pulses
    course = np.concatenate((np.zeros(gate), np.repeat(shown, gate)))[: speed.size]
    course = np.pad(course, (0, max(speed.size - course.size, 0)), mode="edge")
    keep = math.exp(-1.0 / (given.rate * 0.2))
    return lfilter([1.0 - keep], [1.0, -keep], course)[earlier:]


def recorded(run: Run, path):
    """Write a run as a recording of the rig `rig-final`."""
    case = read_case("rig-final", TABLES, run.configured)
    scales = {name: RANGES[name] / 32767.0 for name in run.volts}
    sources = [Source(name, "V", scale) for name, scale in scales.items()]
    columns = []
    for name, scale in scales.items():
        counts = _BITS * np.round(run.volts[name] / (scale * _BITS))
        counts = np.where(np.abs(counts) > 32766, np.sign(counts) * 32767, counts)
        counts[run.missing.get(name, np.zeros(0, dtype=int))] = -32768
        columns.append(counts.astype(np.int16))
    recorder = Recorder(
        path, sources, 1.0 / run.given.rate, configuration=json.dumps(case.raw, default=str),
        start=datetime.datetime(2026, 3, 1, 12, tzinfo=datetime.UTC), simulated=True,
        block=1 << 16,
    )  # fmt: skip
    if run.given.events:
        for event in run.events:
            recorder.event(*event)
    counts = np.column_stack(columns)
    for first in range(0, len(counts), 1 << 16):
        part = counts[first : first + (1 << 16)]
        recorder.append(part, (first + len(part)) / run.given.rate)
    recorder.close(compress=False)
    return path


def _exchanged(one, other):
    def fault(run):
        run.volts[one], run.volts[other] = run.volts[other], run.volts[one]

    return fault


def _inverted(name):
    def fault(run):
        run.volts[name] = -run.volts[name]

    return fault


def _zero_off(run):
    run.volts["torque_steel"] += 0.030 / 0.4


def _zeros_off(share):
    """The speed's zero is off by so much of its level, and the torque's by 30 mN m."""

    def fault(run):
        _zero_off(run)
        level = np.median(run.volts["speed_steel"][run.within(*run.spans[0][:2])])
        run.volts["speed_steel"] += share * level

    return fault


def _zero_drifts(run):
    run.volts["torque_steel"] += 0.025 / 0.4 * run.time / run.time[-1]


def _zero_jumps(run):
    run.volts["torque_steel"][run.time > run.spans[1][1]] += 0.030 / 0.4


def _held_at(name, value):
    def fault(run):
        run.volts[name] = np.full(run.time.size, value)

    return fault


def _encoder_stuck(run):
    level = np.median(run.volts["speed_steel"][run.within(*run.spans[0][:2])])
    run.volts["speed_steel"] = level + 2e-3 * run.rng.standard_normal(run.time.size)


def _encoder_dies(run):
    late = run.time > 0.5 * sum(run.spans[1][1:])
    run.volts["speed_steel"][late] = run.volts["speed_steel"][late][0]


def _torque_frozen(run):
    for _, begin, end in run.spans:
        here = run.within(begin + 0.5, end)
        run.volts["torque_steel"][here] = run.volts["torque_steel"][here][0]


def _saturates(name, share):
    def fault(run):
        level = np.median(run.volts[name][run.within(*run.spans[0][:2])])
        run.volts[name] = np.minimum(run.volts[name], share * level)

    return fault


def _torque_clipped(run):
    """Let the most that the torque is read as be what only a few of its samples are below."""
    before = run.volts["torque_steel"][run.within(*run.spans[0][:2])]
    run.volts["torque_steel"] = np.minimum(run.volts["torque_steel"], np.quantile(before, 0.03))


def _about_middle(run, shape):
    """Change the drive signal about its middle, where there is vibration."""
    for place, (_, begin, end) in enumerate(run.spans):
        here = run.within(begin + run.given.drive_late, end)
        part = run.volts["drive_voltage"][here]
        run.volts["drive_voltage"][here] = 5.0 + shape(part - 5.0, run.time[here] - begin, place)


def _drive_decays(run):
    part = run.given.part
    _about_middle(run, lambda wave, time, _: wave * 0.13 ** (time / part))


def _square(run):
    _about_middle(run, lambda wave, *_: 7.0 * np.sign(wave))


def _clipped(run):
    _about_middle(run, lambda wave, *_: np.clip(wave, -7.0, 3.5))


def _half_in_one(run):
    _about_middle(run, lambda wave, _, place: wave * (0.5 if place == 1 else 1.0))


def _drive_breaks(run):
    _about_middle(run, lambda wave, time, _: wave * ((time < 4.0) | (time > 4.6)))


def _drive_before(run):
    """The vibration is on all the time, half as strong, in what should be without."""
    for (start, begin, _), frequency in zip(run.spans, run.given.frequencies, strict=True):
        here = run.within(start, begin)
        wave = np.sin(2.0 * math.pi * frequency * run.time[here])
        run.volts["drive_voltage"][here] += 1.0 * wave


def _hum_heard(run):
    hum = 500.0 * np.sin(2.0 * math.pi * 50.0 * run.time)
    run.put("acceleration", np.clip(0.4 * run.si("acceleration") + 0.6 * hum, -499.0, 499.0))


def _overtone_heard(run):
    heard = np.zeros(run.time.size)
    for (_, begin, end), frequency in zip(run.spans, run.given.frequencies, strict=True):
        here = run.within(begin, end)
        turn = 2.0 * math.pi * frequency * run.time[here]
        heard[here] = 40.0 * np.sin(turn) + 200.0 * np.sin(2.0 * turn + 0.3)
    run.put("acceleration", heard + 0.5 * run.rng.standard_normal(run.time.size))


def _loose(name):
    def fault(run):
        for begin in np.arange(run.spans[0][0] + 1.7, run.time[-1], 2.3):
            run.volts[name][run.within(begin, begin + 0.15)] = 0.0

    return fault


def _spikes(run):
    for begin in np.arange(run.spans[0][0] + 1.7, run.time[-1], 1.1):
        run.volts["torque_steel"][run.within(begin, begin + 0.01)] += 3.0


def _copied(name, source):
    def fault(run):
        run.volts[name] = run.volts[source].copy()

    return fault


def _gain(name, factor):
    def fault(run):
        run.volts[name] = factor * run.volts[name]

    return fault


def _both(factor):
    def fault(run):
        for name in ("torque_steel", "torque_bronze"):
            run.volts[name] = factor * run.volts[name]

    return fault


def _picked_up(torque):
    """Both torque channels hear the drive, alike in all cells, as the radii have it."""

    def fault(run):
        for _, begin, end in run.spans:
            here = run.within(begin, end)
            for name, share in (("torque_steel", 1.0), ("torque_bronze", -RADII[1] / RADII[0])):
                run.volts[name][here] += share * torque / run.lines[name].gain

    return fault


def _bent(run):
    """The torque's sensor is not linear: it shows 15 % less at its level before vibration."""
    torque = run.si("torque_steel")
    run.put("torque_steel", torque * (1.0 - 0.15 * np.abs(torque) / TORQUE))


def _supply_told(volts):
    def fault(run):
        run.configured = [f'drives.steel_supply="{volts:g} V"', *run.configured[1:]]
        run.events = [
            (time, kind, f"{volts:g} V" if kind == "steel_supply" and text != "off" else text)
            for time, kind, text in run.events
        ]

    return fault


def _nan(run):
    for start, _, _ in run.spans:
        run.missing["torque_steel"] = np.append(
            run.missing.get("torque_steel", np.zeros(0, dtype=int)),
            np.flatnonzero(run.within(start + 4.0, start + 4.01)),
        )


def _nan_in_drive(run):
    for _, begin, end in run.spans:
        run.missing["drive_voltage"] = np.append(
            run.missing.get("drive_voltage", np.zeros(0, dtype=int)),
            np.flatnonzero(run.within(0.5 * (begin + end), 0.5 * (begin + end) + 0.3)),
        )


def _noisy(run):
    """A screen that is off its cable: the torque hears everything."""
    for _, begin, end in run.spans:
        here = run.within(begin, end)
        run.volts["torque_steel"][here] += 1.0 * run.rng.standard_normal(np.count_nonzero(here))


def _coarse(name, volts):
    """A channel on too wide a range: its noise does not reach across a step."""

    def fault(run):
        run.volts[name] = volts * np.round(run.volts[name] / volts)

    return fault


HEARS = {"acceleration": 150.0}
AT_3_V = {"volts": 3.0, "ratios": (0.75, 0.9, 0.95)}
FAULTS: dict[str, tuple[Callable[[Run], None] | None, dict[str, Any]]] = {
    "zero off by 30 mN m": (_zero_off, {}),
    "drifting zero": (_zero_drifts, {}),
    "zero that jumps": (_zero_jumps, {}),
    "torque and load cell exchanged": (_exchanged("torque_steel", "load_cell"), {}),
    "torques exchanged": (_exchanged("torque_steel", "torque_bronze"), {}),
    "speeds exchanged": (_exchanged("speed_steel", "speed_bronze"), {}),
    "currents exchanged": (_exchanged("current_steel", "current_bronze"), {}),
    "torque and current exchanged": (_exchanged("torque_steel", "current_steel"), {}),
    "torque inverted": (_inverted("torque_steel"), {}),
    "speed inverted": (_inverted("speed_steel"), {}),
    "current inverted": (_inverted("current_steel"), {}),
    "encoder stuck at a value": (_encoder_stuck, {}),
    "encoder of the bronze disc dead": (_held_at("speed_bronze", 0.0), {}),
    "encoder that dies": (_encoder_dies, {}),
    "torque frozen with vibration": (_torque_frozen, {}),
    "torque dead": (_held_at("torque_steel", 0.0), {}),
    "current dead": (_held_at("current_steel", 0.1), {}),
    "torque saturates below its range": (_saturates("torque_steel", 0.8), {}),
    "torque saturates within its noise": (_torque_clipped, {}),
    "current saturates below its range": (_saturates("current_steel", 0.9), {}),
    "torque in steps of 0.25 V": (_coarse("torque_steel", 0.25), {}),
    "drive decays to 13 %": (_drive_decays, {}),
    "vibration 3 s after its command": (None, {"drive_late": 3.0, "events": True}),
    "vibration acts 3 s after its drive": (None, {"effect_late": 3.0}),
    "square wave": (_square, {"waveform": "sine"}),
    "drive clipped on one side": (_clipped, {"waveform": "sine"}),
    "drive half as strong in one cell": (_half_in_one, {}),
    "drive that breaks": (_drive_breaks, {}),
    "drive before vibration": (_drive_before, {}),
    "accelerometer hears hum": (_hum_heard, HEARS),
    "accelerometer hears an overtone": (_overtone_heard, HEARS),
    "accelerometer dead": (_held_at("acceleration", 0.1), HEARS),
    "loose contact of the torque": (_loose("torque_steel"), {}),
    "spikes on the torque": (_spikes, {}),
    "torque is a copy of the other": (_copied("torque_steel", "torque_bronze"), {}),
    "bronze torque is a copy": (_copied("torque_bronze", "torque_steel"), {}),
    "bronze speed is a copy": (_copied("speed_bronze", "speed_steel"), {}),
    "torque told twice as large": (_gain("torque_steel", 2.0), {}),
    "current told half as large": (_gain("current_steel", 0.5), {}),
    "current told 1.7 times as large": (_gain("current_steel", 1.7), {}),
    "speed told four times as large": (_gain("speed_steel", 4.0), {}),
    "speed told half as large again": (_gain("speed_steel", 1.5), AT_3_V),
    "speed of the bronze disc told twice as large": (_gain("speed_bronze", 2.0), {}),
    "speed of the bronze disc told half as large again": (
        _gain("speed_bronze", 1.5), AT_3_V | {"part": 10.0}
    ),
    "speed of the bronze disc told 0.7 times as large": (
        _gain("speed_bronze", 0.7), {"part": 10.0}
    ),
    "both torques told half as large again": (_both(1.5), {}),
    "both torques told 0.6 times as large": (_both(0.6), {}),
    "supply of 3 V told as 5.5 V": (_supply_told(5.5), AT_3_V),
    "drive picked up by both torques": (_picked_up(-0.04), AT_3_V),
    "drive picked up by both torques, the other way": (_picked_up(0.04), AT_3_V),
    "drive picked up by both torques, a little": (
        _picked_up(0.03), AT_3_V | {"ratios": (0.6, 0.72, 0.85)}
    ),
    "samples missing in the torque": (_nan, {}),
    "samples missing in the drive": (_nan_in_drive, {}),
    "torque hears the vibration's amplifier": (_noisy, {}),
    "zeros of torque and speed off": (_zeros_off(0.15), {}),
    "zero of the speed far off": (_zeros_off(-0.4), {}),
}  # fmt: skip


SMALL = {"rate": 4e3, "part": 6.0, "rest": 4.0, "frequencies": (250.0, 500.0, 750.0)}
"""Settings of recordings that are soon made."""
SPARED = {"drive half as strong in one cell": {0, 2}, "encoder that dies": {0}}
"""Segments that a fault leaves as they are; others spoil all."""


def faulty(name, seed, path, **settings):
    """Write a recording with a fault, of a rig drawn by a seed."""
    fault, needed = FAULTS[name]
    given = dataclasses.replace(sound_settings(seed), **settings | needed)
    return recorded(made(given, fault), path)


def sound(seed, path, **settings):
    """Write a recording without a fault, of a rig drawn by a seed."""
    return recorded(made(dataclasses.replace(sound_settings(seed), **settings)), path)


def exported(seed, path, **settings):
    """Write a sound recording as a program exports it, of discs that were tried just before.

    Returns how to import it: the file, and settings of `rig-final`.
    """
    from scipy.io import savemat

    rng = np.random.default_rng((seed, 5))
    drawn = {"first": float(rng.uniform(0.5, 2.5)), "turned": float(rng.uniform(0.05, 1.0))}
    given = dataclasses.replace(sound_settings(seed), **drawn | settings)
    run = made(given)
    names = [chr(ord("A") + place) for place in range(len(run.volts))]
    channels = read_case("rig-final", TABLES, run.configured)["channels"].mapped()
    volts = {channels[name].channel: values for name, values in run.volts.items()}
    assert sorted(volts) == names
    savemat(path, {"fs": given.rate} | {key: one.astype(np.float32) for key, one in volts.items()})
    return path, [*run.configured, f'drives.bronze_supply="{BRONZE_SUPPLY:g} V"']
