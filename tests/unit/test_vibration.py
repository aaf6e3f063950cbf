import math
import os

import numpy as np
import pytest

from asperity.errors import InputError
from asperity.friction import Friction
from asperity.slider import Model, Slider, Solve
from asperity.vibration import Vibration
from asperity.vibration.waveform import displacement_at, fill_increments

WAVES = {
    "sine": {"waveform": "sine", "frequency": 4000.0},
    "triangle": {"waveform": "triangle", "frequency": 4000.0},
    "square": {"waveform": "square", "frequency": 4000.0, "rise_time": 20e-6},
    "sampled": {"waveform": "sampled", "samples": "wave.csv"},
}


def csv_rows(time, displacement):
    return [f"{t!r},{u!r}" for t, u in zip(time.tolist(), displacement.tolist(), strict=True)]


def write_samples(path, displacement, period=2.5e-4, header="time,displacement\n"):
    displacement = np.append(displacement, displacement[0])
    time = np.linspace(0.0, period, len(displacement))
    rows = "".join(
        f"{t!r},{u!r}\n" for t, u in zip(time.tolist(), displacement.tolist(), strict=True)
    )
    path.write_text(header + rows)
    return path


@pytest.fixture
def folder(tmp_path):
    phase = 2.0 * math.pi * np.arange(64) / 64
    write_samples(tmp_path / "wave.csv", 3e-6 * (np.sin(phase) + 0.25 * np.sin(2 * phase + 0.3)))
    return tmp_path


def refusal(call, *arguments, **entries):
    with pytest.raises(InputError) as raised:
        call(*arguments, **entries)
    assert len(str(raised.value).splitlines()) == 1
    return str(raised.value)


def displacement(shape, cycles):
    """Unit displacement at phases in cycles, from its increments."""
    steps = len(cycles) - 1
    start = shape.increments(-1.0, 1.0 + cycles[0], 1).sum() if cycles[0] > 0.0 else 0.0
    spacing = (cycles[-1] - cycles[0]) / steps
    return start + np.append(0.0, np.cumsum(shape.increments(cycles[0], spacing, steps)))


@pytest.mark.parametrize("wave", WAVES.values(), ids=WAVES)
def test_the_displacement_has_unit_amplitude_and_closes_its_period(wave, folder):
    shape = Vibration(velocity_ratio=1.0, **wave, units="SI").shape(folder)
    u = displacement(shape, np.linspace(1.0, 2.0, 8193))
    assert 0.5 * (u.max() - u.min()) == pytest.approx(1.0, abs=2e-7)
    assert u[-1] == pytest.approx(u[0], abs=1e-12)


@pytest.mark.parametrize("wave", WAVES.values(), ids=WAVES)
def test_the_peak_velocity_is_the_steepest_slope_of_the_displacement(wave, folder):
    vibration = Vibration(displacement_amplitude=2e-7, **wave, units="SI")
    shape = vibration.shape(folder)
    steps = 8192
    slopes = shape.increments(1.0, 1.0 / steps, steps) * steps * shape.frequency * 2e-7
    assert vibration.velocity(shape, 1.0) == pytest.approx(np.abs(slopes).max(), rel=1e-6)


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("sine", 2.0 * math.pi * 4000.0 * 2e-7),
        ("triangle", 4.0 * 4000.0 * 2e-7),
        ("square", 2.0 * 2e-7 / 20e-6),
    ],
)
def test_the_peak_velocity_follows_its_formula(name, expected):
    vibration = Vibration(displacement_amplitude=2e-7, **WAVES[name], units="SI")
    assert vibration.velocity(vibration.shape(), 1.0) == pytest.approx(expected, rel=1e-14)


@pytest.mark.parametrize("wave", WAVES.values(), ids=WAVES)
def test_the_three_forms_of_an_amplitude_agree(wave, folder):
    by_ratio = Vibration(velocity_ratio=6.0, **wave, units="SI")
    shape = by_ratio.shape(folder)
    by_velocity = Vibration(velocity_amplitude=3e-3, **wave, units="SI")
    amplitude = by_velocity.displacement(shape, 0.5e-3)
    by_displacement = Vibration(displacement_amplitude=amplitude, **wave, units="SI")
    assert by_ratio.velocity(shape, 0.5e-3) == pytest.approx(3e-3, rel=1e-15)
    assert by_ratio.displacement(shape, 0.5e-3) == pytest.approx(amplitude, rel=1e-15)
    assert by_displacement.velocity(shape, 0.5e-3) == pytest.approx(3e-3, rel=1e-15)


