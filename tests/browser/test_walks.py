"""From a question to its answer, with clicks counted; what is typed is no click."""

import re

from apparatus.browser import shown
from apparatus.walks import Walk, to_a_law, to_a_report, to_a_shared_file, to_the_best_way
from playwright.sync_api import expect

from asperity.studies.requirements import RATIO_OFF


def off(text, ratio):
    """By how much the teeth that are named, such as 41:1, miss a ratio."""
    wheel, worm = re.search(r"(\d+):(\d+),", text).groups()
    return abs(int(wheel) / int(worm) / ratio - 1.0)


def handed(walk, folder, *words):
    """Go on to the shared file, by one click: it says what was found and asks for nothing."""
    before = walk.clicks
    path = to_a_shared_file(walk, folder)
    assert walk.clicks == before + 1
    assert path.stat().st_size < 2_000_000
    page = walk.page.context.browser.new_context(offline=True).new_page()
    page.goto(path.as_uri())
    for word in words:
        expect(page.locator("body")).to_contain_text(word)
    page.context.close()


def test_from_a_ratio_torque_and_speed_to_a_report_takes_four_clicks(seen, tmp_path):
    def offered(page):
        offers = page.get_by_role("button", name="take a =")
        near = re.compile(r"(39|40|41):1,|(78|79|80|81|82):2,")
        expect(offers.first).to_have_accessible_name(near)
        for offer in offers.all():
            assert off(offer.get_attribute("aria-label"), 40.0) <= RATIO_OFF, offer

    walk = Walk(seen.open(""))
    report = to_a_report(walk, tmp_path, offered)
    name = walk.page.locator("#field-gearset-name").input_value()
    assert off(name, 40.0) <= RATIO_OFF, name
    text = report.read_text("utf-8")
    assert name in text
    assert "1450" in text
    # The shared file is the fourth.
    handed(walk, tmp_path, name, "asperity rate")
    assert walk.clicks <= 4


def test_from_a_pin_on_a_disc_to_its_best_way_takes_three_clicks(seen, tmp_path):
    before = []
    walk = Walk(seen.open(""))
    to_the_best_way(walk, lambda page: before.append(shown(page, "ratio")))
    assert "set.vibration.elevation" in walk.page.url
    assert shown(walk.page, "ratio") < before[0]
    assert walk.clicks <= 3
    handed(walk, tmp_path, walk.page.locator(".headline .large").inner_text().strip())


def test_from_a_recording_to_a_fitted_law_takes_five_clicks(seen, tmp_path):
    walk = Walk(seen.open(""))
    law = to_a_law(walk)
    # The law is seen against what was measured.
    expect(law.locator("figure .point").first).to_be_visible()
    # The shared file is the fifth.
    handed(walk, tmp_path, "χ²", "friction.transfer", "rig.nc, which is not in here")
    assert walk.clicks <= 5
