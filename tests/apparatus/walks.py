"""Walks over the page from a question to its answer, with clicks counted; what is typed is none."""

import re
from pathlib import Path

from playwright.sync_api import expect

from apparatus.browser import settled

RECORDING = Path(__file__).parents[1] / "answers" / "rig.nc"
MINUTES = 300_000
"""A job that compiles first, on a busy machine, ms."""


class Walk:
    """Clicks on a page, counted.

    Parameters
    ----------
    page : Page
        Playwright's, open on the first page.
    """

    def __init__(self, page):
        self.page, self.clicks = page, 0

    def click(self, role, name):
        """Click what is called so."""
        self.page.get_by_role(role, name=name).first.click()
        self.clicks += 1

    def given(self, label, text):
        """Type into a box and leave it."""
        box = self.page.get_by_label(label, exact=True).first
        box.fill(text)
        box.press("Tab")


def to_a_report(walk, folder, seen=lambda page: None):
    """From ratio, torque and speed to a gearset's report; returns its file.

    What is offered is looked at by ``seen``.
    """
    page = walk.page
    walk.click("link", "begin with ratio and torque")
    for label, text in (("ratio", "40"), ("torque of the wheel", "500 N m"),
                        ("speed of the worm", "1450 rpm")):  # fmt: skip
        walk.given(label, text)
    # Rows of the first answer stand until the one that is asked for is there.
    settled(page)
    seen(page)
    walk.click("button", "take a =")
    expect(page.get_by_role("heading", name="Does it hold?")).to_be_visible()
    expect(page.locator("#field-operation-output_torque")).to_have_value("500 N m")
    with page.expect_download(timeout=MINUTES) as got:
        walk.click("button", "report")
    report = folder / "report.html"
    got.value.save_as(report)
    return report


def to_a_shared_file(walk, folder):
    """From an answer to all of it as one file; returns that."""
    settled(walk.page)
    with walk.page.expect_download(timeout=MINUTES) as got:
        walk.click("button", re.compile("^share$"))
    path = folder / got.value.suggested_filename
    got.value.save_as(path)
    return path


def to_the_best_way(walk, seen=lambda page: None):
    """From a pin on a disc to the direction in which least is left; ``seen`` before it is taken."""
    page = walk.page
    walk.click("link", "Which way do I shake it?")
    # To choose from a list is a click.
    page.get_by_label("case", exact=True).select_option("pin-on-disc")
    walk.clicks += 1
    expect(page.locator("#slide-vibration-elevation")).to_be_visible()
    settled(page)
    expect(page.get_by_text(re.compile("Least of the .* tried is left at"))).to_be_visible()
    seen(page)
    walk.click("button", "take it")
    settled(page)
    expect(page.get_by_text("elevations tried leaves less by 0.01 or more.")).to_be_visible()


def to_a_law(walk):
    """From a recording to a friction law that is fitted to it; returns where that is shown."""
    page = walk.page
    walk.click("link", "What did my rig measure?")
    page.get_by_label("choose a file").set_input_files(RECORDING)
    walk.clicks += 1
    expect(page.get_by_role("heading", name="rig.nc")).to_be_visible()
    expect(page.locator(".signals")).to_be_visible()
    walk.click("button", re.compile("^reduce$"))
    fit = page.get_by_role("button", name=re.compile("^fit$"))
    expect(fit).to_be_enabled(timeout=MINUTES)
    walk.click("button", re.compile("^fit$"))
    law = page.get_by_role("region", name="fit")
    expect(law.get_by_role("row", name=re.compile("transfer"))).to_be_visible(timeout=MINUTES)
    expect(law).to_contain_text("χ²")
    return law