@pytest.mark.parametrize("name", ["sine", "triangle", "square"])
def test_the_vibration_starts_at_zero_and_rises(name):
    shape = Vibration(velocity_ratio=1.0, **WAVES[name], units="SI").shape()
    assert np.all(shape.increments(-3.0, 0.01, 300) == 0.0)
    first = displacement(shape, np.linspace(0.0, 0.02, 21))
    assert np.all(np.diff(first) > 0.0)
    assert first[0] == 0.0


@pytest.mark.parametrize("ramp", [0.0, 2.0])
@pytest.mark.parametrize("lead", [0.0, 0.25, -0.1])
@pytest.mark.parametrize("wave", WAVES.values(), ids=WAVES)
def test_increments_are_differences_of_displacements_to_the_last_bit(wave, lead, ramp, folder):
    shape = Vibration(velocity_ratio=1.0, **wave, units="SI").shape(folder)
    numbers = shape.wave(lead=lead)._replace(ramp=ramp)
    found = np.empty(300)
    fill_increments(numbers, -1.3, 0.017, found)
    there = [displacement_at(numbers, -1.3 + n * 0.017) for n in range(301)]
    assert found.tolist() == np.diff(there).tolist()


@pytest.mark.parametrize("lead", [0.0, 0.3])
def test_its_amplitude_grows_evenly_from_nothing_and_then_stays(lead):
    shape = Vibration(velocity_ratio=1.0, **WAVES["sine"], units="SI").shape()
    grows = shape.wave(lead=lead)._replace(ramp=2.5)
    for cycles, share in (
        (-0.3, 0.0),
        (0.0, 0.0),
        (0.6, 0.24),
        (1.9, 0.76),
        (2.5, 1.0),
        (7.2, 1.0),
    ):
        expected = share * math.sin(2.0 * math.pi * (cycles + lead))
        assert displacement_at(grows, cycles) == pytest.approx(expected, abs=1e-13)


def test_a_step_across_the_start_moves_only_by_the_part_after_it():
    shape = Vibration(velocity_ratio=1.0, **WAVES["sine"], units="SI").shape()
    (across,) = shape.increments(-0.004, 0.01, 1)
    assert across == pytest.approx(math.sin(2.0 * math.pi * 0.006), rel=1e-14)


def test_before_its_start_a_sampled_wave_rests_where_it_begins(folder):
    shape = Vibration(velocity_ratio=1.0, **WAVES["sampled"], units="SI").shape(folder)
    assert np.all(shape.increments(-3.0, 0.01, 300) == 0.0)
    (first,) = shape.increments(-0.01, 0.02, 1)
    (same,) = shape.increments(1.0, 0.01, 1)
    assert first == pytest.approx(same, abs=1e-9)


def test_a_square_wave_dwells_between_flanks_of_its_rise_time():
    shape = Vibration(velocity_ratio=1.0, **WAVES["square"], units="SI").shape()
    # 20 us are 0.08 of a period at 4 kHz: a flank reaches 0.04 to either side of a crossing.
    u = displacement(shape, np.linspace(0.0, 1.0, 1001))
    assert u[:41] == pytest.approx(np.linspace(0.0, 1.0, 41), abs=1e-12)
    assert u[40:461] == pytest.approx(1.0, abs=1e-12)
    assert u[460:541] == pytest.approx(np.linspace(1.0, -1.0, 81), abs=1e-12)
    assert u[540:961] == pytest.approx(-1.0, abs=1e-12)
    assert u[960:] == pytest.approx(np.linspace(-1.0, 0.0, 41), abs=1e-12)


def test_on_the_steps_of_a_cycle_a_flank_is_the_nearest_that_ends_them():
    shape = Vibration(velocity_ratio=1.0, **WAVES["square"], units="SI").shape()
    rise = shape.rise
    for steps in (4, 8, 10, 25, 38, 100, 1000):
        near = shape.on_corners(steps)
        places = near.corners() * steps
        assert places == pytest.approx(np.round(places), abs=1e-12)
        # Within a step, since both corners of a flank move; or the shortest that there is, of two.
        assert abs(near.rise - rise) <= (1.0 + 1e-12) / steps or near.rise == 2.0 / steps > rise


