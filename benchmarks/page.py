"""How fast the page answers a slider that is dragged, against an empty round trip in the same run.

Without a browser: what a change of the sliding body takes from request to answer, beside what the
same connection takes for nothing at all; processor time and bytes of a change; and the time from
the start of the command to the first page. In chromium, where it is installed: from the input
event of a slider to the frame in which the new ratio stands.
"""

import http.client
import json
import os
import shutil
import statistics
import sys
import tempfile
import time
from pathlib import Path

from _common import finish

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))

from apparatus.page import Served, memory, processor_time

CHANGES = 200
MOST = 4.0

# From the input event to the frame behind the one in which the number changed, as for nothing.
PAINTED = """async (times) => {
  const slider = [...document.querySelectorAll('input[type=range]')]
    .find((each) => each.labels?.[0]?.textContent.includes('direction'));
  const ratio = () => document.querySelector('[data-key=ratio]')?.dataset.value;
  const frame = () => new Promise(requestAnimationFrame);
  const found = [];
  for (let n = 0; n < times; n += 1) {
    const before = ratio();
    const began = performance.now();
    slider.value = String(1 + ((n * 7) % 88));
    slider.dispatchEvent(new Event('input', { bubbles: true }));
    while (ratio() === before && performance.now() - began < 5000) await frame();
    await frame();
    found.push(performance.now() - began);
    await new Promise((done) => setTimeout(done, 60));
  }
  return found;
}"""


def main():
    began = time.perf_counter()
    page = Served(tempfile.mkdtemp(), dict(os.environ))
    try:
        page.get("/")
        seen = time.perf_counter() - began
        while not page.get("/api/about").json["ready"]:
            time.sleep(0.05)
        report = {"start": {"seconds to the first page": seen}, "change": of_a_change(page)}
        chromium = shutil.which("chromium") or shutil.which("chromium-browser")
        if chromium:
            report["change, painted"] = painted(page, chromium, report["change"])
        worker = page.child("worker")
        report["memory"] = {
            "server, MB": memory(page.process.pid),
            "worker, MB": memory(worker),
            "desk, MB": memory(page.child("desk")),
        }
    finally:
        page.close()
    # As a multiple of a round trip that brings nothing.
    most = {"seconds to the first page": 1.0, "processor, ms": 15.0, "kB": 16.0,
            "median over empty": MOST, "server, MB": 80.0, "worker, MB": 300.0}  # fmt: skip
    finish(report, most=most)


def of_a_change(page):
    """Return what a change takes over one connection that stays open."""
    connection = http.client.HTTPConnection("127.0.0.1", page.port)
    headers = {"X-Asperity-Token": page.token, "Content-Type": "application/json"}

    def ask(method, path, body=None):
        began = time.perf_counter()
        connection.request(method, path, json.dumps(body) if body else None, headers)
        size = len(connection.getresponse().read())
        return 1e3 * (time.perf_counter() - began), size

    def change(number):
        settings = {"solve.method": "periodic", "vibration.direction": f"{number % 90} deg"}
        return ask("POST", "/api/do/slide", {"case": "table-4.3", "settings": settings})

    for number in range(20):
        change(number)
    processes = page.process.pid, page.child("worker")
    spent = sum(map(processor_time, processes))
    found = [change(number) for number in range(CHANGES)]
    spent = sum(map(processor_time, processes)) - spent
    # A question that the server hands on and that is answered by nothing.
    empty = [ask("GET", f"/api/jobs/{'0' * 32}")[0] for _ in range(CHANGES)]
    times = [each for each, _ in found]
    return {
        "median, ms": statistics.median(times),
        "95th, ms": statistics.quantiles(times, n=20)[-1],
        "empty round trip, ms": statistics.median(empty),
        "processor, ms": 1e3 * spent / CHANGES,
        "kB": max(size for _, size in found) / 1e3,
    }


def painted(page, chromium, change):
    """Return what a change takes until it is painted."""
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        arguments = ["--disable-gpu", "--no-sandbox"]
        browser = playwright.chromium.launch(executable_path=chromium, args=arguments)
        try:
            shown = browser.new_page()
            shown.goto(page.address.replace("?", "?case=table-4.3&set.solve.method=periodic&"))
            shown.wait_for_selector("[data-key=ratio]")
            shown.wait_for_timeout(1000)
            times = shown.evaluate(PAINTED, 60)[10:]
            empty = shown.evaluate(
                """async (path) => {
                  const headers = { 'X-Asperity-Token': sessionStorage.getItem('asperity-token') };
                  const frame = () => new Promise(requestAnimationFrame);
                  const found = [];
                  for (let n = 0; n < 50; n += 1) {
                    const began = performance.now();
                    await (await fetch(path, { headers })).text();
                    await frame();
                    await frame();
                    found.push(performance.now() - began);
                  }
                  return found;
                }""",
                f"/api/jobs/{'0' * 32}",
            )
        finally:
            browser.close()
    median, nothing = statistics.median(times), statistics.median(empty)
    return {
        "median, ms": median,
        "95th, ms": statistics.quantiles(times, n=20)[-1],
        "empty round trip, ms": nothing,
        "median over empty": median / nothing,
        "95th over empty": statistics.quantiles(times, n=20)[-1] / nothing,
    }


if __name__ == "__main__":
    main()
