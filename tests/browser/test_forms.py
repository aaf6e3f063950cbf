"""Forms that know what may stand in them, and how to mend what is refused."""

from apparatus.browser import settled
from playwright.sync_api import expect


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
