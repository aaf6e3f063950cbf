"""A page in a real browser, what went wrong on it, and what is looked for there."""

import contextlib
import io
import json
import shlex
from pathlib import Path
from urllib.parse import urlencode

from playwright.sync_api import expect

AXE = Path(__file__).parents[1] / "browser/vendor/axe.js"
LONG = 30_000
"""How long a thing may take to be seen on a busy machine, ms."""

TELL_REST = """
const LONGEST = 240_000;
const { setTimeout: later, clearTimeout: never, fetch: ask } = window;
const soon = new Set();
let asked = 0;
window.setTimeout = (act, delay = 0, ...given) => {
  // What looks again and again at a job is no change that is under way.
  if (delay > 400) return later(act, delay, ...given);
  const name = later(() => { soon.delete(name); act(...given); }, delay);
  soon.add(name);
  return name;
};
window.clearTimeout = (name) => { soon.delete(name); never(name); };
const counted = (answer) => {
  asked += 1;
  return answer.finally(() => { asked -= 1; });
};
window.fetch = (...given) => counted(ask(...given));
// An answer is there once all of it is.
for (const kind of ["json", "text", "blob", "arrayBuffer"]) {
  const read = Response.prototype[kind];
  Response.prototype[kind] = function () { return counted(read.call(this)); };
}
// A screen that is opened for the first time is a module on its way, which nothing else tells.
const coming = () => document.querySelector("main > .wait:not([role])");
const moves = (one) => one.playState === "running" && one.effect.getComputedTiming().endTime < 1e4;
window.rest = async () => {
  const began = performance.now();
  for (let still = 0; still < 4; ) {
    await new Promise(requestAnimationFrame);
    if (performance.now() - began > LONGEST)
      throw new Error(`not at rest: ${asked} asked, ${soon.size} soon`);
    const busy = soon.size || asked || coming() || document.getAnimations().some(moves);
    still = busy ? 0 : still + 1;
  }
};
"""
"""What lets a page tell when nothing of it is to be done soon, is asked, or moves."""


class Seen:
    """A page in a context of its own.

    Parameters
    ----------
    browser : Browser
        That of the session.
    server : Served
        That of the session.
    context : dict
        Options of the context, such as ``color_scheme`` or ``viewport``.
    """

    def __init__(self, browser, server, **context):
        self.server = server
        self.origin = f"http://127.0.0.1:{server.port}"
        self.context = browser.new_context(**{"viewport": {"width": 1400, "height": 900}} | context)
        self.context.set_default_timeout(LONG)
        self.context.add_init_script(TELL_REST)
        self.page = self.context.new_page()
        self.complaints, self.elsewhere = [], []
        self.page.on("pageerror", lambda error: self.complaints.append(str(error)))
        self.page.on("console", self._heard)
        self.page.on("request", self._asked)

    def _heard(self, message):
        # What the server refuses is told on the page; the browser notes it besides, and what it
        # costs to draw in space without a graphics card.
        noted = ("Failed to load resource", "GL Driver Message")
        if message.type in ("error", "warning") and not any(one in message.text for one in noted):
            self.complaints.append(message.text)

    def _asked(self, request):
        if not request.url.startswith((self.origin, f"blob:{self.origin}", "about:")):
            self.elsewhere.append(request.url)

    def open(self, screen, **params):
        """Open a screen cold, with what stands in its address; returns playwright's page."""
        query = urlencode({**params, "token": self.server.token})
        self.page.goto("about:blank")
        self.page.goto(f"{self.origin}/#/{screen}?{query}")
        return self.page

    def close(self):
        """Close it; whatever was complained of fails the test."""
        self.context.close()
        assert not self.complaints, self.complaints
        assert not self.elsewhere


def settled(page):
    """Wait until the address says what is set and nothing is asked any more."""
    page.evaluate("rest()")
    expect(page.locator(".busy.on")).to_have_count(0)


def tab_to(page, name, most=120):
    """Press Tab until what is focused is called so; fails if nothing is within ``most``."""
    for _ in range(most):
        page.keyboard.press("Tab")
        said = page.evaluate(
            "(e => e.getAttribute('aria-label') || e.labels?.[0]?.textContent || e.textContent)"
            "(document.activeElement)"
        )
        if name in said:
            return
    raise AssertionError(f"{name} is not reached by the keyboard")


def shown(page, key):
    """Return the number on the screen whose key in ``--json`` this is, in full."""
    return float(page.locator(f"[data-key='{key}']").first.get_attribute("data-value"))


def copied(page):
    """Return the command that the screen hands out, as words."""
    return shlex.split(page.get_by_role("button", name="copy command").get_attribute("title"))


def answered(words, folder):
    """Return what a command of asperity prints as JSON, run in this process."""
    from asperity.cli.main import main

    output = io.StringIO()
    with (
        contextlib.chdir(folder),
        contextlib.redirect_stdout(output),
        contextlib.suppress(SystemExit),
    ):
        main(words[1:])
    return json.loads(output.getvalue())


THIN = """
document.querySelectorAll("tbody").forEach((body) =>
  [...body.rows].slice(20).forEach((row) => row.remove()));
"""
"""Leaves twenty rows of each table: of the numbers of a curve there are thousands."""


def violations(page):
    """Return what axe finds; the context must bypass the page's policy.

    It looks at each element in turn: tables lose rows that are the same thousands of times over.
    """
    page.evaluate(THIN)
    if not page.evaluate("Boolean(window.axe)"):
        page.evaluate(AXE.read_text("utf-8"))
    found = page.evaluate("axe.run(document, {resultTypes: ['violations']})")["violations"]
    return [
        (rule["id"], [(node["target"], node["failureSummary"]) for node in rule["nodes"][:3]])
        for rule in found
    ]
