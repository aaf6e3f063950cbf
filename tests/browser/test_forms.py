"""Forms that know what may stand in them, and how to mend what is refused."""

import os
import re

import pytest
from apparatus.browser import Seen, answered, copied, settled
from apparatus.page import Served
from playwright.sync_api import expect

from asperity.files.shipped import shipped_case

MAKERS = """
[source.maker]
name = "a maker's table"
confidence = "one source"

[bearing."cylindrical of a maker"]
kind = "cylindrical"
bore = "30 mm"
outside_diameter = "62 mm"
width = "16 mm"
dynamic_rating = "44 kN"
static_rating = "36.5 kN"
from = { "*" = "maker" }
"""


def test_materials_and_oils_are_listed_with_the_figures_they_are_chosen_by(seen):
    page = seen.open("gear", case="gearset-3")
    box = page.locator("#field-gearset-wheel_material")
    expect(box).to_be_visible()
    options = page.locator("#field-gearset-wheel_material-list option")
    assert {"CuSn12-C-GZ", "CuSn12Ni2-C-GZ"} <= {
        one.get_attribute("value") for one in options.all()
    }
    box.fill("CuSn12-C-GZ")
    box.press("Enter")
    expect(
        page.get_by_text("tin bronze, pitting strength 425 MPa, shear strength 92 MPa").last
    ).to_be_visible()
    oils = page.locator("#field-operation-lubricant-list option")
    expect(oils.filter(has_text="mineral, viscosity at 40 degC 68 mm^2/s").first).to_be_attached()


def test_a_torque_below_that_through_the_travel_is_mended_by_a_click(seen):
    page = seen.open("gear", case="gearset-3")
    box = page.locator("#field-operation-output_torque")
    box.fill("100 N m")
    box.press("Enter")
    expect(page.get_by_role("alert").first).to_contain_text("through_travel_torque")
    page.get_by_role("button", name="a third of it through the travel").click()
    settled(page)
    expect(page.locator(".fault")).to_have_count(0)
    expect(page.locator("#field-operation-output_torque")).to_have_value("100 N m")


def test_another_ratio_asks_for_gearsets_with_the_torque_and_speed_that_are_set(seen):
    page = seen.open("gear", case="gearset-3")
    expect(page.get_by_label("ratio", exact=True)).to_have_value("15")
    page.get_by_label("ratio", exact=True).fill("40")
    page.get_by_label("ratio", exact=True).press("Enter")
    expect(page.get_by_role("heading", name="Size and trade-off")).to_be_visible()
    expect(page.get_by_label("torque of the wheel")).to_have_value("366 N m")
    expect(page.get_by_label("ratio", exact=True)).to_have_value("40")


def test_a_length_in_inches_and_a_force_in_pounds_are_taken_and_sliders_stand_at_them(seen):
    page = seen.open("slide", case="body-shaken-along")
    box = page.get_by_label("normal force, typed")
    expect(box).to_be_visible()
    box.fill("1 lbf")
    box.press("Enter")
    settled(page)
    expect(page.locator(".fault")).to_have_count(0)
    at = float(page.get_by_label("normal force", exact=True).input_value())
    box.fill("4.4482216152605 N")
    box.press("Enter")
    settled(page)
    assert abs(float(page.get_by_label("normal force", exact=True).input_value()) - at) <= 1e-6


def test_arrangements_of_bearings_are_listed_with_their_loss(seen):
    page = seen.open("gear", case="gearset-3")
    box = page.locator("#field-operation-bearings")
    expect(box).to_be_visible()
    listed = page.locator("#field-operation-bearings-list option")
    assert {one.get_attribute("value") for one in listed.all()} == {"fixed-floating", "preloaded"}
    box.fill("preloaded")
    box.press("Enter")
    expect(page.get_by_text("loss coefficient 0.03", exact=True).last).to_be_visible()


def test_a_bearing_whose_name_has_commas_quotes_and_braces_is_listed_by_all_of_it(seen, server):
    written = shipped_case("actuator-shafts").read_text("utf-8")
    own = 'name = "angular contact 30 x 62 x 16"'
    assert own in written
    odd = written.replace(own, r'name = "ac, {30} \"{x\" 62"')
    (server.folder / "odd-bearing.toml").write_text(odd, "utf-8")
    page = seen.open("gear", case="odd-bearing.toml")
    settled(page)
    page.get_by_text("bearings of the shafts").click()
    chosen = page.get_by_label("worm shaft, bearing at 30 mm").locator("option:checked")
    expect(chosen).to_have_text(
        'ac, {30} "{x" 62: angular contact, bore 30 mm, dynamic rating 36 kN, static rating 26 kN'
    )
    expect(page.get_by_label(re.compile("shaft, bearing at"))).to_have_count(4)


@pytest.mark.parametrize("screen", ["gear", "size"])
def test_bearings_of_shafts_are_chosen_from_those_of_data_files_and_of_the_case(
    browser, tmp_path, monkeypatch, screen
):
    data = tmp_path / "makers.toml"
    data.write_text(MAKERS)
    monkeypatch.setenv("ASPERITY_MATERIALS", str(data))
    server = Served(tmp_path / "page", dict(os.environ), "--port", "0")
    seen = Seen(browser, server)
    try:
        page = seen.open(screen, case="actuator-shafts")
        settled(page)
        page.get_by_text("bearings of the shafts").click()
        of_worm = page.get_by_label("worm shaft, bearing at 180 mm")
        expect(of_worm).to_contain_text("cylindrical 30 x 62 x 16: cylindrical, bore 30 mm")
        own = "dynamic rating 40 kN, static rating 36 kN"
        expect(page.locator("#worm_shaft-bearing-1-says")).to_contain_text(own)
        name = "cylindrical of a maker"
        figures = "cylindrical, bore 30 mm, dynamic rating 44 kN, static rating 36.5 kN"
        of_worm.select_option(label=f"{name}: {figures}")
        settled(page)
        expect(page.locator(".fault")).to_have_count(0)
        expect(page.locator("#worm_shaft-bearing-1-says")).to_have_text(figures)
        if screen == "gear":
            # The command takes it as it is set, and judges that bearing.
            words = copied(page)
            words[1] = "shafts"
            assert name in str(answered(words, server.folder))
        # A kind that cannot stand there is refused, and what was there comes back.
        deep = page.get_by_label("worm shaft, bearing at 30 mm").locator("option", has_text="deep")
        page.get_by_label("worm shaft, bearing at 30 mm").select_option(deep.get_attribute("value"))
        settled(page)
        expect(page.locator(".fault").first).to_contain_text("a deep groove bearing is single")
        page.locator(".mending button").click()
        settled(page)
        expect(page.locator(".fault")).to_have_count(0)
        expect(page.locator("#worm_shaft-bearing-1-says")).to_have_text(figures)
    finally:
        seen.close()
        server.close()
