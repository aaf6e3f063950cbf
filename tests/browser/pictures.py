"""Draw the pictures of docs/page.rst anew: ``python tests/browser/pictures.py [SCREEN ...]``.

Needs chromium, and some minutes for what is computed.
"""

import io
import os
import re
import shutil
import sys
import tempfile
from pathlib import Path

from PIL import Image
from playwright.sync_api import expect, sync_playwright

HERE = Path(__file__).parent
sys.path[:0] = [str(HERE.parent)]

from apparatus.browser import LONG, Seen  # noqa: E402
from apparatus.page import Served  # noqa: E402

PICTURES = HERE.parents[1] / "docs/_static/page"
LONGEST = 420_000
"""How long a job may take, ms."""
COLOURS = 160
SIZE = {"width": 1200, "height": 780}

SCREENS = {
    "slide": ({"case": "body-shaken-along", "set.solve.method": "periodic",
               "set.vibration.direction": "35 deg"}, (), "Over a cycle"),
    "gear": ({"case": "worm-15-to-1"}, (), "first to fail"),
    "size": ({}, (), "least safety"),
    "flanks": ({}, (), "numbers"),
    "drive": ({}, (), "Worth it?"),
    "rig": ({}, (), "What vibration did"),
    "sweep": ({"case": "body-shaken-along", "set.solve.method": "periodic"},
              ("solve the grid",), "399 of 399 points"),
    "thesis": ({}, (), "claims are reproduced"),
    "block": ({}, (), "The pressure under it"),
    "jobs": ({}, (), "done after"),
}  # fmt: skip
"""What stands in the address, what is begun, and what is seen when it has come."""


def draw(seen: Seen, screen: str) -> None:
    """Open a screen, begin what takes longer, and keep what is seen then."""
    params, begin, comes = SCREENS[screen]
    page = seen.open(screen, **params)
    for name in begin:
        page.get_by_role("button", name=name, exact=True).click()
    page.locator("main").get_by_text(comes).first.wait_for(timeout=LONGEST)
    if begin:
        ended = page.get_by_text(re.compile("^done after"))
        expect(ended).to_have_count(len(begin), timeout=LONGEST)
    page.wait_for_timeout(2500)
    image = Image.open(io.BytesIO(page.screenshot())).convert("RGB")
    PICTURES.mkdir(exist_ok=True)
    image.quantize(COLOURS, dither=Image.Dither.NONE).save(
        PICTURES / f"{screen}.png", optimize=True
    )
    print(screen, (PICTURES / f"{screen}.png").stat().st_size, flush=True)


def main(screens: list[str]) -> None:
    """Draw some screens, or all."""
    chromium = shutil.which("chromium") or shutil.which("chromium-browser")
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        server = Served(folder, dict(os.environ), "--port", "0")
        arguments = ["--no-sandbox", "--enable-unsafe-swiftshader"]
        browser = playwright.chromium.launch(executable_path=chromium, args=arguments)
        try:
            for screen in screens or SCREENS:
                seen = Seen(browser, server, viewport=SIZE)
                seen.page.set_default_timeout(LONG)
                try:
                    draw(seen, screen)
                except Exception as error:
                    print(screen, str(error)[:300], file=sys.stderr, flush=True)
                seen.context.close()
        finally:
            server.close()


if __name__ == "__main__":
    main(sys.argv[1:])
