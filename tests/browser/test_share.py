"""A screen as one file: without server and network it shows what it was made from, and the case."""

import json
import shlex
from pathlib import Path

import numpy as np
import pytest
from apparatus.browser import answered, settled
from apparatus.shown_numbers import in_si, numbers
from playwright.sync_api import expect

MOST_BYTES = 2_000_000


@pytest.fixture
def shared(seen, tmp_path):
    """Share a screen; returns the file, and playwright's page of it, offline on a phone."""
    contexts = []

    def share(screen, **params):
        page = seen.open(screen, **params)
        button = page.get_by_role("button", name="share", exact=True)
        expect(button).to_be_visible()
        settled(page)
        with page.expect_download(timeout=120_000) as download:
            button.click()
        path = tmp_path / download.value.suggested_filename
        download.value.save_as(path)
        phone = {"viewport": {"width": 360, "height": 740}, "offline": True}
        contexts.append(seen.context.browser.new_context(**phone))
        opened = contexts[-1].new_page()
        opened.on("pageerror", lambda error: pytest.fail(str(error)))
        opened.on("console", lambda said: pytest.fail(said.text))
        opened.goto(path.as_uri())
        return path, opened

    yield share
    for context in contexts:
        context.close()


def of_case(page, command, folder, tmp_path):
    """Return what the command line says of the case that stands in a file."""
    case = tmp_path / "again.toml"
    case.write_text(page.locator("#case").inner_text())
    return answered(["asperity", command, str(case), "--json"], folder)


def told_of(answer, key):
    """Return the number of an answer that has a key such as ``iso14521.eta_ges``."""
    while key:
        # Keys have dots of their own.
        part = max((one for one in answer if f"{key}.".startswith(f"{one}.")), key=len)
        answer, key = answer[part], key[len(part) + 1 :]
    return answer


def as_seen(page, answer, least, place="main", rel=2e-2):
    """Say that each number that is seen in a file is that of ``--json``, but for its digits."""
    found = numbers(page, place)
    assert len(found) >= least
    for one in found.values():
        if "within" in one["text"]:
            continue
        exact = told_of(answer, one["key"])
        # Of a time or a distance of rounding, what one march gives another does not.
        assert float(one["value"]) == pytest.approx(exact, rel=1e-5, abs=1e-12), one
        assert in_si(one["text"], one["unit"], one["of"]) == pytest.approx(exact, rel=rel), one


@pytest.mark.parametrize(
    ("screen", "params", "command", "keys"),
    [
        ("slide", {"set.vibration.direction": "30 deg"}, "slide", ["ratio", "drive_force_N"]),
        ("gear", {"case": "worm-15-to-1"}, "rate", ["iso14521"]),
    ],
)
def test_a_shared_file_holds_the_numbers_and_the_case_that_gives_them(
    shared, server, tmp_path, screen, params, command, keys
):
    path, page = shared(screen, **params)
    assert path.stat().st_size < MOST_BYTES
    told = json.loads(page.locator("#answer").text_content())
    again = of_case(page, command, server.folder, tmp_path)
    for key in keys:
        assert again[key] == told[key]
    as_seen(page, again, {"slide": 5, "gear": 10}[screen])
    assert page.evaluate("document.documentElement.scrollWidth") <= 360
    expect(page.get_by_text("Made on")).to_contain_text(f"asperity {command}")
    with page.expect_download(timeout=120_000) as download:
        page.get_by_role("button", name="save the case").click()
    saved = Path(download.value.path()).read_text()
    assert saved == page.locator("#case").text_content()


# Of each screen that moves: what of it does, and which of its attributes says where.
MOVING = {
    "slide": (".stage .dot", "cy", {"case": "body-shaken-across"}),
    "gear": (".mesh [data-of=wheel]", "transform", {}),
    "drive": (".mesh [data-of=threads]", "transform", {}),
    "block": (".deformed [data-of=skin] path", "d", {}),
    "flanks": (".map .touching", "d", {}),
}


