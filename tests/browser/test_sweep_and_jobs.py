"""Grids, elastic blocks and the list of jobs in a browser."""

import re
from pathlib import Path
from urllib.parse import parse_qs

import pytest
from apparatus.browser import answered, copied, settled
from playwright.sync_api import expect

DONE = re.compile(r"done after")
MINUTES = 240_000
"""A job may have to wait for another on a busy machine, ms."""


def state(page, text):
    expect(page.locator(".work [role=status]").first).to_have_text(text, timeout=MINUTES)


def test_a_grid_that_is_solved_is_what_the_command_line_finds(seen, server):
    page = seen.open(
        "sweep", case="body-shaken-along", x="vibration.velocity_ratio~2~8~3~log",
        y="vibration.direction~0 deg~90 deg~2~even", **{"set.solve.method": "periodic"},
    )  # fmt: skip
    expect(page.get_by_text("6 points")).to_be_visible()
    page.get_by_role("button", name="solve the grid").click()
    state(page, DONE)
    expect(page.get_by_text("6 of 6 points")).to_be_visible()
    page.get_by_text("as table").first.click()
    rows = page.locator("figure.heat tbody tr").all_inner_texts()
    found = {tuple(map(float, row.split()[:2])): float(row.split()[2]) for row in rows}
    assert len(found) == 6
    words = ["asperity", "slide", "body-shaken-along", "--set", "solve.method=periodic", "--json"]
    for k, direction in ((2, 0), (8, 90)):
        more = [f"vibration.velocity_ratio={k}", f"vibration.direction={direction} deg"]
        sets = [word for each in more for word in ("--set", each)]
        answer = answered([*words, *sets], server.folder)
        assert found[k, direction] == pytest.approx(answer["ratio"], rel=1e-5)
    assert answered([*copied(page), "--json"], server.folder)["points"] == 6
    with page.expect_download(timeout=120_000) as download:
        page.get_by_role("button", name="sweep.nc", exact=True).click()
    assert download.value.suggested_filename == "sweep.nc"
    page.reload()
    expect(page.get_by_text("6 of 6 points")).to_be_visible()
    address = page.url
    page.get_by_role("link", name="Jobs", exact=True).click()
    job = page.locator(".jobs li").filter(has_text="velocity_ratio=2,")
    # A report of another test has a grid without directions.
    job.filter(has_text="direction").get_by_role("link").click()
    expect(page.get_by_text("6 of 6 points")).to_be_visible()
    state(page, DONE)
    assert parse_qs(address.partition("?")[2]) == parse_qs(page.url.partition("?")[2])


def test_points_that_no_grid_has_are_refused_also_from_an_address(seen):
    for points in ("1000000000", "abc", "0", "2.5", ""):
        page = seen.open(
            "sweep", case="body-shaken-along", x=f"vibration.velocity_ratio~2~8~{points}~log",
            y="none",
        )  # fmt: skip
        fault = page.get_by_role("alert").filter(has_text="whole number from 1 to 500")
        expect(fault).to_contain_text(f'points of velocity ratio: "{points}"')
        box = page.get_by_label("points", exact=True)
        expect(box).to_have_value(points)
        expect(box).to_have_attribute("aria-invalid", "true")
        expect(page.get_by_role("button", name="solve the grid")).to_be_disabled()
        box.fill("3")
        box.press("Enter")
        expect(page.get_by_text("3 points")).to_be_visible()
        expect(page.locator(".fault")).to_have_count(0)
    for typed in ("abc", "0", "1e9"):
        box.fill(typed)
        box.press("Enter")
        expect(fault).to_contain_text(f'"{typed}"')
        expect(box).to_have_value(typed)


@pytest.mark.parametrize(
    ("path", "ends", "wrong", "why"),
    [
        ("vibration.velocity_ratio", "abc~8", "from", "a number"),
        ("vibration.velocity_ratio", "2~5 N m", "to", "a number without a unit"),
        ("vibration.velocity_ratio", "2~inf", "to", "a number"),
        ("vibration.velocity_ratio", "0~8", "from", "above 0 where steps are even ratios"),
        ("vibration.direction", "0 deg~9 dag", "to", "in a unit such as"),
    ],
)
def test_an_end_that_no_axis_has_is_told_at_its_field_and_nothing_is_promised(
    seen, path, ends, wrong, why
):
    page = seen.open("sweep", case="body-shaken-along", x=f"{path}~{ends}~5~log", y="none")
    if why.startswith("in a unit"):
        page.get_by_label("spacing").select_option("even")
    box = page.locator(f"#x-{wrong}")
    expect(box).to_have_attribute("aria-invalid", "true")
    expect(page.locator(f"#x-{wrong}-why")).to_contain_text(why)
    expect(page.get_by_role("alert").first).to_contain_text(wrong)
    expect(page.get_by_role("button", name="solve the grid")).to_be_disabled()
    expect(page.locator(".controls [role=status]").first).to_have_text("–")
    page.locator("#x-from").fill("1")
    page.locator("#x-from").press("Enter")
    page.locator("#x-to").fill("8")
    page.locator("#x-to").press("Enter")
    expect(page.get_by_role("button", name="solve the grid")).to_be_enabled()
    expect(page.locator(".fault")).to_have_count(0)


