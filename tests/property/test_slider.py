import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from asperity.friction import Friction
from asperity.slider import Model, Slider, Solve, solve
from asperity.vibration import Vibration

SAMPLES = "wave.csv"


@pytest.fixture(scope="module")
def samples(tmp_path_factory):
    turn = np.linspace(0.0, 2.0 * np.pi, 61)
    time, wave = 5e-4 * turn / turn[-1], np.sin(turn) + 0.3 * np.sin(2.0 * turn + 0.5)
    path = tmp_path_factory.mktemp("samples") / SAMPLES
    rows = (f"{t!r},{u!r}" for t, u in zip(time.tolist(), wave.tolist(), strict=True))
    path.write_text("\n".join(rows))
    return path.parent


SI = st.just("SI")


def sliders(rigid):
    return st.builds(
        lambda compliant, lateral, mass: Slider(
            drive_velocity=0.5e-3, normal_force=50.0, mass=mass, lateral=lateral, **compliant,
            units="SI",
        ),
        st.just({}) if rigid else st.builds(
            dict,
            drive_stiffness=st.floats(1e4, 1e6),
            drive_damping=st.sampled_from([0.0, 20.0, 500.0]),
        ),
        st.sampled_from(["free", "guided"]),
        st.floats(0.2, 5.0),
    )  # fmt: skip


def frictions(models=("coulomb", "dahl", "lugre")):
    elastic = {
        "mu": st.just(0.1),
        "max_deflection": st.floats(2e-8, 3e-7),
        "law": st.sampled_from(["split", "unsplit", "vector"]),
        "transfer": st.sampled_from([0.0, 0.5, 0.71, 1.0]),
    }
    made = {
        "coulomb": st.builds(
            Friction, units=SI, model=st.just("coulomb"),
            mu=st.just(0.1), transfer=elastic["transfer"]
        ),
        "dahl": st.builds(
            Friction, units=SI, exponent=st.sampled_from([0.0, 0.5, 1.0, 1.5, 2.0]), **elastic
        ),
        "lugre": st.builds(
            Friction, units=SI, model=st.just("lugre"), static_mu=st.floats(0.1, 0.2),
            stribeck_velocity=st.floats(1e-4, 1e-2), contact_damping=st.floats(0.0, 300.0),
            viscous_damping=st.floats(0.0, 100.0), **elastic,
        ),
    }  # fmt: skip
    return st.one_of(*(made[model] for model in models))


waves = st.sampled_from(
    [
        {"waveform": "sine", "frequency": 3e3},
        {"waveform": "triangle", "frequency": 4e3},
        {"waveform": "square", "frequency": 2e3, "rise_time": 5e-5},
        {"waveform": "sampled", "samples": SAMPLES},
    ]
)


def vibrations():
    return st.builds(
        lambda wave, **entries: Vibration(**wave, **entries, units="SI"),
        waves,
        velocity_ratio=st.floats(0.1, 20.0),
        direction=st.floats(0.0, 2.0 * math.pi),
        applied_to=st.sampled_from(["base", "body"]),
        start=st.sampled_from([0.0, 1.3e-3]),
    )


def made(slider, friction, vibration, folder, **entries):
    shape = vibration.shape(folder)
    duration = vibration.start + 20.0 / shape.frequency
    return Model(
        slider, friction, vibration, Solve(duration=duration, **entries, units="SI"), shape
    )


bodies = st.one_of(sliders(rigid=True), sliders(rigid=False))


@pytest.mark.slow
@given(bodies, frictions(), vibrations())
@settings(max_examples=50)
def test_the_power_ledger_of_any_body_closes(samples, slider, friction, vibration):
    model = made(slider, friction, vibration, samples)
    answer = solve(model, history=False)
    ledger = answer.ledger
    powers = ledger.drive, ledger.vibration, ledger.friction, ledger.damping, ledger.stored
    assert np.all(np.isfinite(powers))
    missing = ledger.drive + ledger.vibration - ledger.friction - ledger.damping - ledger.stored
    assert abs(missing) <= 1e-9 * max(np.abs(powers))
    # Over a few cycles of a strong vibration a body may hardly be driven at all.
    assume(abs(ledger.drive) > 1e-3 * max(np.abs(powers)))
    assert ledger.residual <= 1e-6
    assert ledger.damping >= 0.0 if model.slider.drive_damping else ledger.damping == 0.0
    if friction.transfer == 1.0:
        assert ledger.untransferred == 0.0


