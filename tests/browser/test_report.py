"""Reports in a real browser: nothing cut, nothing over another, nothing asked for."""

import functools

import pytest

from asperity.cli.main import main

TEETH = (
    'drive.deflection=[["22 N m", "50 urad"], ["366 N m", "365 urad"]]',
    "drive.effective_radius=9.8 mm", "drive.tangential_compliance=2.9 nm/N",
)  # fmt: skip
COMMANDS = {
    "flank": ("flank", "gearset-3b", "--density", "coarse"),
    "rate": ("rate", "gearset-3", "--set=project.customer=A customer with a long name"),
    "drive": ("drive", "drive-screw", *(f"--set={each}" for each in TEETH)),
}

# Elements with text or pictures that reach beyond the page or beyond what cuts them off, and texts
# that stand over one another.
FAULTS = """() => {
  const wide = document.documentElement.clientWidth, found = [];
  const label = e => e.tagName + " " + (e.textContent || "").trim().slice(0, 40);
  const seen = [...document.querySelectorAll("h1,h2,p,li,dt,dd,td,th,caption,figcaption,img,svg")]
    .filter(e => !e.closest("svg") || e.tagName === "svg")
    .filter(e => getComputedStyle(e).clipPath === "none" && e.getClientRects().length);
  const hidden = e => e.closest("thead")
    && getComputedStyle(e.closest("thead")).clipPath !== "none";
  for (const e of seen) {
    if (hidden(e)) continue;
    const box = e.getBoundingClientRect();
    if (box.left < -1 || box.right > wide + 1) found.push("beyond the page: " + label(e));
    if (e.scrollWidth > e.clientWidth + 1 && e.clientWidth && e.tagName !== "svg")
      found.push("cut: " + label(e));
  }
  const leaves = seen.filter(e => !hidden(e) && !seen.some(o => o !== e && e.contains(o)));
  const boxes = leaves.map(e => [e, e.getBoundingClientRect()]);
  for (let i = 0; i < boxes.length; i++) for (let j = i + 1; j < boxes.length; j++) {
    const [a, p] = boxes[i], [b, q] = boxes[j];
    const w = Math.min(p.right, q.right) - Math.max(p.left, q.left);
    const h = Math.min(p.bottom, q.bottom) - Math.max(p.top, q.top);
    if (w > 2 && h > 2) found.push("over one another: " + label(a) + " / " + label(b));
  }
  if (document.documentElement.scrollWidth > wide) found.push("the page scrolls sideways");
  return [...new Set(found)].slice(0, 10);
}"""


def report(command, folder):
    """Write the report of a command."""
    with pytest.raises(SystemExit) as ended:
        main([*COMMANDS[command], "--out", str(folder)])
    assert not ended.value.code


@pytest.fixture(scope="module")
def reports(tmp_path_factory):
    """The folder of a command's report, made once."""

    @functools.cache
    def made(command):
        folder = tmp_path_factory.mktemp(command)
        report(command, folder)
        return folder

    return made


@pytest.mark.campaign
@pytest.mark.parametrize("command", COMMANDS)
def test_a_report_fits_each_width_and_asks_for_nothing(browser, reports, tmp_path, command):
    asked, said = [], []
    for width in (1200, 794, 390):
        page = browser.new_page(viewport={"width": width, "height": 900})
        page.on("request", lambda request: asked.append(request.url))
        page.on("console", lambda message: said.append(message.text))
        page.goto((reports(command) / "report.html").as_uri())
        assert page.evaluate(FAULTS) == [], width
        page.screenshot(path=tmp_path / f"{width}.png", full_page=True)
        page.close()
    assert [url for url in asked if not url.startswith(("file:", "data:"))] == []
    assert len([url for url in asked if url.startswith("file:")]) == 3
    assert said == []


def frames(page, count):
    """What a page shows of the gearset in mesh, a few times one after the other."""
    picture = page.locator("figure", has_text="In mesh").locator("img:visible")
    assert picture.count() == 1
    found = set()
    for _ in range(count):
        found.add(picture.screenshot(animations="allow"))
        page.wait_for_timeout(130)
    return picture.get_attribute("class"), found


@pytest.mark.parametrize(
    ("wish", "shown"), [({"reduced_motion": "no-preference"}, "moving"),
                        ({"reduced_motion": "reduce"}, "still"), ({"media": "print"}, "still")]
)  # fmt: skip
def test_the_gearset_turns_where_that_is_wanted_and_else_a_still_stands(
    browser, reports, wish, shown
):
    pytest.importorskip("pyvista")
    assert (reports("flank") / "report.html").stat().st_size < 2_000_000
    page = browser.new_page()
    page.emulate_media(**wish)
    page.goto((reports("flank") / "report.html").as_uri())
    name, found = frames(page, 5)
    page.close()
    assert name == shown
    assert (len(found) > 1) == (shown == "moving")


def test_a_report_prints_on_a4_with_its_pages_counted(browser, reports, tmp_path):
    page = browser.new_page()
    page.goto((reports("rate") / "report.html").as_uri())
    printed = page.pdf(prefer_css_page_size=True, path=tmp_path / "report.pdf")
    page.close()
    # Points of A4, and more than one page.
    assert b"/MediaBox [0 0 594" in printed or b"/MediaBox [0 0 595" in printed
    assert printed.count(b"/Type /Page\n") > 1
