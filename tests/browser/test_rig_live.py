"""A run of the rig is seen in a browser while it goes on, and its stop button switches off."""

import os
import shutil
import signal
from pathlib import Path

import pytest
from apparatus import rigs
from apparatus.browser import settled, tab_to, violations
from apparatus.forked_guardian import Dials
from apparatus.standing_rig import Procedure, StandingRig, waited_for
from playwright.sync_api import expect

from asperity.tribometer.guardian import switching
from asperity.tribometer.guardian.journal import Journal

pytestmark = [
    pytest.mark.filterwarnings("ignore::DeprecationWarning"),
    pytest.mark.skipif(os.name != "posix", reason="processes are forked"),
]

OUTPUTS = {"vibration", "amplifier", "steel", "bronze"}
LONG = 60.0


@pytest.fixture(scope="module")
def rig():
    made = StandingRig(_case())
    yield made
    made.close()


def _case():
    return rigs.small_case(
        f'guardian.patience="{LONG} s"', f'guardian.deadline="{LONG} s"', 'plan.before="4 s"'
    )


@pytest.fixture
def vibrates(browser, server, rig):
    """A run in the page's folder that vibrates until it is let go on."""
    rig.quiet()
    rig.hold(True)
    dials = Dials(patience=LONG, deadline=LONG, limit=switching._LIMIT, opening=20.0)
    folder = Path(server.folder, "bench")
    procedure = Procedure(_case(), folder, rig, dials=dials)
    waited_for(lambda: "vibration" in rig.on())
    yield procedure
    rig.sound()
    rig.hold(False)
    procedure.end()
    procedure.gone()
    shutil.rmtree(folder)


def live(page):
    return page.get_by_role("region", name="live").filter(has_text="bench")


def test_a_run_is_seen_as_it_goes_on_and_its_stop_switches_everything_off(seen, rig, vibrates):
    page = seen.open("rig")
    panel = live(page)
    expect(panel).to_contain_text("0 of 2 cells. Now: Cell 1: sine of 250 Hz")
    expect(panel).to_contain_text("Next: Cell 2: sine of 750 Hz")
    drive = panel.get_by_role("row", name="vibration controller")
    expect(drive).to_contain_text("on, sine 250 Hz")
    expect(panel.locator("figure", has_text="Live: torque")).to_be_visible()
    expect(panel.get_by_role("status")).to_have_text("it goes on")
    # Nothing is said of an output that nobody has read back.
    expect(panel.get_by_text("✓")).to_have_count(0)
    # By the keyboard as well.
    tab_to(page, "stop: switch everything off")
    page.keyboard.press("Enter")
    expect(panel).to_contain_text("Read back to be off within")
    assert not OUTPUTS & set(rig.on())
    expect(panel.get_by_role("status")).to_have_text("interrupted: stopped after 0 of 2 cells")
    expect(drive).to_contain_text("its state is off")
    # What it was told last, by the guardian.
    expect(drive).not_to_contain_text("on, sine 250 Hz")
    expect(panel.get_by_role("button", name="stop")).to_have_count(0)
    assert vibrates.ended() == 130


def test_the_stop_works_where_the_procedure_hangs_and_what_stays_on_is_named(seen, rig, vibrates):
    page = seen.open("rig")
    panel = live(page)
    expect(panel.get_by_role("status")).to_have_text("it goes on")
    vibrates.kill(signal.SIGSTOP)
    expect(panel.get_by_role("status")).to_contain_text("it may hang; stop works all the same")
    rig.fault("steel", "stuck on")
    panel.get_by_role("button", name="stop").click()
    expect(panel.get_by_role("alert")).to_contain_text(
        "Not read back to be off: supply of the steel disc's motor: its output's state is on"
    )
    assert OUTPUTS & set(rig.on()) == {"steel"}
    expect(panel.get_by_role("status")).to_have_text("not all of it was read back to be off")
    expect(panel).not_to_contain_text("Now: Cell 1")
    rig.sound()
    expect(panel).to_contain_text("Read back to be off within")
    vibrates.kill(signal.SIGCONT)
    vibrates.ended()
    vibrates.gone()
    # Where a person switches, nobody has read anything.
    book = Journal(vibrates.folder)
    book.write("off", why="signal SIGTERM", took_s=0.0, read_back={}, by_hand=["lamp"])
    book.close()
    expect(panel).to_contain_text("Nothing reads back, and a person is asked to switch off: lamp.")
    expect(panel).not_to_contain_text("Read back to be off within")


@pytest.mark.campaign
def test_axe_finds_nothing_and_nothing_is_wider_than_a_phone(seen_as, vibrates):
    seen = seen_as(bypass_csp=True, viewport={"width": 360, "height": 900})
    page = seen.open("rig")
    expect(live(page)).to_contain_text("on, sine 250 Hz")
    for scheme in ("light", "dark"):
        page.emulate_media(color_scheme=scheme)
        settled(page)
        assert violations(page) == [], scheme
    assert page.evaluate("document.documentElement.scrollWidth") <= 360
