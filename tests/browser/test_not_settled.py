"""Screens that open an answer which has not settled: marked, no prediction, no saving, no least."""

import json
import re

import pytest
from playwright.sync_api import expect

MINUTES = 240_000
WHY = "the halves of the window differ by 0.2"
SHIPPED = "**/shown/{}/{}.json"


@pytest.fixture
def loose(seen):
    """Open a screen whose answers that ship have not settled, whatever they came to."""

    def opened(screen, **changes):
        def changed(route):
            *_, at, name = route.request.url.removesuffix(".json").split("/")
            found = json.loads(route.fetch().text())
            changes[at](found, name == "data")
            route.fulfill(json=found)

        for at in changes:
            seen.context.route(SHIPPED.format(at, "*"), changed)
        return seen.open(screen)

    seen_open, seen.open = seen.open, lambda screen: seen_open(screen, case=CASES[screen])
    yield opened
    seen.open = seen_open


CASES = {"block": "block-shaken-along", "drive": "drive-actuator"}


def has_not(found, data=False):
    """Have an answer say that it has not settled, in its JSON and its entries."""
    if not data:
        found["answer"] |= {"settled": False, "settled_by": WHY}
        for entry in found["entries"]:
            if entry["key"] in ("settled", "settled_by"):
                entry["value"] = found["answer"][entry["key"]]


def test_a_march_that_is_too_short_stands_in_brackets_and_says_what_it_lacks(seen):
    page = seen.open(
        "slide", case="table-4.3",
        **{"set.solve.method": "march", "set.solve.duration": "0.3 s",
           "set.vibration.start": "10 ms", "set.vibration.velocity_ratio": "0.5"},
    )  # fmt: skip
    headline = page.locator(".headline").first
    said = headline.get_by_role("status")
    expect(said).to_contain_text("Not settled, no prediction: the halves of the window differ")
    expect(headline.locator(".large")).to_contain_text("(")
    expect(headline).not_to_contain_text("% less")


def test_a_block_that_rocks_stands_in_brackets_and_beside_no_rigid_body(loose):
    page = loose("block", **{"block-settled": has_not})
    headline = page.locator(".headline").first
    expect(headline.get_by_role("status")).to_have_text(f"Not settled, no prediction: {WHY}.")
    expect(headline.locator(".large")).to_contain_text("(")
    expect(headline).not_to_contain_text("than of a rigid body")


def two_ways(found, data):
    """Have the ways that save most not settle."""
    if not data:
        for way in found["answer"]["directions"][1:]:
            way |= dict.fromkeys(
                ("saved_W", "saved_per_micrometre_W", "saved_per_actuator_W_W")
            ) | {"settled": False}  # fmt: skip
        found["answer"]["rankings"] = {key: ["axial"] for key in found["answer"]["rankings"]}


def three_amplitudes(found, data):
    """Have a creep not settle, nor three of its amplitudes."""
    has_not(found, data)
    if data:
        many = len(found["amplitude"]["values"])
        found["settled_over"] = found["amplitude"] | {"values": [1.0] * (many - 3) + [0.0] * 3}


def test_a_drive_that_coasts_has_no_verdict_and_saves_nothing(loose):
    page = loose("drive", drive=has_not, directions=two_ways, locking=three_amplitudes)
    ratio = page.locator(".headline").first
    expect(ratio.locator(".large")).to_contain_text("(")
    expect(ratio).to_contain_text("✗ not settled")
    expect(ratio).to_contain_text(f"Not settled, no prediction: {WHY}.")
    expect(ratio).not_to_contain_text("the motor gives")
    expect(page.get_by_text("no verdict, since the state has not settled")).to_be_visible()
    expect(page.get_by_text("it saves power")).to_have_count(0)
    ways = page.locator(".ways")
    expect(ways.get_by_text("W saved")).to_have_count(1)
    expect(ways.get_by_text("not settled: no saving is told")).to_have_count(3)
    rows = page.get_by_role("region", name="directions").locator("tbody tr")
    expect(rows.filter(has_text="✗ not settled")).to_have_count(3)
    expect(page.get_by_text("most saved for a micrometre: axial", exact=True)).to_be_visible()
    expect(page.get_by_text(f"The creep has not settled, no prediction: {WHY}.")).to_be_visible()
    # Three of its amplitudes have not settled, which its picture names.
    chart = page.get_by_role("img").and_(page.get_by_label("Creep of the wheel, the motor off"))
    expect(chart.first).to_have_accessible_name(re.compile("not settled"))


def test_the_least_of_a_grid_is_of_what_has_settled(seen):
    page = seen.open(
        "sweep", case="table-4.3", x="vibration.velocity_ratio~0.5~6~2~even", y="none",
        **{"set.solve.method": "march", "set.solve.duration": "0.3 s",
           "set.vibration.start": "10 ms"},
    )  # fmt: skip
    page.get_by_role("button", name="solve the grid").click()
    expect(page.get_by_text("1 of 2 points has not settled: no prediction.")).to_be_visible(
        timeout=MINUTES
    )
    # The other is less, and is none.
    expect(page.get_by_text("Least:")).to_contain_text("at velocity ratio 6")
    drawn = page.get_by_role("img").and_(page.get_by_label("mean drive force over mu F_N"))
    expect(drawn.first).to_have_accessible_name(re.compile("not settled over velocity ratio"))
