"""The report of ``--out``: its numbers, what a user wrote in it, and that it stands alone."""

import json
import math
import re

import pytest
from apparatus.grid import slow
from apparatus.reports import Page, check_numbers, unmarked

EVIL = "<script>alert(1)</script>"
NOT_CSS = 'Gears "& Co" </style>'


@pytest.fixture(scope="module")
def rated(tmp_path_factory):
    from asperity.cli.main import main

    folder = tmp_path_factory.mktemp("report")
    project = (f"name={EVIL}", f"customer={NOT_CSS}", "author=me")
    settings = [part for entry in project for part in ("--set", f"project.{entry}")]
    with pytest.raises(SystemExit) as ended:
        main(["rate", "gearset-3", *settings, "--out", str(folder)])
    assert not ended.value.code
    text = (folder / "report.html").read_text("utf-8")
    return text, Page(text), json.loads((folder / "rate.json").read_text("utf-8"))


@pytest.mark.slow
def test_every_number_of_a_report_is_that_of_the_json_and_shown_rounded(rated):
    _, page, answer = rated
    assert len(page.numbers) > 200
    check_numbers(page, answer)
    assert unmarked(page, answer) == []


TEETH = (
    'drive.deflection=[["22 N m", "50 urad"], ["366 N m", "365 urad"]]',
    "drive.effective_radius=9.8 mm", "drive.tangential_compliance=2.9 nm/N",
)  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize(
    ("command", "stem"),
    [
        (("drive", "drive-screw", *(f"--set={each}" for each in TEETH)), "drive"),
        slow(("flank", "gearset-3b", "--density", "coarse"), "flank"),
    ],
)
def test_other_reports_draw_the_gearset_and_say_the_numbers_of_the_json(
    asperity, tmp_path, command, stem
):
    code, _, errors = asperity(*command, "--out", tmp_path / "out")
    assert code == 0, errors
    text = (tmp_path / "out" / "report.html").read_text("utf-8")
    answer = json.loads((tmp_path / "out" / f"{stem}.json").read_text("utf-8"))
    page = Page(text)
    assert "<h2>The gearset" in text
    assert text.count("<svg") >= 2
    assert len(page.numbers) > 20
    check_numbers(page, answer)
    assert unmarked(page, answer) == []
    # A link is asked for by whoever follows it.
    assert all(place.startswith("data:") or place == "gearset.glb" for place in page.asked)


@pytest.mark.slow
def test_a_body_has_a_report_too_with_its_picture_and_what_was_set(asperity, tmp_path):
    set_so = "vibration.direction=37 deg"
    code, _, errors = asperity("slide", "body-shaken-along", "--set", "solve.method=periodic",
                               "--set", set_so, "--out", tmp_path)  # fmt: skip
    assert code == 0, errors
    text = (tmp_path / "report.html").read_text("utf-8")
    page = Page(text)
    assert len(page.numbers) > 10
    check_numbers(page, json.loads((tmp_path / "slide.json").read_text("utf-8")))
    assert f"--set {set_so}" in text
    # First of all how much is left.
    assert page.sentences[0] == "of  N without vibration  is left:  N"
    first = [key for _, key, *_ in page.numbers[:3]]
    assert first == ["static_drive_force_N", "ratio", "drive_force_N"]
    assert "<b>Sliding body.</b>" in text
    assert page.tags.count("img") == 1
    assert all(place.startswith("data:") for place in page.asked)


@pytest.mark.slow
def test_a_report_asks_for_nothing(rated):
    _, page, _ = rated
    assert all(place.startswith("data:") for place in page.asked)
    assert not {"script", "iframe", "object", "form"} & set(page.tags)


def test_what_a_user_wrote_of_the_project_is_text_in_the_report(rated):
    text, page, _ = rated
    assert EVIL not in text
    assert "&lt;script&gt;" in text
    assert text.count("</style>") == 1
    assert page.tags.count("style") == 1