def test_a_square_wave_that_rises_all_the_time_is_a_triangle():
    square = Vibration(
        waveform="square", frequency=4000.0, rise_time=0.125e-3, velocity_ratio=1.0, units="SI"
    ).shape()
    triangle = Vibration(velocity_ratio=1.0, **WAVES["triangle"], units="SI").shape()
    assert square.steepness == triangle.steepness
    assert square.increments(0.0, 0.001, 1000) == pytest.approx(
        triangle.increments(0.0, 0.001, 1000), abs=1e-14
    )


def test_samples_of_a_sine_are_the_sine(tmp_path):
    phase = 2.0 * math.pi * np.arange(100) / 100
    write_samples(tmp_path / "wave.csv", 7e-6 * np.sin(phase) + 3e-6)
    sampled = Vibration(velocity_ratio=1.0, **WAVES["sampled"], units="SI").shape(tmp_path)
    sine = Vibration(velocity_ratio=1.0, **WAVES["sine"], units="SI").shape()
    assert sampled.frequency == pytest.approx(4000.0, rel=1e-12)
    assert sampled.steepness == pytest.approx(sine.steepness, rel=1e-5)
    cycles = np.linspace(1.0, 2.0, 501)
    assert displacement(sampled, cycles) == pytest.approx(np.sin(2.0 * math.pi * cycles), abs=1e-6)


def test_a_period_of_samples_has_no_mean_and_its_ends_are_counted_once(tmp_path):
    phase = np.linspace(0.0, 2.0 * np.pi, 401)
    write_samples(tmp_path / "wave.csv", np.exp(np.cos(phase)) + 0.3 * np.sin(2.0 * phase))
    shape = Vibration(waveform="sampled", samples="wave.csv", velocity_ratio=1.0).shape(tmp_path)
    assert abs(shape.table[:-1].mean()) < 1e-12


def test_the_scale_and_the_mean_of_samples_do_not_matter(tmp_path):
    wave = np.sin(np.linspace(0.0, 2.0 * math.pi, 40, endpoint=False)) ** 3
    shapes = []
    for name, samples in (("a.csv", wave), ("b.csv", 1e-6 * wave - 4.0e-6)):
        write_samples(tmp_path / name, samples)
        shapes.append(
            Vibration(waveform="sampled", samples=name, velocity_ratio=1.0).shape(tmp_path)
        )
    assert shapes[0].table == pytest.approx(shapes[1].table, abs=1e-9)
    assert shapes[0].steepness == pytest.approx(shapes[1].steepness, rel=1e-9)


def test_samples_need_no_equal_spacing(tmp_path):
    cycles = np.sort(np.concatenate([np.linspace(0.0, 0.5, 60), np.linspace(0.51, 1.0, 30)]))
    u = np.sin(2.0 * math.pi * cycles)
    rows = "".join(
        f"{t * 2.5e-4!r},{x!r}\n" for t, x in zip(cycles.tolist(), u.tolist(), strict=True)
    )
    (tmp_path / "wave.csv").write_text(rows)
    sampled = Vibration(velocity_ratio=1.0, **WAVES["sampled"], units="SI").shape(tmp_path)
    at = np.linspace(1.0, 2.0, 101)
    assert displacement(sampled, at) == pytest.approx(np.sin(2.0 * math.pi * at), abs=2e-5)


def test_a_byte_order_mark_costs_no_sample(tmp_path):
    shapes = []
    for name, mark in (("plain.csv", b""), ("marked.csv", b"\xef\xbb\xbf")):
        path = write_samples(
            tmp_path / name, np.sin(np.linspace(0, 2 * math.pi, 16, False)), header=""
        )
        path.write_bytes(mark + path.read_bytes())
        shapes.append(
            Vibration(waveform="sampled", samples=name, velocity_ratio=1.0).shape(tmp_path)
        )
    assert shapes[0].frequency == shapes[1].frequency
    assert np.array_equal(shapes[0].table, shapes[1].table)


@pytest.mark.parametrize("first", ["0.0,zero", "zero,0.0"])
def test_a_first_row_with_a_number_in_it_is_no_header(tmp_path, first):
    (tmp_path / "wave.csv").write_text("".join(f"{row}\n" for row in [first, *rows_of()[1:]]))
    vibration = Vibration(velocity_ratio=1.0, **WAVES["sampled"], units="SI")
    assert f"line 1 is '{first}'" in refusal(vibration.shape, tmp_path)


