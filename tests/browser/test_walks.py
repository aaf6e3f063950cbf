"""From a question to its answer, with clicks counted; what is typed is no click."""

import re
from pathlib import Path

from apparatus.browser import settled, shown
from playwright.sync_api import expect

from asperity.studies.requirements import RATIO_OFF

RECORDING = Path(__file__).parents[1] / "answers" / "rig.nc"


def off(text, ratio):
    """By how much the teeth that are named, such as 41:1, miss a ratio."""
    wheel, worm = re.search(r"(\d+):(\d+),", text).groups()
    return abs(int(wheel) / int(worm) / ratio - 1.0)


class Counted:
    """Clicks on a page, counted."""

    def __init__(self, page):
        self.page, self.clicks = page, 0

    def click(self, role, name):
        self.page.get_by_role(role, name=name).first.click()
        self.clicks += 1


def test_from_a_ratio_torque_and_speed_to_a_report_takes_four_clicks(seen, tmp_path):
    page = seen.open("")
    walk = Counted(page)
    walk.click("link", "begin with ratio and torque")
    for label, text in (("ratio", "40"), ("torque of the wheel", "500 N m"),
                        ("speed of the worm", "1450 rpm")):  # fmt: skip
        page.get_by_label(label, exact=True).first.fill(text)
        page.get_by_label(label, exact=True).first.press("Tab")
    # Rows of the first answer stand until the one that is asked for is there.
    settled(page)
    offers = page.get_by_role("button", name="take a =")
    expect(offers.first).to_have_accessible_name(re.compile(r"(39|40|41):1,|(78|79|80|81|82):2,"))
    for offer in offers.all():
        assert off(offer.get_attribute("aria-label"), 40.0) <= RATIO_OFF, offer
    walk.click("button", "take a =")
    expect(page.get_by_role("heading", name="Does it hold?")).to_be_visible()
    expect(page.locator("#field-operation-output_torque")).to_have_value("500 N m")
    name = page.locator("#field-gearset-name").input_value()
    assert off(name, 40.0) <= RATIO_OFF, name
    with page.expect_download(timeout=120_000) as got:
        walk.click("button", "report")
    report = tmp_path / "report.html"
    got.value.save_as(report)
    text = report.read_text("utf-8")
    assert name in text
    assert "1450" in text
    assert walk.clicks <= 4


def test_from_a_pin_on_a_disc_to_its_best_way_takes_three_clicks(seen):
    page = seen.open("")
    walk = Counted(page)
    walk.click("link", "Which way do I shake it?")
    # To choose from a list is a click.
    page.get_by_label("case", exact=True).select_option("pin-on-disc")
    walk.clicks += 1
    expect(page.locator("#slide-vibration-elevation")).to_be_visible()
    settled(page)
    expect(page.get_by_text(re.compile("Least is left at"))).to_be_visible()
    before = shown(page, "ratio")
    walk.click("button", "take it")
    settled(page)
    expect(page.get_by_text("No other elevation leaves less.")).to_be_visible()
    assert "set.vibration.elevation" in page.url
    assert shown(page, "ratio") < before
    assert walk.clicks <= 3


def test_from_a_recording_to_a_fitted_law_takes_five_clicks(seen):
    page = seen.open("")
    walk = Counted(page)
    walk.click("link", "What did my rig measure?")
    page.get_by_label("or drop a file here").set_input_files(RECORDING)
    walk.clicks += 1
    expect(page.get_by_role("heading", name="rig.nc")).to_be_visible()
    expect(page.locator(".signals")).to_be_visible()
    walk.click("button", re.compile("^reduce$"))
    fit = page.get_by_role("button", name=re.compile("^fit$"))
    expect(fit).to_be_enabled(timeout=120_000)
    walk.click("button", re.compile("^fit$"))
    law = page.get_by_role("region", name="fit")
    expect(law.get_by_role("row", name=re.compile("transfer"))).to_be_visible(timeout=300_000)
    expect(law).to_contain_text("χ²")
    # The law is seen against what was measured.
    expect(law.locator("figure .point").first).to_be_visible()
    assert walk.clicks <= 5