def test_a_grid_is_stopped_from_the_list_of_jobs_and_gone_on_with(seen):
    page = seen.open(
        "sweep", case="body-shaken-along", x="vibration.velocity_ratio~1~20~40~even",
        y="vibration.frequency~1 kHz~5 kHz~40~even", **{"set.solve.method": "periodic"},
    )  # fmt: skip
    expect(page.get_by_text("1600 points")).to_be_visible()
    page.get_by_role("button", name="solve the grid").click()
    expect(page.get_by_text(re.compile(r"[1-9]\d* of 1600"))).not_to_have_count(0, timeout=MINUTES)
    page.get_by_role("link", name="Jobs", exact=True).click()
    job = page.locator(".jobs li").filter(has_text="velocity_ratio=1,")
    job.get_by_role("button", name="stop").click()
    expect(job.locator(".state")).to_contain_text("stopped", timeout=MINUTES)
    job.get_by_role("button", name="go on").click()
    expect(job.locator(".state")).to_contain_text(
        re.compile("running, [1-9]|done"), timeout=MINUTES
    )
    if job.get_by_role("button", name="stop").count():
        job.get_by_role("button", name="stop").click()
    expect(job.locator(".state")).to_contain_text(re.compile("stopped|done"), timeout=MINUTES)


def test_a_click_is_seen_at_once_and_what_was_solved_when_it_was_stopped_is_shown(seen):
    page = seen.open(
        "sweep", case="body-shaken-along", x="vibration.velocity_ratio~1~20~40~even",
        y="vibration.frequency~1 kHz~7 kHz~40~even", **{"set.solve.method": "periodic"},
    )  # fmt: skip
    expect(page.get_by_text(re.compile("1600 points, about"))).to_be_visible()
    held = []
    page.route("**/api/jobs", lambda route: held.append(route))
    button = page.get_by_role("button", name="solve the grid")
    button.click()
    state(page, "begun")
    expect(button).to_be_disabled()
    held[0].continue_()
    page.unroute("**/api/jobs")
    expect(page.get_by_text(re.compile(r"[1-9]\d* of 1600 points"))).to_be_visible(timeout=MINUTES)
    page.get_by_role("button", name="stop").click()
    state(page, re.compile("stopped|done"))
    expect(page.locator("figcaption")).not_to_contain_text(": 0 of")
    shown_then = page.locator("figcaption").first.inner_text()
    page.reload()
    expect(page.locator("figcaption").first).to_have_text(shown_then)


LEFT = """async (jobs) => {
  const { left } = await import("/js/work.js");
  return jobs.map((job) => left({ state: "running", answered: false, ...job }));
}"""


def test_a_wait_tells_what_has_passed_and_the_rest_at_the_pace_so_far(seen):
    page = seen.open("jobs")
    jobs = [
        {"done": 10, "total": 100, "seconds": 10},
        # It has become slower: so has the rest.
        {"done": 20, "total": 100, "seconds": 60},
        {"done": 0, "total": 0, "seconds": 42},
        {"done": 1, "total": 100, "seconds": 1},
        {"state": "done", "done": 1, "total": 1, "seconds": 540},
    ]
    assert page.evaluate(LEFT, jobs) == [
        "running, 10 of 100, for 10 s, about 90 s left",
        "running, 20 of 100, for 60 s, about 4 min left",
        "running for 42 s",
        "running, 1 of 100, for 1 s",
        "done after 9 min",
    ]


def test_a_job_is_deleted_with_its_files_once_that_is_confirmed(seen):
    page = seen.open(
        "sweep", case="body-shaken-along", x="vibration.velocity_ratio~3~9~2~log",
        y="none", **{"set.solve.method": "periodic"},
    )  # fmt: skip
    page.get_by_role("button", name="solve the grid").click()
    state(page, DONE)
    page.get_by_role("link", name="Jobs", exact=True).click()
    job = page.locator(".jobs li").filter(has_text="velocity_ratio=3,9")
    job.get_by_role("button", name="delete").click()
    page.get_by_role("button", name="keep it").click()
    expect(job).to_have_count(1)
    job.get_by_role("button", name="delete").click()
    job.get_by_role("button", name="delete it").click()
    expect(job).to_have_count(0)


