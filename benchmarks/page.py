"""How fast the page answers a slider that is dragged, against an empty round trip in the same run.

Without a browser: what a change of the sliding body takes from request to answer, beside what the
same connection takes for nothing at all; processor time and bytes of a change; and the time from
the start of the command to the first page. In chromium, where it is installed: from the input
event of a slider to the frame in which the new ratio stands, as a multiple of a request that brings
nothing; frames a second of the moving body, drawn by software; the longest task while its handle is
dragged, by the processor's time, since others who have the cores make any task long; and how soon
each screen opens with its answer, on this machine and on one that has compiled nothing, beside an
empty page that the same browser opens from the same server; and what three walks from a question to
its answer and on to the shared file take, in clicks and seconds. What runs besides is told as the
load.
"""

import contextlib
import http.client
import json
import math
import os
import shutil
import statistics
import sys
import tempfile
import time
from pathlib import Path

from _common import finish

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))

from apparatus.browser import TELL_REST
from apparatus.page import Served, descendants, memory
from apparatus.walks import Walk, to_a_law, to_a_report, to_a_shared_file, to_the_best_way

CHANGES = 200
ARGUMENTS = ["--disable-gpu", "--no-sandbox"]
MOST = 2.0
MOST_LATE = 3.0

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


# Frames while the body moves by itself.
MOVES = """async (seconds) => {
  const times = [];
  const began = performance.now();
  while (performance.now() - began < 1000 * seconds) {
    times.push(await new Promise(requestAnimationFrame));
  }
  const steps = times.slice(1).map((each, n) => each - times[n]).sort((a, b) => a - b);
  const rate = 1000 * steps.length / (times.at(-1) - times[0]);
  return { rate, late: steps[Math.floor(0.95 * steps.length)] };
}"""
TASK, MAIN = "RunTask", "CrRendererMain"
LONG = 50.0  # ms
TURNS = 240
# Of each screen what its answer stands in.
FIRST = {
    "": ".questions", "slide": ".headline b", "sweep": "main .big b", "block": ".headline b",
    "gear": ".headline .verdict", "size": "main .big b", "flanks": ".headline b",
    "drive": ".headline b", "rig": "main .big b", "thesis": "main .big b",
}  # fmt: skip


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
            report["change, painted"] = painted(page, chromium)
            report["motion"] = motion(page, chromium)
            report["opened"] = opened(page, chromium)
            report["opened, nothing compiled"] = opened_fresh(chromium)
            report["walks"] = walks(page, chromium)
        worker = page.child("worker")
        report["memory"] = {
            "server, MB": memory(page.process.pid),
            "worker, MB": memory(worker),
            "lookup, MB": memory(page.child("lookup")),
        }
    finally:
        page.close()
    report["load"] = dict(zip(("1 min", "5 min", "15 min"), os.getloadavg(), strict=True))
    # As a multiple of a round trip that brings nothing.
    most = {"seconds to the first page": 1.0, "processor, ms": 15.0, "kB": 16.0,
            "median over empty": MOST, "95th over empty": MOST_LATE, "server, MB": 80.0,
            "worker, MB": 300.0, "frame over 20 ms": 1.0,
            "longest task, processor ms": LONG, "slowest screen, s": 1.0,
            "slowest screen, nothing compiled, s": 3.0,
            "clicks to a report": 4, "clicks to the best way": 3, "clicks to a law": 5,
            "clicks to a report as a file": 4, "clicks to the best way as a file": 4,
            "clicks to a law as a file": 5, "seconds to a report as a file": 30.0,
            "seconds to the best way as a file": 15.0,
            "seconds to a law as a file": 120.0}  # fmt: skip
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


def processor_time(pid):
    """Return the processor time a process has taken, s."""
    fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def address(page):
    """Return where the body stands."""
    query = f"case=table-4.3&set.solve.method=periodic&token={page.token}"
    return f"{origin(page)}/#/slide?{query}"


def origin(page):
    """Return where it is served."""
    return f"http://127.0.0.1:{page.port}"


def motion(page, chromium):
    """Return how often the body is drawn by software, and what of its dragging takes long."""
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=chromium, args=ARGUMENTS)
        try:
            shown = browser.new_page(viewport={"width": 1400, "height": 900})
            shown.goto(address(page))
            shown.wait_for_selector("[data-key=ratio]")
            shown.wait_for_timeout(1500)
            moving = shown.evaluate(MOVES, 4)
            grip = shown.locator(".stage .grip").bounding_box()
            middle = shown.locator(".stage .bound").bounding_box()
            x, y = middle["x"] + middle["width"] / 2, middle["y"] + middle["height"] / 2
            radius = abs(grip["x"] + grip["width"] / 2 - x)
            browser.start_tracing(page=shown, categories=["toplevel"])
            shown.mouse.move(x - radius, y)
            shown.mouse.down()
            for turn in range(TURNS):
                angle = math.pi * turn / TURNS
                shown.mouse.move(x - radius * math.cos(angle), y - radius * math.sin(angle))
                shown.wait_for_timeout(16)
            shown.mouse.up()
            shown.wait_for_timeout(300)
            events = json.loads(browser.stop_tracing())["traceEvents"]
        finally:
            browser.close()
    return {
        "frames a second": moving["rate"],
        # At 50 a second it is one.
        "frame over 20 ms": 50.0 / moving["rate"],
        "95th of a frame, ms": moving["late"],
        "longest task, processor ms": max(processor for processor, _ in tasks(events)),
        "tasks over 50 ms, others' time in them": sum(wall > LONG for _, wall in tasks(events)),
    }


