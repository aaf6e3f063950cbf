"""The sliding body in a browser: what is dragged, shown, saved and gone back to."""

import re

import pytest
from apparatus.browser import answered, copied, settled, shown, tab_to
from PIL import Image
from playwright.sync_api import expect

NUMBERS = ("ratio", "drive_force_N", "power_vibration_W", "power_friction_W", "power_residual")


@pytest.fixture
def slide(seen):
    page = seen.open("slide")
    expect(page.locator("[data-key=ratio]").first).to_be_visible()
    return page


def press(page, name, key, times):
    page.get_by_role("slider", name=name, exact=True).focus()
    for _ in range(times):
        page.keyboard.press(key)


def test_numbers_on_the_screen_are_those_of_the_command_that_is_handed_out(slide, server):
    before = shown(slide, "ratio")
    press(slide, "direction", "ArrowRight", 40)
    press(slide, "drive velocity", "ArrowRight", 7)
    settled(slide)
    words = copied(slide)
    assert "vibration.direction=40 deg" in words
    answer = answered(words, server.folder)
    assert {key: shown(slide, key) for key in NUMBERS} == pytest.approx(
        {key: answer[key] for key in NUMBERS}, rel=1e-9, abs=1e-12
    )
    assert shown(slide, "ratio") > before


def test_a_case_that_is_saved_gives_the_same_on_the_command_line(slide, server):
    press(slide, "frequency", "ArrowRight", 10)
    press(slide, "velocity ratio k", "ArrowLeft", 10)
    settled(slide)
    ratio = shown(slide, "ratio")
    slide.get_by_role("button", name="save case").click()
    slide.get_by_label("name").fill("slower")
    slide.get_by_role("button", name="save", exact=True).click()
    expect(slide.get_by_label("case", exact=True)).to_have_value("slower.toml")
    settled(slide)
    assert shown(slide, "ratio") == ratio
    answer = answered(["asperity", "slide", "slower.toml", "--json"], server.folder)
    assert answer["ratio"] == pytest.approx(ratio, rel=1e-12)


def test_reload_and_back_keep_what_is_set(slide):
    box = slide.get_by_label("direction, typed")
    # Each typed as one change: keys pressed on a busy machine may come as two.
    box.fill("20 deg")
    box.press("Enter")
    settled(slide)
    ratio = shown(slide, "ratio")
    box.fill("40 deg")
    box.press("Enter")
    settled(slide)
    further = shown(slide, "ratio")
    assert further != ratio
    slide.reload()
    expect(box).to_have_value("40 deg")
    expect(slide.locator("[data-key=ratio]").first).to_have_attribute("data-value", str(further))
    slide.go_back()
    expect(box).to_have_value("20 deg")
    expect(slide.locator("[data-key=ratio]").first).to_have_attribute("data-value", str(ratio))


def test_the_keyboard_alone_drags_pins_reads_the_table_and_opens_an_origin(slide):
    expect(slide.get_by_text("Force left over direction")).to_be_visible()
    tab_to(slide, "velocity ratio k, typed")
    slide.keyboard.press("Control+A")
    slide.keyboard.type("12")
    slide.keyboard.press("Enter")
    settled(slide)
    assert shown(slide, "velocity_ratio") == pytest.approx(12, rel=1e-12)
    tab_to(slide, "0.")
    slide.keyboard.press("Enter")
    origin = slide.get_by_role("dialog", name="where the number comes from")
    expect(origin).to_contain_text(re.compile(r"equation\s*Fdv/Fds = .*N / .*N"))
    slide.keyboard.press("Escape")
    expect(origin).to_be_hidden()
    tab_to(slide, "pin this curve")
    slide.keyboard.press("Enter")
    expect(slide.get_by_role("button", name="unpin")).to_be_visible()
    tab_to(slide, "Force left over direction as table")
    slide.keyboard.press("Enter")
    expect(slide.get_by_role("columnheader", name="direction (°)")).to_be_visible()


def test_what_cannot_be_is_told_in_a_line_that_marks_its_field(slide):
    box = slide.get_by_label("normal force, typed")
    box.fill("-3 N")
    box.press("Enter")
    expect(slide.get_by_role("alert")).to_contain_text("slider.normal_force")
    expect(box).to_have_attribute("aria-invalid", "true")
    slide.get_by_role("button", name="as the case has it").click()
    expect(slide.locator(".fault")).to_have_count(0)