def test_a_block_is_marched_and_its_pressure_shown(seen, server):
    page = seen.open(
        "block", case="block-shaken-along",
        **{"set.block.elements": "[2, 2, 2]", "set.block.element": "hex8",
           "set.vibration.start": "1 ms", "set.solve.step": "4 us", "set.solve.duration": "3 ms"},
    )  # fmt: skip
    page.get_by_role("button", name="march", exact=True).click()
    expect(page.get_by_text("Pressure under the block")).to_be_visible(timeout=MINUTES)
    job = page.locator(".work [role=status]").nth(1)
    expect(job).to_have_text(DONE, timeout=MINUTES)
    # Both answers of the screen are handed out, settled and marched.
    both = copied(page)
    words = both[both.index("&&") + 1 :]
    assert "solve.method=march" in words
    assert "solve.method=settled" in both
    answer = answered([*words, "--json"], server.folder)
    marched = page.get_by_label("Marched in time").locator("[data-key=ratio]").first
    ratio = float(marched.get_attribute("data-value"))
    assert ratio == pytest.approx(answer["ratio"], rel=1e-9)
    # Its files stand on its screen, and the frames that were kept play.
    box = page.get_by_label("Marched in time")
    expect(box.get_by_role("button", name="block.nc", exact=True)).to_be_visible()
    skin = page.get_by_label("in motion").locator("[data-of=skin]")
    # What is out of the window stands still.
    page.get_by_label("in motion").evaluate("each => each.scrollIntoView()")
    before = skin.inner_html()
    page.wait_for_timeout(500)
    assert skin.inner_html() != before
    # It is listed with its picture, and opens where it belongs as it was asked for.
    page.get_by_role("link", name="Jobs", exact=True).click()
    listed = page.locator(".jobs li").filter(has_text="[2, 2, 2]")
    expect(listed.get_by_role("img", name="what block")).to_be_visible()
    listed.get_by_role("link", name="block block-shaken-along").click()
    expect(page.get_by_role("heading", level=1)).to_have_text("Elastic block")
    expect(page.locator(".work [role=status]").nth(1)).to_have_text(DONE)
    expect(
        page.get_by_label("Marched in time").locator("[data-key=ratio]").first
    ).to_have_attribute("data-value", str(ratio))


SHORT = {"drive.teeth": "1", "drive.phases": "2"}


def test_a_job_of_a_command_without_a_screen_opens_with_its_tables_and_pictures(seen, server):
    begun = server.job("relief", "drive-screw", SHORT, over=["modification.tip_relief=0,20 um"])
    job = server.ended(begun.json["id"], within=300.0)
    assert job["state"] == "done", job
    page = seen.open("jobs")
    page.get_by_role("link", name="relief worm-shaken-as-a-screw").or_(
        page.get_by_role("link", name="relief drive-screw")
    ).first.click()
    found = page.get_by_label("what was found")
    expect(found.locator(".big")).to_contain_text("2 designs")
    told = server.get(f"/api/jobs/{job['id']}/answer").json["told"]
    table = told["tables"][0]
    rows = found.get_by_role("table").first.locator("tbody tr")
    expect(rows).to_have_count(len(table["rows"]))
    for place, row in enumerate(table["rows"]):
        assert [text.strip() for text in rows.nth(place).locator("th, td").all_inner_texts()] == [
            cell.strip() for cell in row
        ]
    for remark in table["remarks"]:
        assert remark.split(";")[0][:40] in found.inner_text()
    picture = found.get_by_role("img", name="relief, drawn")
    picture.scroll_into_view_if_needed()
    expect(picture).to_be_visible()
    assert picture.evaluate("e => e.naturalWidth") > 300
    with page.expect_download(timeout=120_000) as got:
        page.get_by_role("button", name="report", exact=True).click()
    assert "<h2>" in Path(got.value.path()).read_text("utf-8")
    # What is asked of no job says where they are.
    page = seen.open("answer")
    expect(page.get_by_text("No job is named here")).to_be_visible()


def test_further_studies_of_a_drive_say_what_they_need_and_tell_what_they_find(seen):
    page = seen.open("drive", case="drive-screw", **{f"set.{key}": SHORT[key] for key in SHORT})
    page.get_by_text("further: mounting, roots, relief, wear, control").click()
    control = page.get_by_role("region", name="control", exact=True)
    expect(control).to_contain_text("needs [control], which the case does not have")
    expect(control.get_by_role("button", name="run strokes")).to_be_disabled()
    for name in ("misalign", "roots", "relief", "wear"):
        expect(page.get_by_role("region", name=name, exact=True)).to_be_visible()
    expect(page.get_by_role("button", name="let it wear")).to_be_enabled()


@pytest.mark.parametrize(
    ("screen", "case", "fold", "button", "found"),
    [
        (
            "gear",
            "actuator-shafts",
            "shafts and bearings",
            "judge them",
            "Shafts and bearings hold",
        ),
        ("slide", "table-4.3", "a pull at rest", "pull it at rest", "static friction"),
    ],
)
def test_what_else_a_command_answers_is_asked_from_its_screen(
    seen, screen, case, fold, button, found
):
    page = seen.open(screen, case=case)
    settled(page)
    page.get_by_text(f"further: {fold}").click()
    page.get_by_role("button", name=button, exact=True).click()
    expect(page.get_by_text(found).first).to_be_visible(timeout=120_000)
