"""The rig and the thesis in a browser: a recording is dropped and reduced, claims are found."""

import json
import shutil
from pathlib import Path

import pytest
from apparatus.browser import answered, copied, settled, violations
from playwright.sync_api import expect

RECORDING = Path(__file__).parents[1] / "answers" / "rig.nc"


def dropped(seen, **params):
    """Open the rig and drop a recording; returns the page."""
    page = seen.open("rig", **params)
    page.get_by_label("choose a file").set_input_files(RECORDING)
    # It takes the place of the one whose answer ships.
    expect(page.get_by_role("heading", name="rig.nc")).to_be_visible()
    expect(page.locator(".signals")).to_be_visible()
    return page


def test_a_recording_that_is_dropped_shows_its_segments_and_is_reduced(seen, server):
    page = dropped(seen)
    expect(page.locator(".segment")).to_have_count(1)
    grip = page.locator(".grip").first
    grip.focus()
    for _ in range(5):
        page.keyboard.press("ArrowRight")
    settled(page)
    assert "set.reduction.settling=1.5+s" in page.url
    page.get_by_role("button", name="reduce").click()
    change = page.locator("[data-key=torque_change_percent]").first
    expect(change).to_be_visible(timeout=120_000)
    # Its one segment is doubtful, and so is what stands on top.
    expect(page.locator(".big").first).to_contain_text("~ doubtful for")
    words = copied(page)
    assert "reduction.settling=1.5 s" in words
    wanted = answered(words, server.folder)["segments"][0]["torque_change_percent"]
    assert float(change.get_attribute("data-value")) == pytest.approx(wanted, rel=1e-9)
    page.reload()
    expect(page.locator("[data-key=torque_change_percent]").first).to_be_visible(timeout=120_000)
    # What is refused is said once, also when a law is to be fitted with it.
    page.evaluate("() => { location.hash += '&set.friction.mu=abc'; }")
    settled(page)
    page.get_by_role("button", name="fit", exact=True).click()
    settled(page)
    expect(page.locator(".fault", has_text="friction.mu is")).to_have_count(1)


def test_a_window_follows_the_pointer_at_once_and_no_late_answer_moves_it_back(seen):
    page = dropped(seen, case="disc-on-disc", **{"set.reduction.least_window": "0.5 s"})
    asked, answers = [], []
    page.route("**/api/do/signals", lambda route: (asked.append(route), answers.append(route)))
    grip = page.locator(".grip").first
    box = grip.bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    for step in (30, 60, 90):
        page.mouse.move(x + step, y)
        # Nothing is answered while it is dragged, nor asked.
        moved = grip.bounding_box()
        assert moved["x"] + moved["width"] / 2 == pytest.approx(x + step, abs=5)
    assert not asked
    page.mouse.up()
    page.wait_for_timeout(600)
    assert len(asked) == 1
    there = grip.bounding_box()["x"]
    # A key is pressed while the answer is under way; it comes late, and moves nothing.
    page.keyboard.press("ArrowRight")
    further = grip.bounding_box()["x"]
    assert further > there
    answers[0].continue_()
    page.unroute("**/api/do/signals")
    page.wait_for_timeout(1500)
    assert grip.bounding_box()["x"] == pytest.approx(further, abs=0.5)
    settled(page)
    assert grip.bounding_box()["x"] == pytest.approx(further, abs=0.5)


def test_an_edge_stops_short_of_the_other_end_of_its_window(seen):
    page = dropped(seen)
    grip = page.locator(".grip").first
    box, window = grip.bounding_box(), page.locator(".window.fill1").first.bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 2 * window["width"], y)
    page.mouse.up()
    settled(page)
    expect(page.locator(".fault")).to_have_count(0)
    there, end = grip.bounding_box()["x"], window["x"] + window["width"]
    assert x < there < end
    expect(page.locator(".segment.refused")).to_have_count(0)
    # One that was set beyond the end can be dragged back.
    page = seen.open("rig", rec="rig.nc", **{"set.reduction.settling": "40 s"})
    expect(page.locator(".signals")).to_be_visible()
    svg, far = page.locator(".signals").bounding_box(), grip.bounding_box()
    assert far["x"] < svg["x"] + svg["width"]
    grip.focus()
    page.keyboard.press("ArrowLeft")
    settled(page)
    assert grip.bounding_box()["x"] < far["x"]


def test_an_interval_is_a_bar_and_point_and_model_have_marks_of_their_own(seen):
    page = dropped(seen)
    page.get_by_role("button", name="reduce").click()
    plot = page.locator("figure", has_text="Measured change of torque")
    expect(plot).to_be_visible(timeout=120_000)
    expect(plot.locator(".drawn circle.point")).to_have_count(1)
    # All that is said of it is in sight at its place.
    levels = page.locator(".levels")
    assert levels.evaluate("one => one.scrollHeight <= one.clientHeight + 1")
    # One segment: no line is drawn, and the bar of the interval is.
    expect(plot.locator(".drawn path.line")).to_have_count(1)
    expect(plot.locator(".legend")).to_contain_text("measured, with its interval")
    low, high = (float(end) for end in page.locator("tbody tr").first.locator("td").nth(6)
                 .inner_text().split(" to "))  # fmt: skip
    plot.get_by_text("as table").click()
    expect(plot.locator("tbody td").nth(3)).to_be_visible()
    cells = plot.locator("tbody td").all_inner_texts()
    assert [float(cell) for cell in cells[2:4]] == pytest.approx([low, high], rel=1e-3)


def test_an_interval_that_spans_nothing_is_told_as_one_and_ends_are_in_their_order(seen):
    page = seen.open("rig")
    told = page.evaluate(
        """async (all) => {
             const { between } = await import("/js/screens/rig.js");
             return all.map(between);
           }""",
        [[-1.8, 1.08], [-12.0, -6.0], [6.0, 12.0], [0.0, 3.0]],
    )
    assert told == ["1.8 % less to 1.08 % more", "6 to 12 %", "6 to 12 %", "0 % less to 3 % more"]


def test_claims_are_found_by_words_and_verdict_and_say_what_makes_them(seen, server):
    made = {"name": "claim 2.3", "key": "of another version", "plain": {}, "files": {}}
    folder = server.folder / "out/thesis"
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "made.json").write_text(json.dumps([made]))
    try:
        page = seen.open("thesis")
        rows = page.locator("tbody tr")
        expect(page.get_by_text("94 of 94 claims")).to_be_visible()
        page.get_by_role("searchbox").fill("Oversize alone leaves contact")
        expect(rows).to_have_count(1)
        # What another version made is not shown as this one's.
        expect(rows.first).to_contain_text("not made here")
        rows.first.locator("summary").click()
        expect(rows.first).to_contain_text("asperity thesis --only 2.3")
        settled(page)
        page.reload()
        expect(rows).to_have_count(1)
        page.get_by_label("not made here").check()
        expect(rows).to_have_count(1)
        page.get_by_label("arithmetic").check()
        expect(rows).to_have_count(0)
    finally:
        shutil.rmtree(folder.parent)


@pytest.mark.campaign
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_axe_finds_nothing_wrong_with_either(seen_as, scheme):
    seen = seen_as(color_scheme=scheme, bypass_csp=True)
    dropped(seen)
    assert violations(seen.page) == []
    page = seen.open("thesis")
    expect(page.locator("tbody tr").first).to_be_visible()
    assert violations(page) == []
