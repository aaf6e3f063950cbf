"""What is refused comes with buttons that mend it: each offers what the case takes."""

import contextlib
import random
import re
import time
from urllib.parse import urlencode

import pytest
from apparatus.browser import answered, copied, settled
from playwright.sync_api import expect

from asperity.casefile.forms import forms
from asperity.errors import InputError
from asperity.units import Quantity, measures, to_si
from asperity.web.answer import case_tables

GEAR = [
    ("operation.worm_speed", "abc", ["1440 rpm"]),
    ("operation.worm_speed", "1450 U/min", ["1450 rpm"]),
    ("operation.output_torque", "-366 N m", ["366 N m"]),
    ("operation.output_torque", "366 kg", ["366 N m"]),
    ("operation.oil_temperature", "100 furlong", ["100 degC"]),
    ("operation.oil_temperature", "-400 degF", None),
    ("operation.lubricant", "ISO VG 150 mineraal", ["ISO VG 150 mineral"]),
    ("operation.lubricant", "polyglycol", None),
    ("operation.seals", "1,5", ["1", "2"]),
    ("gearset.wheel_teeth", "59.5", ["59", "60"]),
    ("gearset.starts", "0", ["1"]),
    ("gearset.starts", "abc", None),
    ("gearset.worm_material", "steel", None),
    ("gearset.pressure_angle", "95 deg", None),
    ("gearset.axial_module", "0 mm", None),
    ("gearset.wheel_teeth", "1e400", ["60"]),
    # A unit of the quantity stays with a decimal comma, whichever it is.
    ("operation.output_torque", "0,4 kN m", ["0.4 kN m"]),
    ("operation.output_torque", "366,5 Nm", ["366.5 Nm"]),
    ("operation.worm_speed", "1450,5 1/min", ["1450.5 1/min"]),
    ("operation.worm_speed", "1 450 rpm", ["1440 rpm"]),
    ("operation.worm_speed", "1.450,5 rpm", ["1440 rpm"]),
    ("operation.oil_temperature", "168,5 degF", ["168.5 degF"]),
    ("gearset.centre_distance", "7,493 cm", ["7.493 cm"]),
    ("gearset.centre_distance", "2,95 in", ["2.95 in"]),
]
BODY = [
    ("vibration.elevation", "-5 deg", ["0 deg"]),
    ("vibration.elevation", "4 rad", ["180 deg"]),
    ("vibration.frequency", "4", ["4 kHz"]),
    ("vibration.frequency", "1e400 Hz", ["4 kHz"]),
    ("vibration.velocity_ratio", "-3", ["3"]),
    ("friction.mu", "-0.2", ["0.2"]),
    ("friction.mu", "0,3", ["0.3"]),
    ("friction.mu", "0", None),
    ("friction.mu", "300", ["100"]),
    ("friction.model", "lugree", None),
    ("slider.mass", "0 kg", None),
    ("slider.mass", "abc", None),
    ("slider.normal_force", "30 mm", ["30 N"]),
    ("solve.method", "settled", None),
    ("vibration.elevation", "0,5 rad", ["0.5 rad"]),
    ("vibration.frequency", "0,004 MHz", ["0.004 MHz"]),
    ("slider.mass", "500,5 g", ["500.5 g"]),
    ("slider.normal_force", "0,03 kN", ["0.03 kN"]),
    ("slider.drive_velocity", "0,03 m/min", ["0.03 m/min"]),
]
"""What is typed, and what is offered instead; None: whatever the case takes."""


def refused(page, screen, case, path, text):
    """Set a text as the field of its key would, and wait until it is refused."""
    there = urlencode({"case": case, f"set.{path}": text})
    page.evaluate("there => { location.hash = there; }", f"/{screen}?{there}")
    settled(page)
    expect(page.locator(".fault").first).to_contain_text(path)


@pytest.mark.parametrize(
    ("screen", "command", "case", "table"),
    [("gear", "rate", "gearset-3", GEAR), ("slide", "slide", "pin-on-disc", BODY)],
)
def test_what_is_refused_has_a_button_whose_value_is_taken(
    seen, server, screen, command, case, table
):
    page = seen.open(screen, case=case)
    settled(page)
    for path, text, offered in table:
        refused(page, screen, case, path, text)
        buttons = page.locator(".mending button.main")
        expect(buttons.first).to_be_visible()
        told = [each.get_attribute("data-text") for each in buttons.all()]
        assert offered is None or told == offered, (path, text, told)
        for one in told:
            words = ["asperity", command, case, "--set", f"{path}={one}", "--json"]
            assert answered(words, server.folder), (path, one)
        buttons.first.click()
        settled(page)
        expect(page.locator(".fault")).to_have_count(0)
        assert f"set.{path}={told[0]}" in page.evaluate(
            "decodeURIComponent(location.hash).replaceAll('+', ' ')"
        )
        assert page.locator("[aria-invalid=true]").count() == 0