@pytest.mark.parametrize("screen", MOVING)
def test_what_moves_on_a_screen_moves_in_its_file_without_a_server_and_stops(shared, screen):
    one, attribute, params = MOVING[screen]
    path, page = shared(screen, **params)
    assert path.stat().st_size < MOST_BYTES
    moving = page.locator(one).first
    # What moves is never at rest, as playwright would have it.
    moving.evaluate("each => each.scrollIntoView({block: 'center'})")
    page.get_by_role("button", name="stop the motion").wait_for()
    expect(moving).not_to_have_attribute(attribute, moving.get_attribute(attribute))
    page.get_by_role("button", name="stop the motion").click()
    page.wait_for_timeout(100)
    there = page.locator("[data-moves]").evaluate_all("all => all.map((one) => one.outerHTML)")
    page.wait_for_timeout(300)
    assert there == page.locator("[data-moves]").evaluate_all(
        "all => all.map((one) => one.outerHTML)"
    )


def test_a_shared_file_of_a_reader_who_wants_nothing_to_move_stands_still(shared, browser):
    path, _ = shared("slide", case="body-shaken-across")
    context = browser.new_context(reduced_motion="reduce", offline=True)
    page = context.new_page()
    page.goto(path.as_uri())
    dot = page.locator(".stage .dot")
    before = dot.get_attribute("cy")
    page.wait_for_timeout(300)
    assert dot.get_attribute("cy") == before
    page.get_by_role("button", name="let it move").click()
    expect(dot).not_to_have_attribute("cy", before)
    context.close()


@pytest.mark.campaign
@pytest.mark.parametrize(
    ("screen", "keys", "picture"),
    [
        ("flanks", ["pattern_area_fraction"], ".map svg"),
        ("drive", ["torque_ratio", "power_actuator_W"], "svg.strips"),
        ("block", ["ratio", "slider_ratio"], ".map-of"),
        ("sweep", ["ratio"], ".heat svg"),
    ],
)
def test_what_took_long_is_shared_with_its_pictures_and_its_command_gives_it_again(
    shared, server, tmp_path, screen, keys, picture
):
    path, page = shared(screen)
    assert path.stat().st_size < MOST_BYTES
    expect(page.locator(picture).first).to_be_visible()
    told = json.loads(page.locator("#answer").text_content())
    case = tmp_path / "again.toml"
    case.write_text(page.locator("#case").inner_text())
    _, command, _, *rest = shlex.split(page.locator(".says code").first.text_content())
    # Of a screen with two answers the first command is that of the numbers asked for here.
    rest = rest[: rest.index("&&")] if "&&" in rest else rest
    # What was set stands in the case.
    sets = {at for at, word in enumerate(rest) if word == "--set"}
    rest = [word for at, word in enumerate(rest) if not {at, at - 1} & sets and word != "--json"]
    again = answered(["asperity", command, str(case), *rest, "--json"], server.folder)
    for key in keys:
        np.testing.assert_allclose(again[key], told[key], rtol=1e-5)
    if screen != "sweep":
        # Others of the screen are of other jobs.
        least, place = {"flanks": (4, "main"), "drive": (8, ":is(.headline, [aria-label=shaken])"),
                        "block": (2, ".headline")}[screen]  # fmt: skip
        as_seen(page, again, least, place)
    else:
        # Its picture is seen, and in words where the least is.
        least = page.locator(".big b").first.inner_text()
        assert float(least) == pytest.approx(np.nanmin(np.array(told["ratio"], float)), rel=1e-2)
    assert page.evaluate("document.documentElement.scrollWidth") <= 360


def test_a_shared_file_whose_command_needs_more_than_the_case_says_what(shared):
    _, page = shared("size")
    expect(page.get_by_text("The command gives the proposals again")).to_contain_text(
        "Save the case as gearset-3.toml, and asperity optimise gearset-3.toml finds"
    )
    # What is pressed on the page is no word of the file.
    assert "take" not in page.locator("table").first.inner_text().split()
    _, page = shared("rig")
    expect(page.get_by_text("The command reads simulated-run.nc")).to_contain_text(
        "which is not in here"
    )
    assert "[friction]" in page.locator("#case").inner_text()
