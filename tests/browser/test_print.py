"""Screens on paper: what is shown, on white, without what is pressed, and nothing cut off."""

import pytest
from apparatus.browser import settled
from playwright.sync_api import expect

# Of each screen a thing that must stand on the paper.
SHOWN = {
    "slide": "[data-key=ratio]", "gear": ".bars", "drive": "svg.strips", "block": ".map-of",
    "flanks": ".map svg.drawn", "sweep": ".heat svg.drawn", "size": "table", "rig": "svg.signals",
    "thesis": "table",
}  # fmt: skip
PRESSED = "nav, .controls, .actions, .work, .beneath, .case .quiet, main select"
A4 = 718
"""Width of a sheet less its margins, at 96 to the inch."""


@pytest.mark.parametrize("screen", SHOWN)
def test_on_paper_stands_what_is_shown_and_not_what_is_pressed(seen, screen):
    page = seen.open(screen)
    expect(page.locator(SHOWN[screen]).first).to_be_visible()
    settled(page)
    page.emulate_media(media="print", color_scheme="dark")
    page.set_viewport_size({"width": A4, "height": 1000})
    expect(page.locator(SHOWN[screen]).first).to_be_visible()
    expect(page.get_by_role("heading", level=1)).to_be_visible()
    for each in page.locator(PRESSED).all():
        expect(each).to_be_hidden()
    # What is pressed in a row names it: that stands on the paper as words.
    for each in page.locator("main :is(th, li) button").all():
        expect(each).to_be_visible()
    assert page.evaluate("document.documentElement.scrollWidth") <= A4
    # In a dark room too it is black on white.
    assert page.evaluate("getComputedStyle(document.body).backgroundColor") == "rgb(255, 255, 255)"
    printed = page.pdf(format="A4")
    assert 1 <= printed.count(b"/Type /Page\n") <= PAGES[screen]


PAGES = dict.fromkeys(SHOWN, 4) | {"drive": 8, "thesis": 40}