def test_another_form_of_the_amplitude_is_the_same_state(slide):
    ratio = shown(slide, "ratio")
    slide.get_by_label("strength given as").select_option("displacement_amplitude")
    settled(slide)
    assert shown(slide, "ratio") == pytest.approx(ratio, rel=1e-4)
    assert "velocity_ratio=" not in " ".join(copied(slide))


def test_pictures_and_numbers_of_a_plot_are_files(slide):
    expect(slide.get_by_text("Force left over direction")).to_be_visible()
    for kind, begins in (("PNG", b"\x89PNG"), ("SVG", b"<svg"), ("CSV", b"direction (deg),")):
        with slide.expect_download() as download:
            slide.get_by_role("button", name=f"Force left over direction as {kind}").click()
        with open(download.value.path(), "rb") as file:
            assert file.read(len(begins)) == begins


def test_a_picture_is_drawn_on_white_with_its_legend_whatever_the_page_looks_like(seen_as):
    texts = {}
    for scheme in ("light", "dark"):
        page = seen_as(color_scheme=scheme).open("slide")
        for title in ("Power", "Over a cycle"):
            with page.expect_download() as download:
                page.get_by_role("button", name=f"{title} as SVG").click()
            with open(download.value.path()) as file:
                texts[scheme, title] = file.read()
    for title, legend in (("Power", "lost to friction"), ("Over a cycle", "sliding")):
        assert texts["light", title] == texts["dark", title]
        assert legend in texts["light", title]
    page = seen_as(color_scheme="dark").open("gear")
    with page.expect_download() as download:
        page.get_by_role("button", name="To scale as PNG").click()
    # What has no ground of its own either, such as the drawing of a gearset.
    assert Image.open(download.value.path()).getpixel((1, 1)) == (255, 255, 255, 255)


def test_a_number_of_another_base_is_refused_and_a_meaning_names_no_other_unit(slide):
    box = slide.get_by_label("velocity ratio k, typed")
    box.fill("0x10")
    box.press("Enter")
    alert = slide.get_by_role("alert").filter(has_text="vibration.velocity_ratio")
    expect(alert).to_be_visible()
    assert "--set" not in alert.inner_text()
    assert alert.inner_text().count("vibration.velocity_ratio") == 1
    slide.get_by_text("every key of the case").click()
    says = slide.locator("#field-slider-drive_velocity-says")
    expect(says).to_contain_text("vd > 0. (")


def test_a_case_is_replaced_only_when_that_is_said(slide):
    def save():
        slide.get_by_role("button", name="save case").click()
        slide.get_by_role("dialog").get_by_label("name").fill("twice")
        slide.get_by_role("button", name="save", exact=True).click()

    save()
    expect(slide.get_by_label("case", exact=True)).to_have_value("twice.toml")
    press(slide, "direction", "ArrowRight", 5)
    settled(slide)
    save()
    slide.get_by_role("button", name="replace it").click()
    expect(slide.get_by_role("dialog")).to_have_count(0)
    expect(slide.get_by_label("direction, typed")).to_have_value("5 deg")


def typed(page, label, text):
    box = page.get_by_label(label, exact=True)
    box.fill(text)
    box.press("Enter")
    return box


def test_nothing_is_handed_out_of_other_settings_while_a_field_is_refused(slide):
    typed(slide, "velocity ratio k, typed", "3,5")
    expect(slide.locator(".fault")).to_contain_text("with a point in place of the comma")
    for button in ("copy command", "save case"):
        slide.get_by_role("button", name=button).click()
        expect(slide.locator(".toast")).to_contain_text("not yet: vibration.velocity_ratio")
        expect(slide.get_by_role("dialog")).to_have_count(0)
    typed(slide, "velocity ratio k, typed", "3.5")
    settled(slide)
    slide.get_by_role("button", name="copy command").click()
    expect(slide.locator(".toast")).to_contain_text("vibration.velocity_ratio=3.5")


