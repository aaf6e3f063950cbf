"""A report from every screen: one file with what is shown, which prints and asks for nothing."""

from pathlib import Path

import pytest
from apparatus import reports
from apparatus.browser import settled
from playwright.sync_api import expect

HERE = Path(__file__).parent
ASKED = {
    "slide": {"case": "body-shaken-along", "set.vibration.direction": "37 deg"},
    "sweep": {"x": "vibration.velocity_ratio~2~8~3~log", "y": "none"},
    "gear": {"case": "worm-15-to-1"},
    "size": {"ratio": "20", "output_torque": "200 N m"},
    "thesis": {},
}
"""What is opened; a recording is brought first."""

LONG = {
    "flanks": {"case": "gearset-3"},
    "drive": {"case": "drive-actuator"},
    "block": {"case": "block-shaken-along"},
}
"""The same of those that take a minute, since their own job is done first."""

MINUTES = pytest.mark.campaign(
    tried_by="test_a_screen_hands_its_report_over_which_prints_and_asks_for_nothing"
)

SAYS = {
    "slide": "--set vibration.direction=37 deg", "sweep": "Sliding body over a grid",
    "gear": "<h2>Verdict", "size": "200 N m", "thesis": "Of 94 claims", "flanks": "Pattern",
    "drive": "torque_ratio", "block": "slider_ratio",
}  # fmt: skip


def taken(page, tmp_path):
    """Press *report*; returns the file."""
    with page.expect_download(timeout=400_000) as got:
        page.get_by_role("button", name="report", exact=True).click()
    path = tmp_path / "report.html"
    got.value.save_as(path)
    return path


@pytest.mark.parametrize("screen", [*ASKED, *(pytest.param(each, marks=MINUTES) for each in LONG)])
def test_a_screen_hands_its_report_over_which_prints_and_asks_for_nothing(
    seen, browser, tmp_path, screen
):
    page = seen.open(screen, **(ASKED | LONG)[screen])
    settled(page)
    path = taken(page, tmp_path)
    text = path.read_text("utf-8")
    assert SAYS[screen] in text
    read = reports.Page(text)
    # Of a gearset's flanks it names the file in space, which stands beneath on the screen.
    beside = {"gearset.glb"} if screen == "flanks" else set()
    assert all(place.startswith("data:") for place in set(read.asked) - beside)
    assert not {"script", "iframe", "object", "form"} & set(read.tags)
    asked = []
    paper = browser.new_page(viewport={"width": 794, "height": 900})
    paper.on("request", lambda request: asked.append(request.url))
    paper.goto(path.as_uri())
    assert paper.evaluate("document.documentElement.scrollWidth") <= 794
    assert paper.pdf(prefer_css_page_size=True).count(b"/Type /Page\n") >= 1
    assert [url for url in asked if not url.startswith(("file:", "data:"))] == []
    paper.close()


def test_the_report_of_a_body_has_the_numbers_of_the_screen_and_its_files_stand_beneath(
    seen, tmp_path
):
    page = seen.open("slide", case="body-shaken-along")
    settled(page)
    path = taken(page, tmp_path)
    numbers = {key: value for value, key, *_ in reports.Page(path.read_text("utf-8")).numbers}
    assert numbers["ratio"] == float(
        page.locator("[data-key='ratio']").first.get_attribute("data-value")
    )
    files = page.locator(".actions").get_by_role("button")
    for name in ("report.html", "slide.json", "slide.nc", "slide.png"):
        expect(files.filter(has_text=name)).to_be_visible()


def test_a_recording_that_is_reduced_has_its_report(seen, tmp_path):
    page = seen.open("rig")
    page.get_by_label("choose a file").set_input_files(HERE.parent / "answers" / "rig.nc")
    expect(page.get_by_role("heading", name="rig.nc")).to_be_visible()
    # It is reduced first, in sight.
    path = taken(page, tmp_path)
    assert "Recordings of a disc-on-disc rig, reduced" in path.read_text("utf-8")
    expect(page.locator("main .big b").first).to_be_visible()
