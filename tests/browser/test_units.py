"""Units of the US on the page: each number as `--units us` shows it, a switch that stays."""

import math
import re

import pytest
from apparatus.browser import answered, copied, settled
from apparatus.shown_numbers import in_si, numbers, read
from playwright.sync_api import expect

from asperity.casefile.forms import forms
from asperity.errors import InputError
from asperity.files.shipped import shipped_case
from asperity.results.unit_systems import US, converted, shown_in
from asperity.units import measures, to_si
from asperity.web.answer import case_tables

INCH, POUND_FORCE = 0.0254, 4.4482216152605
# What a US unit is of the unit that the entry has; of the page's own besides, which are smaller.
SMALLER = {("m", "µin"): 1e6 / INCH}


def choose(page, system):
    page.get_by_label("units", exact=True).select_option(system)
    settled(page)


def in_us(value, shown, unit):
    """Return what a value of an entry must be in the unit that is shown."""
    if (unit, shown) in SMALLER:
        return value * SMALLER[unit, shown]
    with shown_in("us"):
        number, name = converted(value, unit)
    assert name.replace("uin", "µin") == shown, (value, shown, unit)
    return number


@pytest.mark.parametrize(
    ("screen", "params"),
    [
        ("slide", {"case": "table-4.3", "set.solve.method": "periodic"}),
        ("gear", {"case": "gearset-3"}),
        ("drive", {}),
        ("block", {}),
        ("flanks", {}),
    ],
)
def test_each_number_is_what_it_is_in_si_and_in_units_of_the_us(seen, screen, params):
    page = seen.open(screen, **params)
    settled(page)
    units = {}
    for fold in page.locator("details.all > summary").all():
        fold.click()
    settled(page)
    choose(page, "si")
    before = numbers(page)
    choose(page, "us")
    after = numbers(page)
    assert before.keys() == after.keys()
    assert len(before) > 20
    for name, one in before.items():
        value, other = float(one["value"]), after[name]
        # What is below its rounding says so in words.
        if "within" in one["text"]:
            continue
        assert other["value"] == one["value"]
        unit = one["of"]
        if one["unit"] == other["unit"]:
            assert one["text"] == other["text"], name
            continue
        given = in_si(one["text"], one["unit"], unit)
        assert given == pytest.approx(value, rel=2e-2, abs=1e-30), name
        assert read(other["text"]) == pytest.approx(in_us(value, other["unit"], unit), rel=1e-3)
        units[other["unit"]] = units.get(other["unit"], 0) + 1
    assert units


def test_the_page_has_the_units_of_the_command_line(seen):
    page = seen.open("home")
    settled(page)
    shown = page.evaluate("import('/js/us.js').then(({ US }) => US)")
    # A pressure in kPa stands on the page alone.
    assert shown.keys() - {"kPa"} == US.keys()
    for unit, (name, factor, *plus) in shown.items():
        if unit == "kPa":
            continue
        assert name == US[unit].unit.replace("uin", "µin"), unit
        assert factor == pytest.approx(US[unit].factor, rel=1e-13), unit
        assert sum(plus) == US[unit].offset, unit


def test_a_unit_of_another_quantity_is_refused_as_the_command_line_refuses_it(seen):
    page = seen.open("home")
    settled(page)
    keys = [key for table in forms(case_tables()).values() for key in table["keys"]]
    fields = sorted({key["unit"] for key in keys if key["kind"] == "quantity"})
    names = [name for name in measures.listed()[1] if "_" not in name]
    names += [f"k{name}" for name in ("N", "m", "Pa", "V", "W", "Hz", "N m", "g")]
    names += ["dag", "constructor", "m/", "lb-in", "lbf·in", "µin", "°F", "mm²", "W/m**2/degF"]
    pairs = [(name, unit) for name in (*names, *fields) for unit in fields]
    found = page.evaluate(
        "(all) => import('/js/units.js').then(({ inUnit }) =>"
        " all.map(([name, unit]) => { const x = inUnit(`5 ${name}`, unit);"
        " return Number.isNaN(x) ? null : x; }))",
        pairs,
    )
    taken = 0
    for (name, unit), number in zip(pairs, found, strict=True):
        try:
            # As a field has it: powers with their sign, a speed of rotation in SI.
            kept = {"rpm": "rad/s"}.get(unit, re.sub(r"(?<=m)([23])", r"**\1", unit))
            wanted = to_si(f"5 {name}", kept) * (30 / math.pi if unit == "rpm" else 1)
        except InputError:
            assert number is None, (name, unit, number)
        else:
            assert number == pytest.approx(wanted, rel=1e-12, abs=1e-9), (name, unit)
            taken += 1
    # Each field takes its own unit, and few others.
    assert len(fields) <= taken < len(pairs) / 10