@pytest.mark.parametrize("cycles", [1, 20])
def test_samples_of_a_sine_need_the_steps_of_a_sine_for_each_of_its_cycles(tmp_path, cycles):
    phase = 2.0 * math.pi * np.arange(1000) / 1000
    write_samples(tmp_path / "wave.csv", np.sin(cycles * phase))
    shape = Vibration(velocity_ratio=1.0, **WAVES["sampled"], units="SI").shape(tmp_path)
    sine = Vibration(velocity_ratio=1.0, **WAVES["sine"], units="SI").shape()
    assert shape.least_steps == pytest.approx(cycles * sine.least_steps, rel=1e-3)


def test_samples_of_a_square_wave_need_at_least_the_steps_of_the_square_wave(tmp_path):
    square = Vibration(velocity_ratio=1.0, **WAVES["square"], units="SI").shape()
    write_samples(tmp_path / "wave.csv", displacement(square, np.linspace(0.0, 1.0, 1001))[:-1])
    sampled = Vibration(velocity_ratio=1.0, **WAVES["sampled"], units="SI").shape(tmp_path)
    assert square.least_steps == 4.0 / square.rise == 50.0
    assert square.least_steps < sampled.least_steps < 4.0 * square.least_steps


def test_a_step_that_passes_over_what_the_samples_contain_is_refused(tmp_path):
    phase = 2.0 * math.pi * np.arange(1000) / 1000
    write_samples(tmp_path / "wave.csv", np.sin(phase) + 0.1 * np.sin(20.0 * phase))
    body = Slider(drive_velocity=5e-4, normal_force=55.0, units="SI")
    contact = Friction(mu=0.1, max_deflection=1e-7, units="SI")
    vibration = Vibration(velocity_ratio=6.0, **WAVES["sampled"], units="SI")
    shape = vibration.shape(tmp_path)
    coarse = Model(body, contact, vibration, Solve(step=1e-6, units="SI"), shape)
    text = refusal(lambda: coarse.step)
    assert "solve.step is 1e-06 s, too coarse for the vibration of 4000 Hz" in text
    fine = Model(body, contact, vibration, Solve(step=8e-7, units="SI"), shape)
    assert fine.step == 8e-7
    assert Model(body, contact, vibration, Solve(), shape).step == 1.0 / (500 * shape.frequency)


def test_changed_samples_are_read_anew(tmp_path):
    path = write_samples(tmp_path / "wave.csv", np.sin(np.linspace(0, 2 * math.pi, 32, False)))
    vibration = Vibration(velocity_ratio=1.0, **WAVES["sampled"], units="SI")
    first = vibration.shape(tmp_path)
    write_samples(path, np.sin(np.linspace(0, 2 * math.pi, 64, False)), period=1e-3)
    assert first.frequency == pytest.approx(4000.0)
    assert vibration.shape(tmp_path).frequency == pytest.approx(1000.0)


def rows_of(n=64, period=2.5e-4):
    time = np.linspace(0.0, period, n + 1)
    return csv_rows(time, np.sin(2.0 * math.pi * time / period))


def without_some():
    rows = rows_of()
    return rows[:20] + rows[30:]


def unsorted():
    rows = rows_of()
    rows[10], rows[11] = rows[11], rows[10]
    return rows


def replaced(index, text):
    rows = rows_of()
    rows[index] = text
    return rows


SAMPLES = {
    "a gap": (without_some(), "a gap of"),
    "not a number": (replaced(12, "4.6875e-05,nan"), "fill the gap"),
    "infinite": (replaced(12, "4.6875e-05,inf"), "fill the gap"),
    "an empty cell": (replaced(12, "4.6875e-05,"), "two numbers"),
    "one column": (replaced(12, "4.6875e-05"), "two numbers"),
    "a word": (replaced(12, "4.6875e-05,high"), "two numbers"),
    "not closed": (rows_of()[:-8], "to close the period"),
    "too few": (rows_of(6), "at least 8"),
    "unsorted": (unsorted(), "sort the samples"),
    "repeated": (replaced(12, rows_of()[11]), "sort the samples"),
    "constant": ([f"{n * 1e-6},1.0" for n in range(20)], "does not change"),
    "empty": ([], "holds 0 samples"),
}


