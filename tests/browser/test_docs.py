"""The docs on a phone: no page scrolls sideways, and none asks for anything elsewhere."""

from pathlib import Path

import pytest

BUILT = Path(__file__).parents[2] / "docs" / "_build" / "html"
WIDTH = 360

# What reaches beyond a page without a bar of its own to be scrolled by.
BEYOND = """() => {
  const wide = document.documentElement.clientWidth;
  if (document.documentElement.scrollWidth <= wide) return [];
  const far = [...document.querySelectorAll("article *")]
    .filter(e => e.getBoundingClientRect().right > wide + 1);
  return far.slice(0, 5).map(e => e.tagName + " " + (e.textContent || "").trim().slice(0, 40));
}"""


@pytest.fixture(scope="module")
def pages():
    """The pages as they are built, without those of sources."""
    if not (BUILT / "index.html").is_file():
        pytest.skip("the docs are not built: make docs")
    found = [page for page in BUILT.rglob("*.html") if "_static" not in page.parts]
    assert len(found) > 30
    return sorted(found)


def test_no_page_of_the_docs_scrolls_sideways_on_a_phone_or_asks_for_anything(browser, pages):
    page = browser.new_page(viewport={"width": WIDTH, "height": 800})
    asked, beyond = [], {}
    page.on("request", lambda request: asked.append(request.url))
    for path in pages:
        page.goto(path.as_uri())
        if page.evaluate("() => document.documentElement.scrollWidth") > WIDTH:
            beyond[path.name] = page.evaluate(BEYOND)
    page.close()
    assert beyond == {}
    assert [url for url in asked if not url.startswith(("file:", "data:"))] == []
