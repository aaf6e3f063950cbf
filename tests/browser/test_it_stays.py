"""What outlives a server: open tabs, bookmarks."""

import os
import re
import signal

import pytest
from apparatus.page import Served
from playwright.sync_api import expect


@pytest.fixture
def served(tmp_path):
    """A way to serve a folder of this test at an address of its own, once more each time."""
    port, alive = ["0"], []

    def begin(name="folder"):
        for one in alive:
            one.close()
        alive[:] = [Served(tmp_path / name, dict(os.environ), "--port", port[0])]
        port[0] = str(alive[0].port)
        return alive[0]

    yield begin
    for one in alive:
        one.close()


def here(one, place):
    return f"http://127.0.0.1:{one.port}/#/{place}"


def test_a_restart_keeps_tabs_and_bookmarks(browser, served):
    first = served()
    context = browser.new_context()
    tab = context.new_page()
    tab.goto(here(first, f"slide?case=body-shaken-across&token={first.token}"))
    expect(tab.locator("[data-key=ratio]").first).to_be_visible()
    bookmark = tab.url
    again = served()
    assert again.token == first.token
    tab.get_by_role("slider", name="mass", exact=True).press("ArrowRight")
    expect(tab).to_have_url(re.compile("set.slider.mass"))
    expect(tab.locator(".busy.on")).to_have_count(0)
    expect(tab.locator(".fault")).to_have_count(0)
    tab.close()
    opened = context.new_page()
    opened.goto(bookmark)
    expect(opened.locator("[data-key=ratio]").first).to_be_visible()
    expect(opened.locator("[role=alert].fault")).to_have_count(0)
    context.close()


def test_a_tab_left_alone_over_a_restart_asks_again_by_itself(browser, served):
    first = served()
    context = browser.new_context()
    tab = context.new_page()
    tab.goto(here(first, f"slide?case=body-shaken-across&token={first.token}"))
    ratio = tab.locator(".headline [data-key=ratio]")
    box = tab.get_by_label("velocity ratio k, typed")
    # Until the server itself has answered, what ships may stand there.
    box.fill("4")
    box.press("Enter")
    asked = tab.locator(".headline [data-key=velocity_ratio]")
    expect(asked).to_have_attribute("data-value", "4", timeout=120_000)
    before = ratio.get_attribute("data-value")
    first.close()
    box.fill("3")
    box.press("Enter")
    expect(tab.get_by_role("alert").first).to_contain_text("does not answer")
    expect(tab.get_by_text("of before, not of what is set now")).to_be_visible()
    assert ratio.get_attribute("data-value") == before
    served()
    # Nothing is touched.
    expect(tab.locator(".fault")).to_have_count(0)
    expect(asked).to_have_attribute("data-value", "3", timeout=120_000)
    assert ratio.get_attribute("data-value") != before
    expect(tab.locator(".of-before")).to_have_count(0)
    context.close()


NOTE_WAITS = """
window.waits = new Set();
const note = () => document.querySelectorAll(".wait").forEach((one) => waits.add(one.textContent));
new MutationObserver(note).observe(document, {subtree: true, childList: true});
"""
"""What keeps every wait that a page tells."""


def test_where_what_computes_has_ended_nobody_is_told_of_compiling_and_it_comes_back(
    browser, served
):
    page = served()
    context = browser.new_context()
    context.add_init_script(NOTE_WAITS)
    tab = context.new_page()
    tab.goto(here(page, f"slide?case=body-shaken-across&token={page.token}"))
    expect(tab.locator("[data-key=ratio]").first).to_be_visible()
    ended = page.child("worker")
    os.kill(ended, signal.SIGKILL)
    # The next question begins it anew.
    tab.get_by_role("slider", name="mass", exact=True).press("ArrowRight")
    expect(tab).to_have_url(re.compile("set.slider.mass"))
    tab.reload()
    expect(tab.locator("[data-key=ratio]").first).to_be_visible()
    expect(tab.locator(".wait")).to_have_count(0)
    assert page.child("worker") != ended
    said = tab.evaluate("[...waits]")
    assert not [text for text in said if "compil" in text]
    context.close()


def test_a_bookmark_of_one_folder_opens_after_another_was_served_there(browser, served):
    context = browser.new_context()
    for name in ("one", "other"):
        one = served(name)
        page = context.new_page()
        page.goto(here(one, f"slide?case=body-shaken-across&token={one.token}"))
        expect(page.locator("[data-key=ratio]").first).to_be_visible()
        bookmark = page.url
        page.close()
    served("one")
    page = context.new_page()
    page.goto(bookmark)
    expect(page.locator("[data-key=ratio]").first).to_be_visible()
    context.close()


def test_a_tab_whose_token_is_refused_takes_that_of_a_tab_at_the_printed_address(browser, served):
    one = served()
    context = browser.new_context()
    old = context.new_page()
    old.goto(here(one, f"slide?case=body-shaken-across&token={'x' * 32}"))
    expect(old.get_by_role("alert").first).to_contain_text("token")
    new = context.new_page()
    new.goto(here(one, f"slide?case=body-shaken-across&token={one.token}"))
    expect(old.locator("[data-key=ratio]").first).to_be_visible()
    context.close()
