"""Load spectra and housings of any content: an answer without NaN, or one line that refuses."""

import math
from pathlib import Path

import pytest
from apparatus.duties import A100, RUN, safeties
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.errors import AsperityError, InputError
from asperity.rating import Operation, Spectrum, rate, rate_case

NUMBERS = st.one_of(
    st.floats(allow_nan=True, allow_infinity=True).map(repr),
    st.sampled_from(["0", "-1", "1e-300", "1e300", "nan", "inf", "", "many", "1,5", "true"]),
    st.floats(1e-3, 1e3).map(lambda value: f"{value:.4g}"),
)
UNITS = st.sampled_from(["h", "s", "N m", "W", "rpm", "kg", "J/K", "m**2", "W/(m**2 K)", "%", ""])
WORDS = st.sampled_from(
    ["S1", "S2 15 min", "S3 15 %", "S3", "S2", "S3 200 %", "EN 15714-2 A", "EN 15714-2 C", "each",
     "mean", "both", "load", "worm", "uniform", "heavy", "90 deg", "10 min", "500 h", "250 N m"]
)  # fmt: skip
VALUES = st.one_of(
    st.builds(lambda number, unit: f"{number} {unit}".strip(), NUMBERS, UNITS), WORDS, NUMBERS
)
STEP_KEYS = st.sampled_from(
    ["duration", "turns", "share", "output_torque", "input_power", "input_torque", "worm_speed",
     "rotation", "drives", "starts_per_hour", "durations"]
)  # fmt: skip
GOOD = st.builds(
    lambda hours, torque: f'{{ duration = "{hours:.3g} h", output_torque = "{torque:.3g} N m" }}',
    st.floats(0.01, 1e4),
    st.floats(1.0, 366.0),
)


@st.composite
def tables(draw):
    """Settings of both tables, most of them nonsense."""
    found = []
    pairs = st.lists(st.tuples(STEP_KEYS, VALUES), max_size=4, unique_by=lambda pair: pair[0])
    steps = draw(st.lists(st.one_of(GOOD, st.builds(bad_step, pairs)), max_size=3))
    if draw(st.booleans()):
        found.append(f"spectrum.step=[{', '.join(steps)}]")
    for table, keys in (
        ("spectrum", ["duty_class", "life", "stroke", "cycles", "duty", "cycle", "hours_per_day",
                      "shock", "oil_temperature", "step"]),
        ("housing", ["area", "heat_transfer", "at_rest", "base", "idle_loss", "seal_loss",
                     "measured_at", "heat_capacity", "iron", "oil", "aluminium", "lead"]),
    ):  # fmt: skip
        for key in draw(st.lists(st.sampled_from(keys), max_size=3, unique=True)):
            found.append(f"{table}.{key}={draw(VALUES)}")
    return found


def bad_step(pairs):
    said = (f"{key} = {value!r}".replace("'", '"') for key, value in pairs)
    return f"{{ {', '.join(said)} }}"


@pytest.mark.slow
@settings(max_examples=60, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(given=tables())
def test_whatever_the_tables_hold_there_is_an_answer_or_one_line(given):
    case = read_case("gearset-3", case_tables())
    try:
        found = rate_case(case.replace(given))
        text = found.brief()
    except AsperityError as error:
        said = str(error)
    else:
        said = ""
    if said:
        assert "\n" not in said
        assert len(said) > 10
        return
    assert "nan" not in text
    for rating in found.ratings:
        for entry in rating:
            assert not (isinstance(entry.value, float) and math.isnan(entry.value)), entry
    for row in found.endurance:
        assert math.isfinite(row.lasting)
        assert row.hours is None or row.lasting <= row.hours < math.inf


@pytest.mark.slow
def test_the_campaign_draws_spectra_that_are_rated_as_well_as_refused():
    seen = {"rated": 0, "refused": 0}

    @settings(max_examples=60, deadline=None, database=None, derandomize=True,
              suppress_health_check=list(HealthCheck))  # fmt: skip
    @given(steps=st.lists(GOOD, min_size=1, max_size=3))
    def draw(steps):
        case = read_case("gearset-3", case_tables())
        try:
            rate_case(case.replace([f"spectrum.step=[{', '.join(steps)}]"]))
            seen["rated"] += 1
        except InputError:
            seen["refused"] += 1

    draw()
    assert seen["rated"] > 20


@pytest.mark.slow
@settings(max_examples=40, deadline=None)
@given(
    bins=st.lists(
        st.tuples(st.floats(1.0, 250.0), st.floats(100.0, 2000.0), st.floats(0.1, 1e4)),
        min_size=1,
        max_size=6,
    ),
    pieces=st.integers(2, 9),
    seed=st.randoms(use_true_random=False),
)
def test_steps_split_and_shuffled_change_no_safety(bins, pieces, seed):
    def found(parts):
        step = [
            {"duration": hours * 3600.0, "output_torque": torque, "worm_speed": n * math.pi / 30.0}
            for torque, n, hours in parts
        ]
        made = Spectrum.model_validate({"step": step})
        return safeties(rate(A100, Operation(**RUN, spectrum=made)))

    split = [(torque, n, hours / pieces) for torque, n, hours in bins for _ in range(pieces)]
    seed.shuffle(split)
    assert found(split) == pytest.approx(found(bins), rel=1e-12)


def test_a_case_file_with_the_tables_is_rated_from_a_file(tmp_path: Path):
    text = "[spectrum]\nduty_class = 'EN 15714-2 A'\n\n[housing]\nidle_loss = '30 W'\n"
    shipped = Path(read_case("gearset-2", case_tables()).folder) / "gearset-2.toml"
    (tmp_path / "own.toml").write_text(shipped.read_text() + "\n" + text)
    found = rate_case(read_case(tmp_path / "own.toml", case_tables()))
    assert found.iso14521.entry("loss_idle_W").source.name == "the case"