def test_what_takes_long_is_dimmed_and_makes_room_for_what_is_set_next(slide):
    expect(slide.locator(".stale")).to_have_count(0)
    typed(slide, "normal force, typed", "1e9 N")
    expect(slide.locator(".stale")).to_be_visible(timeout=2000)
    typed(slide, "normal force, typed", "55 N")
    box = typed(slide, "velocity ratio k, typed", "3")
    number = slide.locator("[data-key=velocity_ratio]").first
    expect(number).to_have_attribute(
        "data-value", re.compile(r"^(3|2\.9999|3\.0000)"), timeout=15_000
    )
    expect(slide.locator(".stale")).to_have_count(0)
    expect(slide.locator(".fault")).to_have_count(0)
    expect(box).to_have_value("3")


def test_a_drag_is_one_step_to_go_back_from(slide):
    settled(slide)
    before = slide.evaluate("history.length")
    handle = slide.get_by_role("slider", name="velocity ratio k", exact=True)
    was = slide.get_by_label("velocity ratio k, typed").input_value()
    box = handle.bounding_box()
    y = box["y"] + box["height"] / 2
    slide.mouse.move(box["x"] + box["width"] / 2, y)
    slide.mouse.down()
    for part in (0.3, 0.7, 0.4, 0.8):
        slide.mouse.move(box["x"] + part * box["width"], y)
        slide.wait_for_timeout(500)
    assert slide.evaluate("history.length") == before
    slide.mouse.up()
    settled(slide)
    assert slide.evaluate("history.length") == before + 1
    slide.go_back()
    expect(slide.get_by_label("velocity ratio k, typed")).to_have_value(was)


def test_a_refused_text_leaves_no_unit_and_goes_when_it_is_emptied(slide):
    was = slide.get_by_label("frequency, typed").input_value()
    box = typed(slide, "frequency, typed", "3 furlong")
    expect(slide.locator(".fault")).to_be_visible()
    typed(slide, "frequency, typed", "4")
    expect(box).to_have_value("4 kHz")
    settled(slide)
    typed(slide, "frequency, typed", "-3")
    expect(slide.locator(".fault")).to_be_visible()
    typed(slide, "frequency, typed", "")
    expect(box).to_have_value(was)
    expect(slide.locator(".fault")).to_have_count(0)


def test_a_direction_that_is_none_is_drawn_nowhere(slide):
    expect(slide.get_by_text("Force left over direction")).to_be_visible()
    typed(slide, "direction, typed", "x")
    expect(slide.locator(".fault")).to_be_visible()
    expect(slide.locator("circle.here")).to_have_count(0)


def test_the_handle_on_the_plate_turns_the_direction_and_pulls_the_strength(slide):
    settled(slide)
    grip = slide.locator(".stage .grip")
    box, plate = grip.bounding_box(), slide.locator(".stage svg").bounding_box()
    slide.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    slide.mouse.down()
    scale = plate["width"] / 720
    slide.mouse.move(plate["x"] + (330 - 60) * scale, plate["y"] + (150 - 60) * scale, steps=8)
    slide.mouse.up()
    settled(slide)
    expect(slide.get_by_label("direction, typed")).to_have_value("45 deg")
    assert shown(slide, "velocity_ratio") < 6.0
    expect(slide.locator(".stage")).to_contain_text("45°")


def test_the_picture_moves_stops_and_is_moved_by_hand(slide):
    dot = slide.locator(".stage .dot")

    def place():
        return dot.get_attribute("cx"), slide.locator(".runs").first.get_attribute("cx")

    before = place()
    slide.wait_for_timeout(400)
    moved = place()
    assert moved[0] != before[0]
    assert moved[1] != before[1]
    slide.get_by_role("button", name="stop the motion").click()
    still = place()
    slide.wait_for_timeout(300)
    assert place() == still
    slide.get_by_label("moment of the cycle").fill("96")
    assert place() != still


def test_who_wants_no_motion_gets_none(seen_as):
    page = seen_as(reduced_motion="reduce").open("slide")
    expect(page.get_by_role("button", name="let it move")).to_be_visible()


def test_the_best_elevation_of_a_pin_is_taken_by_a_click(seen):
    page = seen.open("slide", case="pin-on-disc")
    expect(page.get_by_text("Force left over elevation")).to_be_visible()
    before = shown(page, "ratio")
    page.get_by_role("button", name="take it").click()
    settled(page)
    assert shown(page, "ratio") < 0.2 * before
    expect(page.get_by_text("elevations tried leaves less by 0.01 or more.")).to_be_visible()


