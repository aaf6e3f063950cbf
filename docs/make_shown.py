"""Make the answers that ship with the page: what its screens show before anything is asked.

``python docs/make_shown.py [SCREEN ...]`` asks for each as a reader would, in chromium before a
server of its own, and keeps what the page then takes: the answer, its variables, its geometry.
"""

import json
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from urllib.parse import parse_qs, urlsplit

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT / "tests"))
SHOWN = ROOT / "src/asperity/web/static/shown"

# Of each screen the buttons that begin a job, and in which slot of the screen that stands.
SCREENS = {
    "flanks": {"cut the wheel": ""},
    "block": {"settle": "-settled", "march": "-march"},
    "sweep": {"solve the grid": ""},
    "size": {"find the most efficient designs": ""},
    "drive": {"shake it": "", "load it": "-static", "try each way": "", "take the motor off": ""},
}
PATIENCE = 1_800_000  # ms


def made(served, page, label):
    """Begin a job and wait for it; returns what was asked and the job's own folder."""
    from playwright.sync_api import expect

    with page.expect_response(lambda one: one.url.endswith("/api/jobs"), timeout=PATIENCE) as told:
        page.get_by_role("button", name=label, exact=True).click()
    asked, job = json.loads(told.value.request.post_data), told.value.json()
    box = page.locator(".work", has=page.get_by_role("button", name=label, exact=True))
    expect(box.get_by_role("status")).to_contain_text("done", timeout=PATIENCE)
    return asked, job["id"]


def keep(served, at, asked, identity, slot):
    """Write what the page takes of a job; returns its line of the list."""
    folder = SHOWN / at
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    path = f"/api/jobs/{identity}"
    (folder / "answer.json").write_text(json.dumps(served.get(f"{path}/answer").json) + "\n")
    files = served.get(path).json["files"]
    listed = served.get(f"{path}/data")
    if listed.status == 200 and asked["command"] not in WITHOUT:
        names = NAMES.get(at, [*listed.json])
        data = served.get(f"{path}/data?names={','.join(names)}").json
        (folder / "data.json").write_text(json.dumps(data) + "\n")
    kept = [name for name in files if name in ("flanks.bin", "frames.bin")]
    for name in kept:
        (folder / name).write_bytes(served.get(f"{path}/files/{name}").body)
    return {"asked": asked, "slot": slot, "at": at, "files": kept}


# Of these the answer alone is drawn.
WITHOUT = ("flank", "optimise", "rig reduce")
# Variables that the screens draw, of files that hold many more.
NAMES = {
    "drive-static": [
        *("phase", "tooth_force", "load", "pattern", "node_radius", "node_face", "faces"),
    ],
    "drive": ["torque_ratio"],
    "directions": ["torque_ratio"],
    "locking": ["amplitude", "creep_over", "creep_limit"],
    "block-settled": ["friction", "slider_friction"],
    "fit": ["measured", "deviation", "predicted"],
    "block-march": ["pressure", "faces", "node_x", "node_y", "drive_force"],
}


RUN = "simulated-run.nc"


def rig(served, seen):
    """Record on the simulated rig, reduce that and fit a law; yields the lines of the list."""
    page = seen.open("rig")
    page.get_by_role("button", name="record one on the simulated rig").click()
    page.wait_for_url(lambda at: "rec=" in at, timeout=PATIENCE)
    recorded = parse_qs(urlsplit(page.url).fragment.partition("?")[2])["rec"][0]
    _, identity, file = recorded.split("/")
    body = served.get(f"/api/jobs/{identity}/files/{file}").body
    (served.folder / RUN).write_bytes(body)
    with page.expect_response(lambda one: one.url.endswith("/do/signals")) as told:
        seen.open("rig", case="disc-on-disc", rec=RUN)
    signals = told.value.json()
    asked, identity = made(served, page, "reduce")
    line = keep(served, "rig-reduce", asked, identity, "")
    (SHOWN / "rig-reduce/signals.json").write_text(json.dumps(signals) + "\n")
    # The recording is large, and made again by what it was made by.
    recorded = served.get(f"/api/jobs/{recorded.split('/')[1]}").json["line"]
    yield line | {"files": ["signals.json"], "of": recorded}
    measured = served.get(f"/api/jobs/{identity}/files/measurements.csv").body
    asked, identity = made(served, page, "fit")
    line = keep(served, "fit", asked, identity, "")
    (SHOWN / "fit/measurements.csv").write_bytes(measured)
    yield line | {"files": ["measurements.csv"]}