def test_a_decimal_comma_is_mended_to_the_same_size_in_any_unit(seen):
    page = seen.open("home")
    settled(page)
    keys = [key for table in forms(case_tables()).values() for key in table["keys"]]
    examples = {key["unit"]: key["example"] for key in keys if key["kind"] == "quantity"}
    names = [name for name in measures.listed()[1] if "_" not in name]
    names += [f"{prefix}{name}" for prefix in "kmMuc" for name in ("N", "m", "Pa", "Hz", "g", "s")]
    chance = random.Random(37)
    asked, sizes = [], []
    for unit, example in examples.items():
        si = {"rpm": "rad/s"}.get(unit, re.sub(r"(?<=m)([23])", r"**\1", unit))
        must = Quantity(si, example=example).expected() + ", with a point in place of the comma"
        for name in {*names, *examples} - {""}:
            typed = f"{chance.randint(0, 999)}.{chance.randint(1, 9999)} {name}"
            with contextlib.suppress(InputError):
                sizes.append((to_si(typed, si), si))
                asked.append([must, typed.replace(".", ",", 1), {"unit": unit, "example": example}])
    offers = page.evaluate(
        "(all) => import('/js/mends.js').then(({ offered }) => all.map((one) => offered(...one)))",
        asked,
    )
    assert len(asked) > 150
    for (_, typed, _), (size, si), offer in zip(asked, sizes, offers, strict=True):
        assert [to_si(one, si) for one in offer] == [pytest.approx(size, rel=1e-12)], (typed, offer)


def test_a_word_that_is_near_none_of_a_list_leaves_the_list_and_the_way_back(seen):
    page = seen.open("gear", case="gearset-3")
    settled(page)
    refused(page, "gear", "gearset-3", "operation.lubricant", "butter")
    page.get_by_label("all for lubricant").select_option("ISO VG 320 mineral")
    settled(page)
    expect(page.locator(".fault")).to_have_count(0)
    expect(page.locator("#field-operation-lubricant")).to_have_value("ISO VG 320 mineral")
    # A bound that the key takes may make no gearset: the way back is still there.
    refused(page, "gear", "gearset-3", "gearset.wheel_teeth", "0")
    page.get_by_role("button", name="wheel teeth 3").click()
    settled(page)
    expect(page.locator(".mending")).to_contain_text("wheel teeth, 3")
    page.get_by_role("button", name="without wheel teeth").or_(
        page.get_by_role("button", name="back to 60")
    ).first.click()
    settled(page)
    expect(page.locator(".fault")).to_have_count(0)
    # What was set leads to a line about another key: it is named, and goes back.
    page.locator("#field-gearset-centre_distance").fill("0.3 mm")
    page.locator("#field-gearset-centre_distance").press("Enter")
    settled(page)
    expect(page.locator(".mending")).to_contain_text("centre distance, 0.3 mm")
    expect(page.locator("#field-gearset-centre_distance")).to_have_attribute("aria-invalid", "true")
    page.get_by_role("button", name="back to 74.93 mm").click()
    settled(page)
    expect(page.locator(".fault")).to_have_count(0)


LAW = {"set.friction.max_deflection": "70 nm", "set.friction.law": "split",
       "set.friction.transfer": "0.7"}  # fmt: skip
JOBS = [
    ("drive", {}, "vibration.frequency", "abc", "frequency 20 kHz", "", "shake it"),
    ("block", {}, "vibration.direction", "5 kHz", "direction 5°", "back to 0°", "settle"),
    ("flanks", {}, "hob.tilt", "1 kg", "tilt 1°", "back to", "cut the wheel"),
    ("rig", {"case": "disc-on-disc", **LAW}, "friction.mu", "1e400", "mu 0.1", "without mu", ""),
    (
        "size",
        {"case": "gearset-3", "set.gearset.wheel_teeth": "62"},
        "gearset.wheel_teeth",
        "abc",
        "wheel teeth 60",
        "back to 62",
        "",
    ),
]
"""Screens whose answers are jobs': what is refused there, what mends it, and the button of one."""