@pytest.mark.parametrize(("rows", "message"), SAMPLES.values(), ids=SAMPLES)
def test_samples_that_are_no_period_are_refused(rows, message, tmp_path):
    (tmp_path / "wave.csv").write_text("".join(row + "\n" for row in rows))
    vibration = Vibration(velocity_ratio=1.0, **WAVES["sampled"], units="SI")
    text = refusal(vibration.shape, tmp_path)
    assert message in text
    assert str(tmp_path / "wave.csv") in text


def test_a_wrong_sample_is_named_by_its_line(tmp_path):
    rows = ["# by us", "", "time,displacement", *rows_of()[1:]]
    rows[6] = "0.1,x"
    (tmp_path / "wave.csv").write_text("\n".join(rows))
    vibration = Vibration(velocity_ratio=1.0, **WAVES["sampled"], units="SI")
    assert "line 7 is '0.1,x'" in refusal(vibration.shape, tmp_path)


def test_samples_put_in_place_of_others_are_read_though_they_are_no_younger(tmp_path):
    file = tmp_path / "wave.csv"
    vibration = Vibration(velocity_ratio=1.0, **WAVES["sampled"], units="SI")
    for period in (2.5e-4, 5.0e-4):
        file.write_text("\n".join(rows_of(period=period)))
        os.utime(file, ns=(10**18, 10**18))
        assert vibration.shape(tmp_path).frequency == pytest.approx(1.0 / period)


def test_samples_that_cannot_be_read_are_refused(tmp_path):
    vibration = Vibration(velocity_ratio=1.0, **WAVES["sampled"], units="SI")
    assert "cannot be read" in refusal(vibration.shape, tmp_path)
    (tmp_path / "wave.csv").write_bytes(bytes(range(128, 256)))
    assert "cannot be read" in refusal(vibration.shape, tmp_path)
    (tmp_path / "folder.csv").mkdir()
    other = Vibration(velocity_ratio=1.0, waveform="sampled", samples="folder.csv")
    assert "cannot be read" in refusal(other.shape, tmp_path)


def test_a_frequency_that_contradicts_the_samples_is_refused(folder):
    vibration = Vibration(velocity_ratio=1.0, frequency=3000.0, **WAVES["sampled"], units="SI")
    assert "leave the frequency out" in refusal(vibration.shape, folder)
    near = Vibration(velocity_ratio=1.0, frequency=4000.01, **WAVES["sampled"], units="SI")
    text = refusal(near.shape, folder)
    assert "4000.01 Hz" in text
    assert "(4000 Hz); leave the frequency out" in text
    agreeing = Vibration(velocity_ratio=1.0, frequency=4000.001, **WAVES["sampled"], units="SI")
    assert agreeing.shape(folder).frequency == pytest.approx(4000.0, rel=1e-12)


@pytest.mark.parametrize(
    ("entries", "message"),
    [
        ({"waveform": "sampled"}, "vibration.samples is missing"),
        ({"frequency": 1e3, "samples": "wave.csv"}, "vibration.samples is given"),
        ({}, "vibration.frequency is missing"),
        ({"frequency": 0.0}, "vibration.frequency"),
        ({"frequency": -4e3}, "vibration.frequency"),
        ({"frequency": 1e3, "waveform": "square"}, "vibration.rise_time is missing"),
        ({"frequency": 1e3, "rise_time": 1e-5}, "vibration.rise_time is for a square wave"),
        (
            {"frequency": 1e3, "waveform": "square", "rise_time": 6e-4},
            "must not exceed half a period, 0.0005 s",
        ),
        ({"frequency": 1e3, "waveform": "saw"}, "vibration.waveform"),
        ({"frequency": 1e3, "start": -1.0}, "vibration.start"),
        ({"frequency": 1e3, "applied_to": "wall"}, "vibration.applied_to"),
    ],
)
def test_a_vibration_that_makes_no_sense_is_refused(entries, message):
    assert message in refusal(Vibration, units="SI", velocity_ratio=1.0, **entries)


def test_exactly_one_amplitude_is_needed():
    assert "velocity_ratio" in refusal(Vibration, units="SI", frequency=1e3)
    text = refusal(
        Vibration, units="SI", frequency=1e3, velocity_ratio=2.0, velocity_amplitude=1e-3
    )
    assert "velocity_ratio" in text
    assert "velocity_amplitude" in text
    assert "vibration.velocity_ratio" in refusal(
        Vibration, units="SI", frequency=1e3, velocity_ratio=-1.0
    )