def thesis(served, seen):
    """Make the thesis's claims and figures; yields the line of the list."""
    folder = served.folder / "out/thesis"
    command = [sys.executable, "-m", "asperity", "thesis", "--out", str(folder)]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    ledger = served.get("/api/thesis").json
    # Its pictures are many, and drawn where it is made.
    unmade = {"kept": False, "picture": "", "how": []}
    kept = {"folder": "", "figures": [one | unmade for one in ledger["figures"]]}
    told = {
        "answer": ledger | kept,
        "entries": [],
        "notes": [],
        "command": "asperity thesis ",
        "toml": "",
    }
    (SHOWN / "thesis").mkdir(exist_ok=True)
    (SHOWN / "thesis/answer.json").write_text(json.dumps(told, ensure_ascii=False) + "\n")
    yield {
        "asked": {"command": "thesis", "case": "", "settings": {}},
        "slot": "",
        "at": "thesis",
        "files": [],
    }


def jobs_of(served, seen, screen):
    """Begin the jobs of a screen one after the other; yields the lines of the list."""
    page = seen.open(screen)
    for label, slot in SCREENS[screen].items():
        asked, identity = made(served, page, label)
        yield keep(served, asked["command"].replace(" ", "-") + slot, asked, identity, slot)


OPENS = {"slide": ("slide", "curve"), "gear": ("rate",), "size": ("size",), "drive": ("rate",)}
"""What a screen asks as it opens, of what computes."""


def live(served, seen):
    """Keep what is answered as screens open: a fresh machine compiles for a minute first."""
    folder = SHOWN / "live"
    folder.mkdir(exist_ok=True)
    lines = []
    for screen, verbs in OPENS.items():
        told = {}

        def heard(response, told=told):
            verb = response.url.rpartition("/do/")[2]
            if verb != response.url and response.status == 200:
                told[verb] = json.loads(response.request.post_data), response.text()

        seen.page.on("response", heard)
        page = seen.open(screen)
        page.wait_for_timeout(5000)
        seen.page.remove_listener("response", heard)
        for verb in verbs:
            body, answer = told[verb]
            name = verb if screen in (verb, "gear") else f"{screen}-{verb}"
            (folder / f"{name}.json").write_text(answer + "\n")
            lines.append({"verb": verb, "body": body, "at": f"{name}.json"})
    (folder / "index.json").write_text(json.dumps(lines, indent=1, ensure_ascii=False) + "\n")
    return ()


OTHERS = {"rig": rig, "thesis": thesis, "live": live}


def main(names):
    """Make those of the screens that are named, or of all."""
    import os

    from apparatus.browser import Seen
    from apparatus.page import Served
    from playwright.sync_api import sync_playwright

    listing = SHOWN / "index.json"
    lines = json.loads(listing.read_text()) if listing.exists() else []
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        served = Served(Path(folder), dict(os.environ), "--port", "0")
        browser = playwright.chromium.launch(
            executable_path=shutil.which("chromium"), args=["--disable-gpu", "--no-sandbox"]
        )
        try:
            seen = Seen(browser, served)
            for screen in names or [*SCREENS, *OTHERS]:
                own = OTHERS.get(screen)
                for line in own(served, seen) if own else jobs_of(served, seen, screen):
                    lines = [one for one in lines if one["at"] != line["at"]] + [line]
                    listing.write_text(json.dumps(lines, indent=1) + "\n")
                    print(line["at"], flush=True)
        finally:
            browser.close()
            served.close()


if __name__ == "__main__":
    main(sys.argv[1:])
