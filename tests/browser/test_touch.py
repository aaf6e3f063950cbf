"""Fingers: what scrolls changes nothing, what drags scrolls nothing."""

import re

import pytest
from apparatus.browser import settled
from playwright.sync_api import expect

PHONE = {"viewport": {"width": 360, "height": 740}, "has_touch": True, "is_mobile": True}
STEPS = 12


@pytest.fixture
def phone(seen_as):
    seen = seen_as(**PHONE)
    page = seen.open("slide")
    expect(page.locator("[data-key=ratio]").first).to_be_visible()
    page.get_by_text("what is set", exact=True).click()
    settled(page)
    return page


def swipe(page, start, end):
    """A finger from a place to another, as the browser's own protocol has it."""
    session = page.context.new_cdp_session(page)
    (x0, y0), (x1, y1) = start, end
    finger = {"x": x0, "y": y0}
    session.send("Input.dispatchTouchEvent", {"type": "touchStart", "touchPoints": [finger]})
    for n in range(1, STEPS + 1):
        at = {"x": x0 + (x1 - x0) * n / STEPS, "y": y0 + (y1 - y0) * n / STEPS}
        session.send("Input.dispatchTouchEvent", {"type": "touchMove", "touchPoints": [at]})
    session.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
    session.detach()


def middle(slider, share=0.5):
    box = slider.bounding_box()
    return box["x"] + share * box["width"], box["y"] + box["height"] / 2


def test_a_finger_that_scrolls_over_a_slider_changes_nothing(phone):
    sliders = phone.locator("input[type=range]:visible").all()
    assert len(sliders) > 6
    for slider in sliders:
        slider.evaluate("each => each.scrollIntoView({block: 'center'})")
        values = [each.input_value() for each in sliders]
        before = phone.evaluate("scrollY")
        x, y = middle(slider, 0.3)
        swipe(phone, (x, y), (x + 12, y - 200))
        settled(phone)
        assert [each.input_value() for each in sliders] == values
        assert phone.evaluate("scrollY") > before
    assert "set." not in phone.url.replace("set.solve.method", "")


def test_a_finger_that_goes_along_a_slider_drags_it_and_scrolls_nothing(phone):
    slider = phone.get_by_role("slider", name="mass", exact=True)
    slider.evaluate("each => each.scrollIntoView({block: 'center'})")
    before = float(slider.input_value())
    (x, y), (to, _) = middle(slider, 0.3), middle(slider, 0.8)
    swipe(phone, (x, y), (to, y + 6))
    settled(phone)
    assert float(slider.input_value()) > before + 20
    # What stands above may have become longer: the slider stays under the finger.
    assert abs(middle(slider)[1] - y) < 8
    assert "set.slider.mass" in phone.url


HANDLES = "input[type=range]:visible, [role=slider]:visible"


@pytest.mark.parametrize("screen", ["drive", "flanks", "block", "rig"])
def test_no_handle_of_another_screen_is_moved_by_a_finger_that_scrolls(seen_as, screen):
    page = seen_as(**PHONE).open(screen)
    handles = page.locator(HANDLES)
    expect(handles.first).to_be_visible()
    expect(page.get_by_text("an answer that ships").first).to_be_visible()
    settled(page)
    for fold in page.get_by_text("what is set", exact=True).all():
        fold.click()
    # What plays moves by itself.
    for button in page.get_by_role("button", name=re.compile("pause|stop the motion")).all():
        button.click()
    address = page.url
    for handle in handles.all():
        handle.evaluate("each => each.scrollIntoView({block: 'center', inline: 'center'})")
        values = [stands_at(each) for each in handles.all()]
        x, y = middle(handle, 0.3)
        swipe(page, (x, y), (x + 14, y - 200))
        settled(page)
        assert [stands_at(each) for each in handles.all()] == values
    assert page.url == address


def stands_at(handle):
    return handle.evaluate("each => each.value ?? each.getAttribute('aria-valuenow')")


def test_a_finger_along_the_edge_of_a_window_moves_it(seen_as):
    page = seen_as(**PHONE).open("rig")
    grip = page.get_by_role("slider", name="settling, at segment 1")
    grip.evaluate("each => each.scrollIntoView({block: 'center', inline: 'center'})")
    before = float(stands_at(grip))
    x, y = middle(grip)
    swipe(page, (x, y), (x + 30, y + 5))
    settled(page)
    assert float(stands_at(grip)) > before


def test_a_finger_on_the_round_handle_turns_the_direction_and_scrolls_nothing(phone):
    grip = phone.locator(".stage .grip")
    grip.evaluate("each => each.scrollIntoView({block: 'center'})")
    x, y = middle(grip)
    before = phone.evaluate("scrollY")
    swipe(phone, (x, y), (x + 25, y - 45))
    settled(phone)
    assert phone.evaluate("scrollY") == before
    assert "set.vibration.direction" in phone.url


def test_a_finger_on_the_ball_turns_the_direction_in_space_and_scrolls_nothing(seen_as):
    page = seen_as(**PHONE).open("slide", case="pin-on-disc")
    grip = page.locator(".ball .grip")
    expect(grip).to_be_visible()
    settled(page)
    grip.evaluate("each => each.scrollIntoView({block: 'center'})")
    x, y = middle(grip)
    before = page.evaluate("scrollY")
    swipe(page, (x, y), (x + 20, y + 30))
    settled(page)
    assert page.evaluate("scrollY") == before
    assert "set.vibration.elevation" in page.url
