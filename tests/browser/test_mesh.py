"""Gears in mesh on the page: the section is that of the gearset, and moves as gears do."""

import math
import time

import pytest
from apparatus.browser import answered, shown
from playwright.sync_api import expect

# Contact points of a section at several places of the worm, how far they lie off both flanks, and
# how fast surfaces slide where the pitch lines touch.
LOOKED_AT = """async (geometry) => {
  const { poseOf, sectionOf, sliding, touching } = await import("/js/mesh.js");
  const section = sectionOf(geometry), { rolling, alpha, thick, pitch, teeth } = section;
  const involute = (angle) => Math.tan(angle) - angle;
  const found = [];
  for (let n = 0; n < 24; n += 1) {
    const gone = (n / 24) * pitch, turned = gone / rolling;
    for (const { x, y } of touching(section, gone)) {
      const thread = (x - gone - thick / 2 - (y - rolling) * Math.tan(alpha)) / pitch;
      const r = Math.hypot(x, y), step = 2 * Math.PI / teeth;
      const half = (pitch - thick) / (2 * rolling) + involute(alpha)
        - involute(Math.acos(rolling * Math.cos(alpha) / r));
      const tooth = (Math.atan2(x, y) - turned + half) / step - 0.5;
      found.push([thread - Math.round(thread), tooth - Math.round(tooth)]);
    }
  }
  const screw = Array.from({ length: 9 }, (_, n) => poseOf(section, "screw", n / 7));
  return { found, counts: found.length / 24, speed: sliding(section, { x: 0, y: rolling }, 100),
    unmoved: screw.map(({ threads, gone }) => threads - gone) };
}"""


def test_teeth_and_threads_touch_where_it_is_said_and_slide_as_the_closed_form(seen, server):
    page = seen.open("gear", case="gearset-3")
    expect(page.get_by_label("in mesh").get_by_role("img").first).to_be_visible()
    geometry = answered(["asperity", "rate", "gearset-3", "--json"], server.folder)["geometry"]
    seen_so = page.evaluate(LOOKED_AT, geometry)
    assert 1.0 <= seen_so["counts"] <= 3.0
    for thread, tooth in seen_so["found"]:
        assert abs(thread) < 1e-12
        assert abs(tooth) < 1e-9
    module, starts = geometry["axial_module_mm"], geometry["starts"]
    radius = geometry["centre_distance_mm"] - module * geometry["wheel_teeth"] / 2
    expected = 0.1 * math.hypot(radius, starts * module / 2)
    assert seen_so["speed"] == pytest.approx(expected, rel=1e-12)
    # Shaken along its own screw a worm leaves its threads where they are.
    assert seen_so["unmoved"] == pytest.approx([0.0] * 9, abs=1e-12)


def test_ways_are_drawn_once_the_speed_of_their_case_is_there(seen):
    # Of what is complained of the fixture tells.
    seen.page.route("**/api/case/*", lambda route: (time.sleep(1.5), route.continue_()))
    page = seen.open("drive")
    expect(page.get_by_role("button", name="try each way")).to_be_visible()
    expect(page.locator(".ways svg")).to_have_count(4)


PRESSED = """async () => {
  const { pressedBy } = await import("/js/mesh.js");
  const radius = [], face = [], pressure = [];
  for (const z of [-5, -0.4, 0, 0.4, 5]) for (let k = 0; k <= 10; k += 1) {
    radius.push(30 + k);
    face.push(z);
    pressure.push(Math.abs(z) > 1 ? 1e6 : 7 * (30 + k));
  }
  const at = pressedBy({ radius, face, pressure });
  return [29, 30, 33.25, 40, 41].map((r) => at({ x: 0.6 * r, y: 0.8 * r }));
}"""


def test_the_pressure_on_the_line_is_that_of_the_middle_of_the_face_at_its_radius(seen):
    page = seen.open("gear", case="gearset-3")
    # Beyond the flank it is that of its edge.
    assert page.evaluate(PRESSED) == pytest.approx([210, 210, 232.75, 280, 280])


def test_it_moves_until_it_is_stopped_and_not_for_those_who_want_no_motion(seen_as):
    page = seen_as().open("gear", case="gearset-3")
    wheel = page.get_by_label("in mesh").locator("[data-of=wheel]")
    at = wheel.get_attribute("transform")
    expect(wheel).not_to_have_attribute("transform", at or "")
    page.get_by_label("in mesh").get_by_role("button", name="stop the motion").click()
    at = wheel.get_attribute("transform")
    page.wait_for_timeout(300)
    assert wheel.get_attribute("transform") == at
    calm = seen_as(reduced_motion="reduce").open("gear", case="gearset-3")
    expect(calm.get_by_role("button", name="let it move")).to_be_visible()


def test_a_drive_has_four_ways_side_by_side_and_its_powers_as_strips(seen):
    page = seen.open("drive")
    ways = page.locator("figure.way")
    expect(ways).to_have_count(4)
    strips = page.locator("svg.strips")
    # The label says every strip in words: what is put in is what goes.
    expect(strips).to_have_attribute(
        "aria-label",
        "mean powers: motor 280 W, 50 %; actuator 283 W, 50 %; "
        "load 166 W, 29 %; friction 397 W, 71 %",
    )
    # Each is as wide as its power: so many to a watt, on both sides.
    widths = strips.locator("path.strip").evaluate_all(
        "all => all.map((one) => { const [, y0, last] = /^M\\S+ (\\S+)C.*V\\S+C.* (\\S+)Z$/"
        ".exec(one.getAttribute('d')); return last - y0; })"
    )
    powers = [shown(page, f"power_{name}_W") for name in ("drive", "actuator", "load", "friction")]
    scale = widths[0] / powers[0]
    assert widths == pytest.approx([scale * abs(power) for power in powers], rel=1e-9)
    assert sum(widths[:2]) == pytest.approx(150.0, rel=1e-9)
    # The line shows the pressure too, since the answer under load has it.
    mesh = page.get_by_label("in mesh")
    expect(mesh.get_by_text("m/s: sliding velocity")).to_be_visible()
    slow = mesh.locator("svg.mesh path[stroke^=rgb]").first.get_attribute("stroke")
    mesh.get_by_label("line", exact=True).select_option("pressure")
    expect(mesh.get_by_text("MPa: largest pressure over a pitch")).to_be_visible()
    assert mesh.locator("svg.mesh path[stroke^=rgb]").first.get_attribute("stroke") != slow
    page.get_by_role("button", name="take axial").click()
    expect(page.locator("#field-vibration-mode")).to_have_value("axial")
    expect(page.get_by_label("in mesh").get_by_text("along its axis")).to_be_visible()