@pytest.mark.parametrize(("screen", "params", "path", "text", "mend", "back", "job"), JOBS)
@pytest.mark.parametrize("pressed", [False, True])
def test_where_a_job_answers_what_is_refused_is_said_as_it_is_set_and_a_mend_leaves_nothing_of_it(
    seen, screen, params, path, text, mend, back, job, pressed
):
    page = seen.open(screen, **params)
    settled(page)
    # As on a busy machine: what is set is drawn before it is known to be refused.
    page.route("**/api/do/check", lambda route: (time.sleep(0.3), route.continue_()))
    before = page.evaluate("location.hash")
    page.evaluate(
        "([hash, more]) => { location.hash = hash + (hash.includes('?') ? '&' : '?') + more; }",
        [before, urlencode({f"set.{path}": text})],
    )
    settled(page)
    fault = page.locator(".fault").first
    expect(fault).to_contain_text(f"{path} is")
    if screen not in ("rig", "size"):
        assert text not in " ".join(copied(page))
        page.get_by_role("button", name="copy command").click()
        expect(page.locator(".toast")).to_contain_text("not yet")
    if screen in ("drive", "block"):
        assert page.locator("[aria-invalid=true]").count() > 0
    if pressed and job:
        page.get_by_role("button", name=job, exact=True).click()
        settled(page)
    mending = page.locator(".mending")
    expect(mending.get_by_role("button", name=back).first).to_be_visible()
    value = mending.locator("button.main").first.get_attribute("data-text")
    mending.get_by_role("button", name=mend).click()
    settled(page)
    expect(page.locator(".fault")).to_have_count(0)
    expect(page.locator(".mending")).to_have_count(0)
    expect(page.locator("[aria-invalid=true]")).to_have_count(0)
    expect(page.locator(".of-before")).to_have_count(0)
    if screen not in ("rig", "size"):
        assert f"{path}={value}" in copied(page)


RATIO, TORQUE, SPEED = "ratio", "torque of the wheel", "speed of the worm"
ASKED = [
    (RATIO, "abc", "15"), (RATIO, "0", "4"), (RATIO, "1e9", "100"), (RATIO, "1e400", "15"),
    (RATIO, "4000:1", "100"), (RATIO, "1:1", "4"), (TORQUE, "0,5 kN m", "0.5 kN m"),
    (TORQUE, "abc", "300 N m"), (TORQUE, "-5 N m", "5 N m"), (TORQUE, "500 kg", "500 N m"),
    (TORQUE, "0", "300 N m"), (TORQUE, "1e400 N m", "300 N m"),
    (SPEED, "1450 U/min", "1450 rpm"), (SPEED, "0 rpm", "1500 rpm"),
]  # fmt: skip
"""What is typed into the fields that Size begins with, and what it becomes."""


def given(page, label, text):
    """Type into a box, and wait for what comes of it."""
    box = page.get_by_label(label, exact=True).first
    box.fill(text)
    box.press("Enter")
    settled(page)
    return box


def test_what_size_is_asked_is_marked_where_it_is_refused_and_mended_by_a_click(seen):
    page = seen.open("size", case="gearset-3")
    settled(page)
    for label, text, offered in ASKED:
        said = page.locator("main .big").first.inner_text()
        box = given(page, label, text)
        expect(page.locator(".fault").first).to_contain_text(" is ")
        expect(box).to_have_attribute("aria-invalid", "true")
        # What stands below is of before, and says so of what it was asked.
        assert page.locator("main .big").first.inner_text() == said
        button = page.locator(".mending button.main")
        assert button.get_attribute("data-text") == offered, (label, text)
        button.click()
        settled(page)
        expect(page.locator(".fault, .mending, [aria-invalid=true]")).to_have_count(0)
        expect(box).to_have_value(offered)


@pytest.mark.parametrize("text", ["40:1", "1 : 40", "80:2"])
def test_a_ratio_is_taken_as_it_is_written(seen, text):
    page = seen.open("size", case="gearset-3")
    settled(page)
    box = given(page, RATIO, text)
    expect(box).to_have_value("40")
    expect(page.locator(".fault")).to_have_count(0)
    assert copied(page)[copied(page).index("--ratio") + 1] == "40"
    page = seen.open("gear", case="gearset-3")
    settled(page)
    given(page, "ratio", text)
    expect(page.get_by_role("heading", name="Size and trade-off")).to_be_visible()
    expect(page.get_by_label("ratio", exact=True)).to_have_value("40")


ENDS = [
    ("x-from", "abc", "6.0"), ("x-from", "-0.5", "0.5"), ("x-points", "1000", "500"),
    ("x-points", "abc", "11"), ("y-to", "5 N m", "5 deg"), ("y-from", "1e400 deg", "90 deg"),
]  # fmt: skip


def test_an_end_of_a_grid_that_is_refused_is_mended_by_a_click(seen):
    page = seen.open("sweep", case="body-shaken-along", **{"set.solve.method": "periodic"})
    settled(page)
    for name, text, offered in ENDS:
        box = page.locator(f"#{name}")
        was = box.input_value()
        box.fill(text)
        box.press("Enter")
        settled(page)
        expect(box).to_have_attribute("aria-invalid", "true")
        button = page.locator(".mending button.main")
        assert button.get_attribute("data-text") == offered, (name, text)
        back = page.locator(".mending").get_by_role("button", name="back to")
        expect(back).to_have_count(int(offered != was))
        button.click()
        settled(page)
        expect(page.locator(".fault, .mending, [aria-invalid=true]")).to_have_count(0)
        box.fill(was)
        box.press("Enter")
        settled(page)
