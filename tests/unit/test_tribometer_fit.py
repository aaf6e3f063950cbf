"""A fit finds what data hold, says how well, and names what they cannot tell."""

import dataclasses
import functools
import math
import re
import signal
from pathlib import Path
from unittest import mock

import numpy as np
import pytest
from apparatus.fit_tables import Tabulated, Together
from apparatus.grid import slow

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.errors import ConvergenceError, InputError
from asperity.friction.dahl import LAWS
from asperity.runs import Interrupted, Run
from asperity.slider.batch import solve_many
from asperity.slider.model import Model
from asperity.tribometer.fit import design, forward, study
from asperity.tribometer.fit.data import read_measurements
from asperity.tribometer.fit.estimate import Fit
from asperity.tribometer.fit.forward import Predictor
from asperity.tribometer.fit.free import Free
from asperity.tribometer.fit.rigid import limit_of
from asperity.tribometer.fit.study import answer, prepare

LIMIT, TRANSFER, EXPONENT = "friction.max_deflection", "friction.transfer", "friction.exponent"
RATIOS = np.geomspace(1.2, 20.0, 12)
NOISE = 0.01
SHARED = "vibration.velocity_ratio,ratio,sd,slider.normal_force [N],vibration.frequency [kHz],"
SHARED += "vibration.direction [deg],slider.mass [kg]\n"
BODIES = (("table-4.3", 55.0, 4.0, 0.0, 0.5), ("table-4.4", 50.8, 3.0, 90.0, 2.0))


def case(name, *settings):
    return read_case(name, case_tables(), settings)


@functools.cache
def exact(name):
    """The model's ratios at the velocity ratios."""
    given = case(name, "solve.method=periodic")
    models = [
        Model.from_case(given.replace_values({"vibration.velocity_ratio": float(k)}))
        for k in RATIOS
    ]
    return np.array([one.ratio for one in solve_many(models)])


def table(path, values, *, head="vibration.velocity_ratio,ratio,sd", noise=NOISE):
    rows = [f"{k:.10g},{value:.10g},{noise}" for k, value in zip(RATIOS, values, strict=True)]
    path.write_text("\n".join([head, *rows]) + "\n", "utf-8")
    return str(path)


def fitted(path, name, free, *settings, **options):
    return answer(prepare(case(name, *settings), data=path, free=",".join(free), **options), Run())


def numbers(result):
    return {one.key: one for one in result.parameters}


@pytest.mark.slow
def test_what_made_the_data_is_found_again(tmp_path):
    path = table(tmp_path / "data.csv", exact("table-4.3"))
    settings = ["friction.max_deflection=75 nm"]
    found = numbers(fitted(path, "table-4.3", [LIMIT, EXPONENT], *settings))
    assert found[LIMIT].value == pytest.approx(68.75e-9, rel=1e-3)
    assert found[EXPONENT].value == pytest.approx(1.0, rel=1e-3)
    assert all(one.identifiable for one in found.values())


@pytest.mark.slow
def test_intervals_are_as_wide_as_the_information_allows(tmp_path):
    path = table(tmp_path / "data.csv", exact("table-4.3"))
    result = fitted(path, "table-4.3", [LIMIT, EXPONENT], next=2)
    found = numbers(result)
    for key, bound in ((LIMIT, 0.065), (EXPONENT, 0.03)):
        low, high = found[key].ends
        assert math.log(high / low) / (2.0 * 1.96) == pytest.approx(bound, rel=0.2)
    assert result.evaluations <= 500
    first, second = result.proposed
    assert all(1.1 < one.conditions["vibration.velocity_ratio"] < 6.0 for one in result.proposed)
    assert second.relative_deviations[LIMIT] < first.relative_deviations[LIMIT] < 0.07


@pytest.mark.slow
def test_the_coefficient_of_friction_is_not_in_ratios_of_a_rigid_drive(tmp_path):
    text = "[slider]\ndrive_velocity='0.5 mm/s'\nnormal_force='55 N'\n[friction]\nmu=0.1\n"
    text += "max_deflection='68.75 nm'\n[vibration]\nfrequency='4 kHz'\nvelocity_ratio=6.0\n"
    (tmp_path / "rigid.toml").write_text(text, "utf-8")
    path = table(tmp_path / "data.csv", np.linspace(0.9, 0.1, 12))
    found = numbers(fitted(path, str(tmp_path / "rigid.toml"), ["friction.mu", LIMIT]))
    assert found["friction.mu"].ends == (None, None)
    assert "does not depend" in found["friction.mu"].why or "not depend" in found["friction.mu"].why
    assert not found["friction.mu"].identifiable


