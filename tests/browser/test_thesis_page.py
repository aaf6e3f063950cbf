"""The page that ``asperity thesis`` writes, in a browser: at a glance, sought, narrow, on paper."""

import pytest
from playwright.sync_api import expect

from asperity.cli.main import main

PHONE = {"width": 390, "height": 844}
ONLY = ("3.1", "3.2", "4.1")

# What reaches beyond the page and lies in nothing that scrolls within it.
BEYOND = """() => [...document.querySelectorAll("main *")]
  .filter(e => e.getClientRects().length && e.getBoundingClientRect().right > innerWidth + 1)
  .filter(e => { const box = e.closest(".wide");
    return !box || getComputedStyle(box).overflowX !== "auto"
      || box.getBoundingClientRect().right > innerWidth + 1; })
  .map(e => e.tagName + " " + e.textContent.trim().slice(0, 40))"""


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    """The page of a few claims, figures and tables, made once."""
    folder = tmp_path_factory.mktemp("thesis")
    asked = [word for number in ONLY for word in ("--only", number)]
    with pytest.raises(SystemExit) as ended:
        main(["thesis", *asked, "--out", str(folder)])
    assert not ended.value.code
    return folder / "index.html"


@pytest.fixture
def page(browser, written):
    """It, open."""
    context = browser.new_context(viewport={"width": 1200, "height": 900})
    page = context.new_page()
    page.goto(written.as_uri())
    yield page
    context.close()


def test_a_chapter_has_a_strip_of_its_verdicts_each_of_which_leads_to_its_card(page):
    claims = page.locator("article.claim")
    assert claims.count() == len(ONLY)
    marks = page.locator("ul.strip a")
    assert marks.count() == claims.count()
    for mark in marks.all():
        card = page.locator(mark.get_attribute("href").replace(".", "\\."))
        expect(card).to_have_count(1)
        # The same verdict in the strip as on the card, the thesis's words and how it was made.
        assert card.get_attribute("data-verdict") in mark.get_attribute("class")
        expect(card.locator("blockquote").first).to_be_visible()
        expect(card.locator(".verdict")).to_be_visible()


def test_search_and_verdict_leave_what_fits_and_say_how_much(page):
    everything = page.locator(
        "article.claim:visible, section figure:visible, section .wide:visible"
    )
    whole = everything.count()
    first = page.locator("article.claim").first
    verdict, number = first.get_attribute("data-verdict"), first.get_attribute("id")
    verdicts, sought = page.get_by_role("combobox"), page.get_by_role("searchbox")
    verdicts.select_option(verdict)
    for card in page.locator("article.claim:visible").all():
        assert card.get_attribute("data-verdict") == verdict
    expect(page.locator(f"[id='{number}']")).to_be_visible()
    expect(page.locator(".search [role=status]")).to_have_text(f"{everything.count()} of {whole}")
    verdicts.select_option("")
    sought.fill("no such word stands there")
    expect(everything).to_have_count(0)
    sought.fill("")
    expect(everything).to_have_count(whole)


@pytest.mark.parametrize("words", [("ηges", "η_ges", "eta_ges"), ("vgm", "v_gm", "V_GM")])
def test_a_symbol_is_found_as_it_is_set_as_it_is_written_and_by_its_letter_s_name(page, words):
    shown = page.locator("article.claim:visible, section figure:visible, section .wide:visible")
    whole, counts = shown.count(), []
    sought = page.get_by_role("searchbox")
    for word in words:
        sought.fill(word)
        counts.append(shown.count())
    assert 0 < counts[0] < whole
    assert min(counts) == counts[0], counts


@pytest.mark.parametrize("mu", ["\u00b5", "\u03bc"])
def test_either_sign_of_mu_is_found(page, mu):
    page.get_by_role("searchbox").fill(mu)
    assert page.locator("article.claim:visible").count() > 0


def test_on_a_phone_nothing_goes_beyond_the_page_but_tables_that_scroll_in_theirs(page):
    page.set_viewport_size(PHONE)
    assert page.locator("table.numbers").count() > 0
    assert page.evaluate(BEYOND) == []
    assert page.evaluate("document.documentElement.scrollWidth") <= PHONE["width"]


def test_on_paper_stands_all_but_the_search_and_nothing_is_folded_away(page):
    folded = page.locator("details")
    assert folded.count() > 0
    page.emulate_media(media="print")
    page.set_viewport_size({"width": 718, "height": 1000})
    page.evaluate("dispatchEvent(new Event('beforeprint'))")
    expect(page.locator(".search")).to_be_hidden()
    assert page.locator("details:not([open])").count() == 0
    assert page.evaluate("document.documentElement.scrollWidth") <= 718
    assert 1 <= page.pdf(format="A4").count(b"/Type /Page\n") <= SHEETS


SHEETS = 24