def test_a_switch_stays_and_what_is_typed_in_inches_is_the_same_in_json(seen, server):
    page = seen.open("gear", case="gearset-3")
    settled(page)
    torque = page.get_by_label("output torque", exact=True)
    expect(torque).to_have_value("366 N m")
    choose(page, "us")
    expect(torque).to_have_value("3239.4 lbf·in")
    expect(page.get_by_label("ambient temperature", exact=True)).to_have_value("68 °F")
    # A bare number has the unit that stood there.
    torque.fill("3300")
    torque.press("Enter")
    settled(page)
    assert "operation.output_torque=3300 lbf·in" in copied(page)
    found = answered([*copied(page), "--json"], server.folder)
    assert found["bs721"]["output_torque_Nm"] == pytest.approx(3300 * POUND_FORCE * INCH)
    # Another screen, and the same after the page was loaded anew.
    page.get_by_role("link", name="Size and trade-off").click()
    settled(page)
    expect(page.get_by_role("button", name="a (in)", exact=True)).to_be_visible()
    page.reload()
    settled(page)
    expect(page.get_by_role("button", name="a (in)", exact=True)).to_be_visible()
    choose(page, "si")
    expect(page.get_by_role("button", name="a (mm)", exact=True)).to_be_visible()


def test_the_units_of_a_case_are_followed_until_the_reader_chooses(seen, server):
    text = shipped_case("gearset-3").read_text("utf-8")
    (server.folder / "inches.toml").write_text(f'{text}\n[project]\nunits = "us"\n', "utf-8")
    page = seen.open("gear", case="inches.toml")
    settled(page)
    expect(page.get_by_label("output torque", exact=True)).to_have_value("3239.4 lbf·in")
    choose(page, "si")
    expect(page.get_by_label("output torque", exact=True)).to_have_value("366 N m")
    choose(page, "")
    expect(page.get_by_label("output torque", exact=True)).to_have_value("3239.4 lbf·in")


def test_a_slider_and_a_curve_are_in_units_of_the_us(seen):
    page = seen.open("slide", case="table-4.3", **{"set.solve.method": "periodic"})
    settled(page)
    choose(page, "us")
    force = page.get_by_label("normal force, typed", exact=True)
    expect(force).to_have_value("12.36 lbf")
    force.fill("10")
    force.press("Enter")
    settled(page)
    assert "slider.normal_force=10 lbf" in copied(page)
    expect(page.get_by_label("normal force", exact=True)).to_have_attribute(
        "aria-valuetext", "10 lbf"
    )
    expect(page.locator("svg text", has_text="friction (lbf)")).to_have_count(1)
    page.get_by_label("Over a cycle as table", exact=True).click()
    table = page.get_by_role("region", name="Over a cycle, table")
    expect(table.get_by_role("columnheader", name="friction (lbf)")).to_be_visible()


NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e[-+]?\d+)?")


def numbers_of(cell):
    return [float(text) for text in NUMBER.findall(cell)]


def bare(cell):
    return NUMBER.sub("#", cell)


def test_a_table_that_a_command_tells_is_that_of_the_command_line(seen):
    from asperity import rate
    from asperity.results.payload import as_shown
    from asperity.results.unit_systems import shown_table

    result = rate("gearset-3")
    page = seen.open("home")
    settled(page)
    choose(page, "us")
    told = as_shown(result)["tables"]
    made = page.evaluate(
        "(all) => import('/js/told.js').then(({ inUnits }) => all.map(inUnits))", told
    )
    differ = 0
    with shown_in("us"):
        for table, plain, ours in zip(result.tables(), told, made, strict=True):
            for row, before, found in zip(
                shown_table(table).rows, plain["rows"], ours["rows"], strict=True
            ):
                # Of a module the command line tells the diametral pitch.
                if "modul" in " ".join(before):
                    continue
                wanted = [str(cell).replace("uin", "µin") for cell in row]
                assert [bare(cell) for cell in found] == [bare(cell) for cell in wanted]
                # The page has no more digits than are shown.
                for one, other in zip(found, wanted, strict=True):
                    assert numbers_of(one) == pytest.approx(numbers_of(other), rel=2e-3), row
                differ += wanted != before
    assert differ > 10


@pytest.mark.parametrize("width", [360, 720, 800])
@pytest.mark.parametrize("screen", ["slide", "jobs"])
def test_the_switch_is_in_sight_on_a_narrow_window(seen_as, width, screen):
    page = seen_as(viewport={"width": width, "height": 800}).open(screen)
    settled(page)
    box = page.get_by_label("units", exact=True).bounding_box()
    assert box["x"] >= 0
    assert box["x"] + box["width"] <= width
    assert box["y"] < 100
    assert page.locator("nav [aria-current]").bounding_box()["x"] < box["x"]
    choose(page, "us")
    assert page.evaluate("document.documentElement.scrollWidth") <= width


def test_the_centre_of_a_pattern_has_the_digits_and_units_of_other_numbers(seen):
    page = seen.open("flanks")
    settled(page)
    page.locator("details.all > summary").first.click()
    button = page.locator(".all .num button[data-unit=mm]").filter(has_text=", ").first
    for system, factor, unit in (("si", 1.0, "mm"), ("us", 1e-3 / INCH, "in")):
        choose(page, system)
        told = button.inner_text().split()
        assert told[-1] == unit
        for text, exact in zip(told, button.get_attribute("data-value").split(","), strict=False):
            assert len(text.strip(",-0.")) <= 6
            assert float(text.strip(",")) == pytest.approx(float(exact) * factor, rel=1e-4)