def test_what_is_looked_at_next_spans_the_measurements_however_many_conditions_differ(tmp_path):
    # As rig reduce writes them: sliding velocity, amplitude and frequency of each segment.
    varied = {
        "slider.drive_velocity": (0.042, 0.0425, 0.043), "vibration.frequency": (250.0, 750.0, 1e3),
        "vibration.velocity_amplitude": (0.02, 0.059, 0.03),
    }  # fmt: skip
    rows = [f"0.{n + 5},0.01,{varied['slider.drive_velocity'][n]},"
            f"{varied['vibration.frequency'][n]},{varied['vibration.velocity_amplitude'][n]},90"
            for n in range(3)]  # fmt: skip
    head = "ratio,sd,slider.drive_velocity [m/s],vibration.frequency [Hz],"
    head += "vibration.velocity_amplitude [m/s],vibration.direction [deg]"
    (tmp_path / "data.csv").write_text("\n".join([head, *rows]), "utf-8")
    found = list(design.candidates(read_measurements(tmp_path / "data.csv", case("table-4.4"))))
    assert len(found) == 12**3
    for key, values in varied.items():
        looked = [one[key] for one in found]
        assert (min(looked), max(looked)) == pytest.approx((min(values), max(values)))


@pytest.mark.slow
def test_a_fit_hears_ctrl_c_before_its_next_data_set(tmp_path, monkeypatch):
    solved = []

    def pressed(models, **how):
        solved.append(len(models))
        if len(solved) == 2:
            signal.raise_signal(signal.SIGINT)
        return solve_many(models, **how)

    monkeypatch.setattr(forward, "solve_many", pressed)
    path = table(tmp_path / "data.csv", np.linspace(0.9, 0.1, 12))
    with pytest.raises(Interrupted, match=r"interrupted after 0 of 3 fits and ends of intervals$"):
        fitted(path, "table-4.3", [LIMIT])
    assert solved == [12, 12]


@pytest.mark.slow
def test_transfer_and_amplitude_are_one_number_in_transverse_data(tmp_path):
    # One amplitude at several sliding velocities, as a rig has it.
    amplitude, speeds = 3.0, np.geomspace(0.3, 2.0, 6)
    settings = ["solve.method=periodic", f"vibration.velocity_amplitude={amplitude} mm/s"]
    given = case("table-4.4", *settings)
    models = [
        Model.from_case(given.replace_values({"slider.drive_velocity": 1e-3 * float(one)}))
        for one in speeds
    ]
    values = [one.ratio for one in solve_many(models)]
    rows = [f"{v:.8g},{r:.8g},{NOISE}" for v, r in zip(speeds, values, strict=True)]
    path = tmp_path / "data.csv"
    path.write_text("\n".join(["slider.drive_velocity [mm/s],ratio,sd", *rows]), "utf-8")
    found = numbers(
        fitted(str(path), "table-4.4", [TRANSFER, "vibration.velocity_amplitude"], settings[1])
    )
    assert not any(one.identifiable for one in found.values())
    assert "only together with" in found[TRANSFER].why


@pytest.mark.slow
def test_the_law_that_made_the_data_meets_them_best(tmp_path):
    lines = [SHARED]
    for name, force, frequency, direction, mass in BODIES:
        values = exact(name) + NOISE * np.random.default_rng(1).normal(size=12)
        lines += [
            f"{k:.8g},{value:.8g},{NOISE},{force},{frequency},{direction},{mass}\n"
            for k, value in zip(RATIOS, values, strict=True)
        ]
    (tmp_path / "both.csv").write_text("".join(lines), "utf-8")
    problem = prepare(
        case("table-4.4"), data=str(tmp_path / "both.csv"), free=f"{LIMIT},{TRANSFER}", law="all"
    )
    result = answer(problem, Run())
    laws = {one.law: one for one in result.laws}
    assert result.law == "split"
    assert laws["split"].chi2 < 45.0
    assert min(laws["unsplit"].delta_chi2, laws["vector"].delta_chi2) > 20.0