@given(bodies, frictions(("coulomb", "dahl")), vibrations())
@settings(max_examples=50)
def test_friction_stays_within_its_limit_under_every_law_and_exponent(
    samples, slider, friction, vibration
):
    model = made(slider, friction, vibration, samples)
    history = solve(model).history
    force = np.hypot(*history.friction.T) / model.full_friction
    assert np.all(force <= 1.0 + 1e-12)
    if friction.model == "dahl":
        limit = friction.deflection_limit(slider.normal_force)
        np.testing.assert_allclose(np.hypot(*history.deflection.T) / limit, force, 0.0, 1e-12)


@pytest.mark.slow
@given(bodies, frictions(), vibrations())
@settings(max_examples=50)
def test_friction_takes_power_out_of_the_motion(samples, slider, friction, vibration):
    ledger = solve(made(slider, friction, vibration, samples), history=False).ledger
    # Nothing but rounding where the body sticks all the time.
    assert ledger.friction >= -1e-12 * abs(ledger.drive)


def mirrored(model):
    vibration = model.vibration.model_copy(update={"direction": -model.direction}, units="SI")
    return Model(model.slider, model.friction, vibration, model.solve, model.shape)


@pytest.mark.slow
@given(bodies, frictions(), vibrations())
def test_the_mirror_image_of_a_direction_has_the_same_ratio(samples, slider, friction, vibration):
    model = made(slider, friction, vibration, samples)
    here, there = solve(model), solve(mirrored(model))
    assert there.ratio == pytest.approx(here.ratio, abs=1e-9)
    rounding = 1e-9 * model.full_friction
    assert there.friction_max[0] == pytest.approx(here.friction_max[0], abs=rounding)
    assert there.friction_max[1] == pytest.approx(-here.friction_min[1], abs=rounding)
    assert there.friction_min[1] == pytest.approx(-here.friction_max[1], abs=rounding)
    across = np.array([1.0, -1.0])
    off = there.history.friction - here.history.friction * across
    assert np.abs(off).max() <= 1e-8 * model.full_friction


periodic_bodies = st.tuples(
    st.floats(0.3, 20.0),
    st.floats(0.0, math.pi),
    st.sampled_from(["split", "unsplit", "vector"]),
    st.booleans(),
    st.sampled_from([(4e3, 0.5), (3e3, 2.0)]),
)


def periodic(k, direction, law, free, case, turn=0.0):
    frequency, mass = case
    vibration = Vibration(
        frequency=frequency, velocity_ratio=k, direction=direction + turn, units="SI"
    )
    slider = Slider(
        drive_velocity=0.5e-3, normal_force=50.0, drive_stiffness=1e5, mass=mass,
        lateral="free" if free else "guided", units="SI"
    )  # fmt: skip
    friction = Friction(mu=0.1, max_deflection=7e-8, law=law, transfer=0.71, units="SI")
    return solve(Model(slider, friction, vibration, Solve(method="periodic")), history=False)


@pytest.mark.slow
@given(periodic_bodies)
@settings(max_examples=50)
def test_the_periodic_state_is_the_same_for_opposite_directions(entries):
    here, there = periodic(*entries), periodic(*entries, turn=math.pi)
    assert there.ratio == pytest.approx(here.ratio, abs=1e-9)


@pytest.mark.slow
@given(periodic_bodies)
@settings(max_examples=50)
def test_the_periodic_state_is_the_same_for_mirrored_directions(entries):
    k, direction, *rest = entries
    here, there = periodic(*entries), periodic(k, -direction, *rest)
    assert there.ratio == pytest.approx(here.ratio, abs=1e-9)
    assert there.ledger.friction == pytest.approx(here.ledger.friction, rel=1e-8)