AROUND = """async () => {
  const { anglesAt, lineOf, seenAt } = await import("/js/ball.js");
  const apart = (one, other) => {
    const dot = one.reduce((sum, each, k) => sum + each * other[k], 0);
    return (Math.acos(Math.min(1, Math.abs(dot))) * 180) / Math.PI;
  };
  const found = [];
  for (let direction = 0; direction < 180; direction += 13) {
    for (let elevation = 1; elevation < 180; elevation += 11) {
      const line = lineOf(direction, elevation);
      const [again, up] = anglesAt(...seenAt(line));
      const inside = again >= 0 && again < 180 && up >= 0 && up < 180;
      found.push(inside ? apart(line, lineOf(again, up)) : 180);
    }
  }
  return found;
}"""


def test_the_place_on_the_ball_is_the_line_in_space_that_it_was_drawn_from(slide):
    # Whole degrees are set: each angle is half of one off at most.
    apart = slide.evaluate(AROUND)
    assert len(apart) == 14 * 17
    assert max(apart) < 1.0


def test_a_ball_turns_the_direction_in_space(seen, server):
    page = seen.open("slide", case="pin-on-disc")
    settled(page)
    before = shown(page, "ratio")
    box = page.locator(".ball .grip").bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 15, y + 12, steps=4)
    page.mouse.up()
    settled(page)
    words = copied(page)
    assert [each for each in words if each.startswith("vibration.elevation=")]
    assert shown(page, "ratio") < before
    assert shown(page, "ratio") == pytest.approx(answered(words, server.folder)["ratio"], rel=1e-9)


def test_changes_are_undone_and_done_again_one_at_a_time(slide):
    # typed and not moved: on a slow machine ten presses of a key are more than one change
    box = slide.get_by_label("direction, typed")
    for angle in ("10 deg", "20 deg"):
        box.fill(angle)
        box.press("Enter")
        settled(slide)
    expect(box).to_have_value("20 deg")
    slide.get_by_role("button", name="undo").click()
    expect(box).to_have_value("10 deg")
    slide.locator("h1").click()
    slide.keyboard.press("Control+Z")
    expect(box).to_have_value("0 deg")
    slide.keyboard.press("Control+Shift+Z")
    expect(box).to_have_value("10 deg")
    slide.get_by_role("button", name="redo").click()
    expect(box).to_have_value("20 deg")
    expect(slide.get_by_role("button", name="redo")).to_be_disabled()


def test_the_first_tab_leads_to_the_answer(slide):
    slide.keyboard.press("Tab")
    expect(slide.get_by_role("button", name="skip to the answer")).to_be_focused()
    slide.keyboard.press("Enter")
    assert slide.evaluate("document.activeElement.id") == "main"


def test_a_refused_elevation_keeps_its_field_and_the_old_headline_is_of_before(seen):
    page = seen.open("slide", case="pin-on-disc")
    box = page.get_by_label("elevation, typed")
    was = box.input_value()
    expect(page.locator(".headline [data-key=ratio]")).to_be_visible()
    for wrong in ("-5", "up"):
        box.fill(wrong)
        box.press("Enter")
        expect(page.locator(".fault")).to_contain_text("vibration.elevation")
        expect(box).to_have_attribute("aria-invalid", "true")
        expect(page.get_by_label("normal phase, typed")).to_be_visible()
        said = page.evaluate(
            "getComputedStyle(document.querySelector('.headline'), '::before').content"
        )
        assert said == '"of before"'
        expect(page.locator(".ball figcaption")).to_have_text("before: direction 0°, elevation 90°")
    box.fill(was)
    box.press("Enter")
    settled(page)
    expect(page.locator(".fault, .of-before")).to_have_count(0)
    expect(page.locator(".ball figcaption")).to_have_text("direction 0°, elevation 90°")


def test_what_is_refused_elsewhere_leaves_the_ball_to_the_hand(seen):
    page = seen.open("slide", case="pin-on-disc")
    expect(page.locator(".headline [data-key=ratio]")).to_be_visible()
    page.get_by_label("mass, typed").fill("abc")
    page.get_by_label("mass, typed").press("Enter")
    expect(page.locator(".fault")).to_contain_text("slider.mass")
    page.get_by_label("elevation, typed").fill("30 deg")
    page.get_by_label("elevation, typed").press("Enter")
    expect(page.locator(".ball figcaption")).to_have_text("direction 0°, elevation 30°")