@pytest.mark.parametrize(
    ("direction", "k"), [(0.0, 1.5), slow(0.0, 6.0), (90.0, 2.0), slow(90.0, 20.0)]
)
def test_a_contact_as_good_as_rigid_is_that_of_its_own_deflection(direction, k):
    # The body itself, stiffer than need be, against the way to the closed form.
    settings = "slider.drive_velocity=5 mm/s", "friction.mu=0.1", "friction.law=split"
    given = case("rig-final", *settings, "slider.normal_force=100 N", "friction.transfer=0.9",
                 "solve.method=periodic", "vibration.frequency=1 kHz",
                 f"vibration.velocity_ratio={k}", f"vibration.direction={direction} deg",
                 "friction.max_deflection=0.7 nm")  # fmt: skip
    model = Model.from_case(given)
    limit = limit_of(model)
    assert limit.deflection > 2.0 * 0.7e-9
    stiff = Model.from_case(given.replace_values({LIMIT: limit.deflection}))
    true, solved = (one.ratio for one in solve_many([model, stiff]))
    assert limit.ratio(solved) == pytest.approx(true, abs=1e-5)
    # However stiff, it asks for no more steps.
    hard = given.replace_values({LIMIT: 1e-13, "slider.mass": None})
    predict = Predictor(hard, "slide", forces=False)
    (value,), why = predict([{}], {})
    assert not why
    assert predict.rigid == 1
    assert value == pytest.approx(limit.rigid, abs=1e-6)


@pytest.mark.slow
def test_a_law_that_cannot_be_fitted_is_told_and_the_others_are(tmp_path, monkeypatch):
    class Partly(Predictor):
        def __call__(self, conditions, given):
            if given["friction.law"] == "vector":
                return np.full(len(conditions), math.nan), {0: "no answer here"}
            return super().__call__(conditions, given)

    monkeypatch.setattr(study, "Predictor", Partly)
    path = table(tmp_path / "data.csv", exact("table-4.4"))
    result = fitted(path, "table-4.4", [LIMIT], law="all")
    assert [one.law for one in result.laws] == [law for law in LAWS if law != "vector"]
    (told,) = result.to_json()["failed"][-1:]
    assert (told["row"], told["law"]) == (None, "vector")
    assert "answers 0 of 12 measurements" in told["why"]
    assert any("law vector is not fitted" in note for note in result.notes)
    with pytest.raises(ConvergenceError, match="answers 0 of 12"):
        fitted(path, "table-4.4", [LIMIT], law="vector")


@pytest.mark.slow
def test_an_uncertain_condition_widens_the_intervals(tmp_path):
    values = exact("table-4.4")
    head = "vibration.velocity_ratio,ratio,sd"
    plain = numbers(fitted(table(tmp_path / "a.csv", values, head=head), "table-4.4", [LIMIT]))
    rows = [
        f"{k:.10g},{v:.10g},{NOISE},{0.05 * k:.6g}" for k, v in zip(RATIOS, values, strict=True)
    ]
    path = tmp_path / "b.csv"
    path.write_text("\n".join([f"{head},sd vibration.velocity_ratio", *rows]), "utf-8")
    wide = numbers(fitted(str(path), "table-4.4", [LIMIT]))
    spans = [math.log(one[LIMIT].ends[1] / one[LIMIT].ends[0]) for one in (plain, wide)]
    assert spans[1] > 1.1 * spans[0]


@pytest.mark.slow
def test_a_gear_on_a_rig_is_fitted_by_the_drive(tmp_path):
    frequencies = (10.0, 20.0)
    given = case("drive-screw")
    rows = [{"vibration.frequency": 1e3 * one} for one in frequencies]
    ratios, why = Predictor(given, "drive", forces=False)(rows, {})
    assert not why
    lines = [f"{f},{ratio:.10g},0.01" for f, ratio in zip(frequencies, ratios, strict=True)]
    path = tmp_path / "data.csv"
    path.write_text("\n".join(["vibration.frequency [kHz],ratio,sd", *lines]))
    free = ["friction.mu"]
    found = numbers(fitted(str(path), "drive-screw", free, "friction.mu=0.12", model="drive"))
    assert found["friction.mu"].value == pytest.approx(0.1344, rel=1e-2)


