import numpy as np
import pytest

from asperity.errors import InputError
from asperity.thesis import contents
from asperity.thesis.contents import FIGURES, TABLES, select
from asperity.thesis.reproduce import files
from asperity.thesis.reproduce.run import run
from asperity.thesis.sliding.figures import figure_2_7, figure_2_14, figure_2_15


@pytest.fixture
def counted(monkeypatch):
    """Figures 2.7 and 2.14 with a count of how often each was made."""
    made = []

    def counting(figure):
        def make():
            made.append(figure.number)
            return figure.make()

        return figure.__class__(figure.number, figure.title, figure.caption, figure.cases, make)

    few = {number: counting(FIGURES[number]) for number in ("2.7", "2.14")}
    monkeypatch.setattr(contents, "FIGURES", few)
    return made


def test_every_figure_asked_for_is_there():
    assert list(FIGURES) == [
        "2.7", "2.9", "2.10", "2.11", "2.13", "2.14", "2.15", "3.1", "3.2", "3.3", "3.4", "3.5",
        "4.3", "4.4", "4.17", "4.18", "4.19", "4.20", "4.21", "4.22", "4.23", "5.2", "5.5", "5.6",
        "5.7", "5.8", "5.9", "5.10", "5.11", "7.1", "7.2", "7.3", "7.4", "7.8", "7.9", "7.11",
    ]  # fmt: skip


def test_figures_are_selected_by_number_in_the_order_of_the_thesis():
    figures, tables = select(["4.17", "2.7"])
    assert [figure.number for figure in figures] == ["2.7", "4.17"]
    assert tables == []
    assert [len(exhibits) for exhibits in select([])] == [len(FIGURES), len(TABLES)]


def test_an_unknown_figure_is_refused_with_the_nearest():
    with pytest.raises(InputError, match=r"'4\.177' is neither .*\(did you mean '4\.17'\?\)"):
        select(["4.177"])


def test_dahl_from_rest_is_drawn_for_five_exponents():
    drawn = figure_2_7()
    (axes,) = drawn.figure.axes
    assert len(axes.get_legend().get_texts()) == 5
    assert float(drawn.dataset["force"].max()) == pytest.approx(5.5)


def test_rigid_friction_is_reversed_for_a_third_of_the_cycle_at_k_2():
    friction = figure_2_14().dataset["friction_rigid_drive"].sel(axis="x").values
    assert np.median(np.abs(friction)) == pytest.approx(5.08)
    assert np.mean(np.abs(friction) < 5.079) < 1e-3
    assert np.mean(friction < 0.0) == pytest.approx(1.0 / 3.0, abs=1e-3)


def test_dahl_friction_falls_and_keeps_its_sign_just_above_k_1():
    dataset = figure_2_15().dataset
    for drive in ("compliant", "rigid"):
        least = float(dataset[f"friction_{drive}_drive"].sel(axis="x").min())
        assert 0.0 < least < 0.8 * float(dataset["full_force"])


def test_what_is_there_and_true_is_used_again(tmp_path, counted):
    lines = []
    first = run(tmp_path, ["2.7"])
    again = run(tmp_path, ["2.7"], lines.append)
    assert counted == ["2.7"]
    assert not first.figures[0].reused
    assert again.figures[0].reused
    assert again.figures[0].how == first.figures[0].how
    assert lines == ["figure 2.7: there already"]


@pytest.mark.parametrize("harm", ["picture", "dataset"])
def test_a_damaged_file_is_made_again(tmp_path, counted, harm):
    files = run(tmp_path, ["2.7"]).figures[0]
    path = getattr(files, harm)
    path.write_bytes(path.read_bytes()[:-100])
    assert not run(tmp_path, ["2.7"]).figures[0].reused
    assert counted == ["2.7", "2.7"]


def test_a_figure_of_other_sources_is_made_again(tmp_path, counted, monkeypatch):
    run(tmp_path, ["2.7"])
    monkeypatch.setattr(files, "package_hash", lambda: "changed")
    assert not run(tmp_path, ["2.7"]).figures[0].reused
    assert counted == ["2.7", "2.7"]


def test_an_interruption_keeps_the_figures_that_were_made(tmp_path, counted):
    def interrupt(line):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run(tmp_path, ["2.7", "2.14"], interrupt)
    assert counted == ["2.7"]
    result = run(tmp_path, ["2.7", "2.14"])
    assert counted == ["2.7", "2.14"]
    assert [figure.reused for figure in result.figures] == [True, False]


def test_one_figure_alone_leaves_the_others_on_the_page(tmp_path, counted):
    run(tmp_path, ["2.7"])
    page = run(tmp_path, ["2.14"]).index.read_text("utf-8")
    assert page.index('id="figure-2.7"') < page.index('id="figure-2.14"')