def test_in_black_and_white_what_fails_is_hollow_and_says_so(rated):
    text, _, answer = rated
    table = text.partition("<h2>Verdict")[2].partition("</table>")[0]
    rows = re.findall(r"<tr>(.*?)</tr>", table.partition("<tbody>")[2], re.DOTALL)
    safeties = answer["verdict"]["safeties"]
    assert len(rows) == len(safeties)
    assert {safety["holds"] for safety in safeties} == {True, False}
    for row, safety in zip(rows, safeties, strict=True):
        frame, filled = re.findall(r"<rect [^>]*>", row)
        assert 'fill="none"' in frame
        assert 'stroke="#000"' in filled
        assert ('fill="#fff"' in filled) != safety["holds"]
        assert ("FAILS" in row) != safety["holds"]


def test_a_report_has_each_section(rated):
    text, _, _ = rated
    for title in ("Verdict", "The gearset", "Power", "Forces on shafts and bearings",
                  "Self-locking", "Assumed", "Calculation by ISO/TR 14521:2010", "Sources",
                  "The case file"):  # fmt: skip
        assert f"<h2>{title}" in text


@pytest.mark.slow
def test_a_rating_shows_how_the_flanks_touch_where_that_is_asked_for(asperity, rated, tmp_path):
    title = "<h2>Contact pattern and lines"
    without = rated[0].partition(title)[2].partition("</section>")[0]
    assert "asperity rate CASE --out FOLDER --pattern shows them here" in without
    code, _, errors = asperity("rate", "gearset-3b", "--pattern", "--out", tmp_path)
    assert code == 0, errors
    shown = (tmp_path / "report.html").read_text("utf-8").partition(title)[2]
    section = shown.partition("</section>")[0]
    assert section.count('src="data:image/svg+xml;base64,') == 2
    assert "<b>Pattern.</b>" in section
    assert "<b>Contact lines.</b>" in section
    answer = json.loads((tmp_path / "rate.json").read_text("utf-8"))
    assert answer == json.loads(asperity("rate", "gearset-3b", "--json")[1])


@pytest.mark.slow
def test_a_pattern_without_a_report_is_refused_in_a_line(asperity):
    assert asperity("rate", "gearset-3b", "--pattern") == (
        2, "", "--pattern: it is shown in the report; name a folder for it with --out\n"
    )  # fmt: skip


@pytest.mark.parametrize("hand", ["right", "left"])
def test_forces_balance_on_the_worm_and_do_its_work(rated, hand):
    import asperity

    found = asperity.rate("gearset-3", settings=[f"gearset.hand={hand}"])
    arm = 0.5 * found.geometry.worm_pitch_diameter
    half = 0.5 * float(found.rating_inputs.bearing_span)
    for forces, turn in zip(found.forces, (-1.0, 1.0), strict=True):
        x, y, z = forces.worm
        (ay, az), (by, bz) = forces.driven_end, forces.free_end
        assert (ay + by, az + bz) == pytest.approx((y, z))
        assert half * (ay - by) == pytest.approx(arm * x)
        # A worm that drives is held back; the wheel moves the way it is pushed.
        assert -arm * z * turn < 0.0
        advance = -turn * (1.0 if hand == "right" else -1.0)
        assert forces.wheel[0] * advance > 0.0
        lost = arm * abs(z) - abs(x) * found.geometry.reduced_lead
        efficiency = abs(x) * found.geometry.reduced_lead / (arm * abs(z))
        assert lost > 0.0
        assert efficiency == pytest.approx(found.iso14521["eta_z1_2"])
    clockwise, other = found.forces
    assert clockwise.worm[0] == -other.worm[0]
    assert (clockwise.worm[0] < 0.0) == (hand == "right")


def test_a_project_changes_no_answer_that_is_kept():
    import asperity

    case = asperity.read("gearset-3")
    assert case.replace(["project.name=other"]).canonical() == case.canonical()


def test_the_drawing_is_to_scale(rated):
    import asperity
    from asperity.gearset.drawing import scale_of
    from asperity.results.svg import SCALES

    scale = scale_of(asperity.rate("gearset-3").geometry)
    assert scale in SCALES
    assert math.isfinite(scale)