@pytest.mark.slow
def test_an_elastic_block_is_fitted_by_what_it_settles_to(tmp_path):
    light = "block.elements=[3, 2, 2]", "block.element=hex8", "solve.method=settled"
    path = tmp_path / "data.csv"
    # What this block of eight-node elements settles to with its own 68.75 nm.
    path.write_text("vibration.velocity_ratio,ratio,sd\n2,0.56182,0.005\n", "utf-8")
    start = "friction.max_deflection=65 nm"
    found = fitted(str(path), "block-longitudinal", [LIMIT], start, *light, model="block")
    (one,) = found.parameters
    assert one.value == pytest.approx(68.75e-9, rel=2e-3)
    # A ratio of 0.0024 a nanometre there, of which 0.005 are 2.1 nm.
    low, high = one.ends
    assert (high - low) / (2.0 * 1.96) == pytest.approx(2.1e-9, rel=0.05)
    # A body that is no point is another: what fits the point does not fit the block.
    point = numbers(fitted(str(path), "block-longitudinal", [LIMIT], start))[LIMIT]
    assert point.value != pytest.approx(one.value, rel=2e-3)


def test_semicolons_and_decimal_commas_are_read(tmp_path):
    text = "vibration.velocity_ratio;ratio;sd\n2;0,46;0,01\n3;0,26;0,01\n"
    (tmp_path / "data.csv").write_text(text, "utf-8")
    data = prepare(case("table-4.3"), data=str(tmp_path / "data.csv"), free=LIMIT).data
    assert data.values.tolist() == [0.46, 0.26]
    assert data.conditions[1] == {"vibration.velocity_ratio": 3.0}


REFUSED = {
    "ratio and force": (
        "vibration.velocity_ratio,ratio,force [N],sd\n2,0.5,3,0.1\n", ["keep one of them"]
    ),
    "no sd and nothing to tell it from": (
        "vibration.velocity_ratio,ratio\n2,0.5\n3,0.4\n", ["no column sd", "free fewer"]
    ),
    "sd of a condition alone": (
        "vibration.velocity_ratio,ratio,sd vibration.velocity_ratio\n2,0.5,0.1\n",
        ["without 'sd'", "give both"],
    ),
    "an unknown key": ("vibration.velocity_rato,ratio,sd\n2,0.5,0.01\n", ["velocity_ratio"]),
    "no unit": ("vibration.frequency,ratio,sd\n2,0.5,0.01\n", ["unit", "kHz"]),
    "a wrong unit": ("vibration.frequency [kg],ratio,sd\n2,0.5,0.01\n", ["row 2", "kg"]),
    "sd of zero": ("vibration.velocity_ratio,ratio,sd\n2,0.5,0\n", ["row 2", "above zero"]),
    "a word": ("vibration.velocity_ratio,ratio,sd\n2,x,0.1\n", ["row 2", "'x'"]),
    "a short row": ("vibration.velocity_ratio,ratio,sd\n2,0.5\n", ["row 2", "2 cells"]),
    "too few": ("vibration.velocity_ratio,ratio,sd\n2,0.5,0.01\n", ["fewer than the 2 free"]),
    "empty": ("", ["is empty", "headings"]),
    "sd too small": (
        "vibration.velocity_ratio,ratio,sd\n2,0.5,0.01\n3,0.5,1e-300\n",
        ["row 3: sd is 1e-300 beside ratio 0.5", "at least 5e-08"],
    ),
    "sd too small a part": (
        "vibration.velocity_ratio,force [N],sd\n2,5e6,1e-12\n",
        ["row 2: sd is 1e-12 N beside force 5e+06 N", "at least 0.5 N"],
    ),
    "sd too large": ("vibration.velocity_ratio,ratio,sd\n2,0.5,1e20\n", ["row 2: sd is 1e+20"]),
    "a ratio too large": (
        "vibration.velocity_ratio,ratio,sd\n2,1e20,0.01\n", ["row 2: ratio is 1e+20", "1e+09"]
    ),
    "a force too large": (
        "vibration.velocity_ratio,force [N]\n2,3\n3,-1e20\n", ["row 3: force is -1e+20 N"]
    ),
    "sd of a condition too large": (
        "vibration.velocity_ratio,ratio,sd,sd vibration.velocity_ratio\n2,0.5,0.1,1e300\n",
        ["row 2: 'sd vibration.velocity_ratio' is 1e+300"],
    ),
    "twice": ("ratio,ratio,sd\n1,1,1\n", ["twice"]),
}  # fmt: skip


