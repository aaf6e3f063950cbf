"""Whether an answer has settled is a field of it, which all who show or use it heed."""

import numpy as np
import pytest
from apparatus.grid import grid, slow
from observe import new_cache

from asperity.casefile import read_case
from asperity.results import read
from asperity.slider import TABLES, Model, solve, solve_many
from asperity.slider.fading import still_to_come
from asperity.sweep import run

EARLY = "solve.duration=0.3 s", "vibration.start=10 ms"
SHORT = *EARLY, "vibration.velocity_ratio=0.5"


def body(*settings, name="table-4.3"):
    return Model.from_case(read_case(name, TABLES, settings))


@pytest.mark.parametrize("method", ["march", "periodic", "homogenised"])
def test_a_body_in_a_lasting_state_has_settled(method):
    answer = solve(body(f"solve.method={method}", "solve.duration=1 s"), history=False)
    assert answer.settled, answer.settled_by
    assert answer.settled_by
    assert not answer.headline()


def test_a_march_that_is_too_short_has_not_settled_and_says_so_above_its_numbers():
    answer = solve(body(*SHORT), history=False)
    assert not answer.settled
    assert "the halves of the window differ" in answer.settled_by
    assert answer.settled_by in answer.headline()[0]


RINGS = "normal.damping_ratio=0", "solve.method=march", "solve.duration=10 ms"


def test_no_duration_is_advised_for_a_contact_that_nothing_damps():
    model = body(*RINGS, name="pin-on-disc")
    answers = solve(model), *solve_many([model, model])
    for answer in answers:
        assert not answer.settled
        assert any(note.startswith("no solve.duration is foreseen") for note in answer.notes)
        assert not any("would do, by the means" in note for note in answer.notes)
    # Nor is its mean drawn as if it were a prediction.
    assert "not settled, no prediction" in answers[0].plot().axes[0].get_title("left")
    settled = solve(body("solve.method=periodic")).plot().axes[0].get_title("left")
    assert settled.endswith(r"0.137 $\mu F_N$")


def test_a_vibration_that_still_grows_has_not_settled():
    answer = solve(body("vibration.ramp=0.1 s", "vibration.start=0 s", "solve.duration=0.12 s"))
    assert not answer.settled
    assert "grows into the window" in answer.settled_by


def test_many_bodies_settle_as_each_by_itself():
    bodies = [body(*SHORT), body(*EARLY), body(*SHORT)]
    for one, of_many in zip(bodies, solve_many(bodies), strict=True):
        alone = solve(one, history=False)
        assert (of_many.settled, of_many.settled_by) == (alone.settled, alone.settled_by)


def test_files_and_json_say_whether_and_by_what(tmp_path):
    answer = solve(body(*SHORT), history=False)
    told = answer.to_json()
    assert told["settled"] is False
    assert told["settled_by"] == answer.settled_by
    assert "step_error" in told
    attributes = read(answer.save(tmp_path / "slide.nc")).to_dataset().attrs
    assert attributes["settled"] == 0
    assert attributes["settled_by"] == answer.settled_by


class TestASweep:
    @pytest.fixture(scope="class", autouse=True)
    @staticmethod
    def swept(tmp_path_factory):
        with pytest.MonkeyPatch.context() as patch:
            patch.setenv("ASPERITY_CACHE", str(new_cache(tmp_path_factory.mktemp("user"))))
            yield run(read_case("table-4.3", TABLES, EARLY), ["vibration.velocity_ratio=0.5,6"])

    def test_has_a_variable_of_what_has_settled(self, swept):
        assert swept.arrays["settled"].tolist() == [0.0, 1.0]
        assert swept.to_dataset()["settled"].values.tolist() == [0.0, 1.0]
        assert swept.to_json()["settled"] == [0.0, 1.0]

    def test_marks_the_points_that_have_not_in_its_table(self, swept):
        (table,) = swept.tables()
        shown = [row[-1].endswith("*") for row in table.rows]
        assert shown == [True, False]
        assert any(remark.startswith("* 1 point has not settled") for remark in table.remarks)

    def test_and_in_its_picture(self, swept):
        (panel,) = swept.figure().axes
        assert [text.get_text() for text in panel.get_legend().get_texts()] == ["not settled"]
        crosses = [line for line in panel.lines if line.get_marker() == "x"]
        assert [line.get_xdata().tolist() for line in crosses] == [[0.5]]

    def test_of_two_axes_too_whose_lines_keep_their_names(self):
        axes = ["vibration.velocity_ratio=0.5,6", "friction.law=split,vector"]
        (panel,) = run(read_case("table-4.3", TABLES, EARLY), axes).figure().axes
        names = [text.get_text() for text in panel.get_legend().get_texts()]
        assert names == ["split", "vector", "not settled"]


def longer(answer):
    """Return the duration that an answer says would do, as it says it."""
    (said,) = [note for note in answer.notes if "would do, by the means" in note]
    return f"solve.duration={said.removeprefix('a solve.duration of ').partition(' s ')[0]} s"


@pytest.mark.ordinary(2)
@pytest.mark.parametrize(("ratio", "duration"), grid([0.5, 2, 6], ["40 ms", "0.1 s"]))
def test_a_march_that_is_too_short_says_what_duration_would_do_and_that_does(duration, ratio):
    given = "vibration.start=10 ms", f"vibration.velocity_ratio={ratio}"
    short = solve(body(*given, f"solve.duration={duration}"), history=False)
    assert not short.settled
    assert solve(body(*given, longer(short)), history=False).settled


def test_bodies_of_a_batch_say_the_same():
    bodies = [body(*SHORT), body(*EARLY), body(*SHORT, "vibration.velocity_ratio=2")]
    for one, of_many in zip(bodies, solve_many(bodies), strict=True):
        assert of_many.notes == solve(one, history=False).notes


SLOW = (
    "slider.drive_velocity=0.01 mm/s", "slider.drive_stiffness=0.2 MN/m",
    "vibration.velocity_amplitude=0.5 mm/s", "friction.max_deflection=4 um",
)  # fmt: skip


QUICK_TO_MARCH = "vibration.frequency=400 Hz", "solve.step=5 us"


@pytest.mark.parametrize("settings", [(*SLOW, *QUICK_TO_MARCH), slow(SLOW)])
def test_without_a_duration_a_march_goes_on_until_it_has_settled(settings):
    case = read_case("table-4.3", TABLES, settings)
    model = Model.from_case(case.replace_values({"solve.duration": None}))
    answer = solve(model, history=False)
    assert answer.settled
    assert answer.notes[0].startswith("solve.duration is left out: the march went on to")
    assert answer.steps * model.step / model.substeps > model.duration
    if settings == SLOW:
        (of_many, other) = solve_many([model, model])
        assert of_many.ratio == other.ratio == answer.ratio


def test_halves_that_agree_while_a_slow_change_goes_on_are_not_enough():
    # A time constant of ten windows: the halves are apart by 5 % of what is still to come.
    for constant in (2.0, 5.0, 10.0):
        edges = np.exp(-np.arange(5) / (4.0 * constant))
        change = 0.01
        means = 0.5 + change * 4.0 * constant * (edges[:-1] - edges[1:])
        left = change * constant * (1.0 - edges[-1])
        assert still_to_come(means.tolist()) == pytest.approx(left, rel=1e-6)


def test_what_comes_and_goes_is_no_slow_change():
    assert still_to_come([0.5, 0.501, 0.5, 0.501]) == 0.0
    assert still_to_come([0.5, 0.501, 0.503, 0.506]) == 0.0
    assert still_to_come([0.5] * 4) == 0.0