def tasks(events):
    """Return how much of the processor each task of the main thread took, and how long, ms."""
    named = [one for one in events if one.get("name") == "thread_name"]
    mains = {(one["pid"], one["tid"]) for one in named if one["args"]["name"] == MAIN}
    return [
        (one["tdur"] / 1e3, one["dur"] / 1e3)
        for one in events
        if one.get("name", "").endswith(TASK)
        and "tdur" in one
        and (one["pid"], one["tid"]) in mains
    ]


def opened(page, chromium, name="slowest screen, s", times=3):
    """Return how soon each screen stands with its answer, in new tabs; of several the soonest.

    What the browser and the server take of the processor meanwhile is what it takes where nothing
    else runs, or more: they share two cores.
    """
    from playwright.sync_api import sync_playwright

    found, spent = {}, {}
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=chromium, args=ARGUMENTS)
        try:
            # Of the same server, with nothing in it.
            where = {"empty": (f"{origin(page)}/icon.svg", "svg")}
            for screen, answer in FIRST.items():
                where[screen or "home"] = f"{origin(page)}/#/{screen}?token={page.token}", answer
            for screen, (address, answer) in where.items():
                each = [_opened(browser, page, address, answer) for _ in range(times)]
                found[screen], spent[screen] = map(min, zip(*each, strict=True))
        finally:
            browser.close()
    slowest = max(found.values())
    return {
        **found,
        **{f"{screen}, processor s": seconds for screen, seconds in spent.items()},
        name: slowest,
        "slowest over empty": slowest / found["empty"],
        f"{name} of the processor": max(spent.values()),
    }


def _opened(browser, page, where, answer):
    context = browser.new_context(viewport={"width": 1400, "height": 900})
    shown = context.new_page()
    before, began = _spent(page), time.perf_counter()
    shown.goto(where)
    shown.wait_for_selector(answer, timeout=300_000)
    seconds, after = time.perf_counter() - began, _spent(page)
    context.close()
    return seconds, sum(after[pid] - before.get(pid, 0.0) for pid in after)


def _spent(page):
    """Return the processor's time of the browser's processes and of the server's, by process."""
    found = {}
    for pid in {*descendants(os.getpid()), page.process.pid, *descendants(page.process.pid)}:
        with contextlib.suppress(OSError):
            found[pid] = processor_time(pid)
    return found


def opened_fresh(chromium):
    """Return the same of a page whose kernels are yet to be compiled."""
    with tempfile.TemporaryDirectory() as cache:
        page = Served(
            tempfile.mkdtemp(), dict(os.environ) | {"ASPERITY_CACHE": cache}, "--port", "0"
        )
        try:
            return opened(page, chromium, "slowest screen, nothing compiled, s", times=1)
        finally:
            page.close()


def walks(page, chromium):
    """Return what it takes from the first page to an answer, in clicks and seconds."""
    from playwright.sync_api import sync_playwright

    found = {}
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=chromium, args=ARGUMENTS)
        try:
            for name, go in (("a report", lambda walk: to_a_report(walk, Path(folder))),
                             ("the best way", to_the_best_way), ("a law", to_a_law)):  # fmt: skip
                context = browser.new_context(viewport={"width": 1400, "height": 900})
                context.add_init_script(TELL_REST)
                walk = Walk(context.new_page())
                began = time.perf_counter()
                walk.page.goto(f"{origin(page)}/#/?token={page.token}")
                go(walk)
                found[f"seconds to {name}"] = time.perf_counter() - began
                found[f"clicks to {name}"] = walk.clicks
                to_a_shared_file(walk, Path(folder))
                found[f"seconds to {name} as a file"] = time.perf_counter() - began
                found[f"clicks to {name} as a file"] = walk.clicks
                context.close()
        finally:
            browser.close()
    return found


def painted(page, chromium):
    """Return what a change takes until it is painted."""
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=chromium, args=ARGUMENTS)
        try:
            shown = browser.new_page()
            shown.goto(address(page))
            shown.wait_for_selector("[data-key=ratio]")
            shown.wait_for_selector("#slide-vibration-direction")
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