@pytest.mark.parametrize(
    ("name", "model", "said"),
    [
        ("gearset-3", "slide", "gearset-3: it is a case of another kind, without one of [slider]"),
        (
            "drive-thesis",
            "slide",
            "it has no [slider], which --model slide needs; give --model dri",
        ),
        ("table-4.3", "drive", "it has no [drive], which --model drive needs; give --model slide"),
    ],
)
def test_a_case_without_the_body_of_a_model_is_refused(tmp_path, name, model, said):
    path = table(tmp_path / "data.csv", np.ones(12))
    with pytest.raises(InputError, match=re.escape(said)):
        prepare(case(name), data=path, free="friction.mu", model=model)


@pytest.mark.parametrize("name", REFUSED)
def test_a_table_that_cannot_be_fitted_is_refused_with_its_row(tmp_path, name):
    text, parts = REFUSED[name]
    (tmp_path / "data.csv").write_text(text, "utf-8")
    with pytest.raises(InputError) as refused:
        prepare(case("table-4.3"), data=str(tmp_path / "data.csv"), free=f"{LIMIT},{EXPONENT}")
    told = str(refused.value)
    assert "\n" not in told
    assert all(part in told for part in parts), told


@pytest.mark.parametrize(
    ("options", "part"),
    [
        ({"free": "friction.max_deflecton"}, "max_deflection"),
        ({"free": "friction.law"}, "no number"),
        ({"free": "vibration.velocity_ratio"}, "column"),
        ({"free": "friction.tangential_stiffness"}, "start from"),
        ({"free": f"{LIMIT},{LIMIT}"}, "twice"),
    ],
)
def test_what_is_asked_of_a_fit_is_checked(tmp_path, options, part):
    path = table(tmp_path / "data.csv", np.linspace(0.9, 0.1, 12))
    with pytest.raises(InputError, match=part):
        prepare(case("table-4.3"), data=path, **options)


class Surrogate:
    """A smooth stand-in for the model: saturating curves of two parameters."""

    def __init__(self, rng):
        self.k = np.geomspace(0.5, 8.0, 24)
        self.data = self.curve(np.zeros(2)) + NOISE * rng.normal(size=24)

    def curve(self, point):
        size, power = np.exp(point)
        return 1.0 / (1.0 + (self.k / size) ** power)

    def __call__(self, point):
        return (self.data - self.curve(point)) / NOISE


def test_a_step_to_where_there_is_no_answer_is_turned_back():
    surrogate = Surrogate(np.random.default_rng(1))

    def forward(point):
        if point[0] > 0.5:
            raise ConvergenceError("no answer here")
        return surrogate(point)

    best = Fit(forward, np.full(2, -5.0), np.full(2, 5.0)).least(np.array([-2.5, 0.5]))
    assert best.point == pytest.approx([0.0, 0.0], abs=0.05)


def test_an_interval_ends_open_where_the_model_answers_no_more():
    surrogate = Surrogate(np.random.default_rng(1))

    def forward(point):
        if point[0] > best.point[0] + 0.01:
            raise ConvergenceError("no answer here")
        return surrogate(point)

    best = Fit(surrogate, np.full(2, -5.0), np.full(2, 5.0)).least(np.zeros(2))
    cut = Fit(forward, np.full(2, -5.0), np.full(2, 5.0))
    assert cut.end(best, 0, 1) is None
    assert cut.end(best, 0, -1) < best.point[0]


def test_the_value_of_a_bound_is_within_the_bounds(tmp_path):
    # That of the logarithm of 10, the most of an exponent, was 10.000000000000002, and refused.
    data = read_measurements(Path(table(tmp_path / "data.csv", np.ones(12))), case("table-4.3"))
    for key in (EXPONENT, TRANSFER, LIMIT, "friction.mu", "slider.mass"):
        one = Free.of(key, case("table-4.3", "friction.exponent=0.5"), data)
        low, high = one.bounds
        for logarithm in (low, high, low - 50.0, high + 50.0):
            one.quantity.check(one.value(logarithm))


@pytest.mark.slow
def test_a_key_that_forbids_where_a_fit_goes_is_told_with_what_the_fit_came_to(tmp_path):
    path = tmp_path / "data.csv"
    rows = [f"{speed},{force},0.02" for speed, force in ((1, 1.2), (3, 1.1), (10, 1.1), (30, 1.2))]
    path.write_text("\n".join(["slider.drive_velocity [mm/s],force [N],sd", *rows]) + "\n", "utf-8")
    asked = [
        "friction.model=lugre",
        "friction.mu=0.01",
        "friction.static_mu=0.015",
        "friction.stribeck_velocity=1 mm/s",
    ]
    with pytest.raises(InputError, match=r"the fit comes to friction\.mu = .*static_mu is 0\.015"):
        fitted(str(path), "table-4.3", ["friction.mu"], *asked, "vibration.velocity_ratio=0")


def test_a_parameter_at_its_bound_has_an_open_end():
    surrogate = Surrogate(np.random.default_rng(2))
    fit = Fit(surrogate, np.array([-5.0, -5.0]), np.array([0.005, 5.0]))
    best = fit.least(np.array([-0.5, 0.0]))
    assert fit.end(best, 0, 1) is None
    assert fit.end(best, 0, -1) < 0.0


# Some five standard deviations about the truth; wide enough for where the other laws end.
NEAR = {LIMIT: (42e-9, 115e-9), TRANSFER: (0.63, 0.8), EXPONENT: (0.8, 1.25)}
WIDE = {LIMIT: (45e-9, 110e-9), TRANSFER: (0.42, 1.0)}
ALONG = {LIMIT: 68.75e-9, EXPONENT: 1.0}
BOTH = {LIMIT: 75.49e-9, TRANSFER: 0.71, EXPONENT: 1.0}


class Smooth(Predictor):
    """With states that a body does not stay in: what is tabulated are they, smooth and all."""

    def __call__(self, conditions, given):
        with mock.patch.object(forward, "unsettled", return_value=""):
            return super().__call__(conditions, given)


class Sets:
    """Noisy sets of 12 longitudinal and 12 transverse ratios, refitted."""

    def __init__(self, folder, truth, *, bodies=BODIES, laws=("split",), box=NEAR, nodes=5):
        self.truth, free = truth, list(truth)
        lines = [SHARED]
        for name, force, frequency, direction, mass in bodies:
            lines += [
                f"{k:.10g},{value:.10g},{NOISE},{force},{frequency},{direction},{mass}\n"
                for k, value in zip(RATIOS, exact(name), strict=True)
            ]
        path = folder / "sets.csv"
        path.write_text("".join(lines), "utf-8")
        self.problem = prepare(
            case("table-4.4"), data=str(path), free=",".join(free),
            law="all" if len(laws) > 1 else laws[0],
        )  # fmt: skip
        predict = Smooth(self.problem.case, "slide", forces=False)
        rows = self.problem.data.conditions
        # The transfer is across the sliding, and nothing to what is along it.
        parts = []
        for place, (_, _, _, direction, _) in enumerate(bodies):
            keys = free if direction else [key for key in free if key != TRANSFER]
            parts.append((rows[12 * place : 12 * place + 12], keys))
        self.model = Together(
            {law: [
                Tabulated(predict, part, {key: box[key] for key in keys}, law, nodes)
                for part, keys in parts
             ] for law in laws}
        )  # fmt: skip
        self.exact, _ = predict(rows, {"friction.law": "split", **truth})
        near = {key: 1.05 * value for key, value in truth.items()}
        solved, _ = predict(rows, {"friction.law": "split", **near})
        self.off = np.abs(self.model(rows, {"friction.law": "split", **near})[0] - solved).max()

    def bound(self):
        """Return the deviations of logarithms that the information of a set allows."""
        rows, h = self.problem.data.conditions, 1e-3
        slopes = [
            self.model(rows, {"friction.law": "split"} | self.truth | {key: one * math.exp(h)})[0]
            for key, one in self.truth.items()
        ]
        columns = (np.column_stack(slopes) - self.exact[:, None]) / (h * NOISE)
        return np.sqrt(np.diag(np.linalg.inv(columns.T @ columns)))

    def fitted(self, seed, monkeypatch):
        monkeypatch.setattr(study, "Predictor", lambda *_: self.model)
        noise = NOISE * np.random.default_rng(seed).normal(size=self.exact.size)
        data = dataclasses.replace(self.problem.data, values=self.exact + noise)
        return answer(dataclasses.replace(self.problem, data=data), Run())

    def refitted(self, count, monkeypatch):
        """Return logarithms over the truth, a row a set, and whether intervals hold it."""
        points, held = [], []
        for seed in range(count):
            result = self.fitted(seed, monkeypatch)
            assert result.evaluations <= 500
            points.append([math.log(one.value / self.truth[one.key]) for one in result.parameters])
            held.append([
                (one.ends[0] or 0.0) <= self.truth[one.key] <= (one.ends[1] or math.inf)
                for one in result.parameters
            ])  # fmt: skip
        return np.array(points), np.array(held)


@pytest.mark.slow
def test_400_longitudinal_sets_spread_by_the_bound_and_intervals_cover(tmp_path, monkeypatch):
    sets = Sets(tmp_path, ALONG, bodies=BODIES[:1])
    assert sets.off < 0.03 * NOISE
    points, held = sets.refitted(400, monkeypatch)
    assert sets.bound() == pytest.approx([0.065, 0.032], rel=0.1)
    assert points.std(axis=0) == pytest.approx(sets.bound(), rel=0.2)
    assert np.all((held.mean(axis=0) >= 0.92) & (held.mean(axis=0) <= 0.97))


@pytest.mark.slow
@pytest.mark.campaign(tried_by="test_400_longitudinal_sets_spread_by_the_bound_and_intervals_cover")
def test_400_sets_of_both_directions_spread_by_the_bound_and_cover(tmp_path, monkeypatch):
    sets = Sets(tmp_path, BOTH)
    assert sets.off < 0.03 * NOISE
    points, held = sets.refitted(400, monkeypatch)
    assert sets.bound() == pytest.approx([0.06, 0.02, 0.03], rel=0.25)
    assert points.std(axis=0) == pytest.approx(sets.bound(), rel=0.2)
    assert np.all((held.mean(axis=0) >= 0.92) & (held.mean(axis=0) <= 0.97))


@pytest.mark.slow
def test_transfer_and_exponent_go_together_in_transverse_data(tmp_path, monkeypatch):
    found = Sets(tmp_path, BOTH, bodies=BODIES[1:]).fitted(1, monkeypatch)
    assert found.correlation[1, 2] < -0.95
    assert any("goes with" in one.why or None in one.ends for one in found.parameters)


@pytest.mark.slow
def test_of_100_sets_the_law_that_made_them_is_told(tmp_path, monkeypatch):
    truth = {key: BOTH[key] for key in (LIMIT, TRANSFER)}
    sets = Sets(tmp_path, truth, laws=tuple(LAWS), box=WIDE, nodes=7)
    assert sets.off < 0.2 * NOISE
    told = [sets.fitted(seed, monkeypatch).law for seed in range(100)]
    assert told.count("split") >= 99


@pytest.mark.parametrize("deviation", ["sd", "sd [kN]", "sd [N]"])
def test_a_deviation_is_in_the_unit_of_what_is_measured_unless_it_says_otherwise(
    tmp_path, deviation
):
    file = tmp_path / "data.csv"
    sd = 0.1 if "[N]" in deviation else 1e-4
    file.write_text(f"vibration.velocity_ratio,force [kN],{deviation}\n2,0.0055,{sd}\n")
    found = read_measurements(file, read_case("table-4.4", case_tables()))
    assert (found.values[0], found.deviations[0]) == pytest.approx((5.5, 0.1))


def test_a_deviation_of_a_ratio_has_no_unit(tmp_path):
    file = tmp_path / "data.csv"
    file.write_text("vibration.velocity_ratio,ratio,sd [N]\n2,0.5,0.01\n")
    with pytest.raises(InputError, match="the column sd has a unit beside 'ratio'; leave it out"):
        read_measurements(file, read_case("table-4.4", case_tables()))
