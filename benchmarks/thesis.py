"""How long the figures and the claim of chapter 5 take, most of what ``asperity thesis`` does.

Run it with ``make bench``. They are made into a folder that holds nothing yet, with no block kept
from before, on one core; kernels not yet compiled are compiled on the way.

With ``--whole`` it is all of it and by the clock, on all cores: the first run of a user, whose
cache is empty, and when its page is there; one with another folder to write to; and one that finds
everything done. It ends with 1 where one of them takes longer than is promised.
"""

import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from _common import finish, on_one_core

from asperity.files.folders import cache_folder
from asperity.thesis import contents
from asperity.thesis.reproduce.run import run

CHAPTER = "5"
MOST = {
    "chapter_s": 180.0,
    "page_s": 20.0,
    "first_s": 180.0,
    "kernels_kept_s": 60.0,
    "unchanged_s": 2.0,
}
LOOK = 0.05  # s between looks for the page


def whole():
    """Run ``asperity thesis`` three times and print how long each took."""
    seconds = {}
    with tempfile.TemporaryDirectory() as folder:
        # Compiled modules are kept, as ``make run`` does.
        kept = {"ASPERITY_CACHE": f"{folder}/cache", "PYTHONDONTWRITEBYTECODE": ""}
        environment = {**os.environ, **kept}
        for name, out in (("first_s", "a"), ("kernels_kept_s", "b"), ("unchanged_s", "b")):
            words = [sys.executable, "-m", "asperity", "thesis", "--out", f"{folder}/{out}"]
            page = Path(folder, out, "index.html")
            is_new = not page.exists()
            began = time.perf_counter()
            quiet = subprocess.DEVNULL
            running = subprocess.Popen(words, stdout=quiet, stderr=quiet, env=environment)
            while is_new and not page.exists() and running.poll() is None:
                time.sleep(LOOK)
            seconds.setdefault("page_s", time.perf_counter() - began)
            if running.wait():
                raise subprocess.CalledProcessError(running.returncode, words)
            seconds[name] = time.perf_counter() - began
    finish({"all": seconds}, held={name: MOST[name] for name in seconds})


def main():
    """Make all and print one line for each."""
    if "--whole" in sys.argv:
        whole()
    on_one_core()
    seconds = {}
    kernels = cache_folder("kernels")
    with tempfile.TemporaryDirectory() as folder:
        cache = Path(folder, "asperity")
        cache.mkdir()
        if kernels is not None:
            (cache / "kernels").symlink_to(kernels)
        os.environ["ASPERITY_CACHE"] = folder
        began = time.process_time()
        for exhibit in contents.everything():
            if contents.chapter_of(exhibit.number) == CHAPTER:
                before = time.process_time()
                run(folder, [exhibit.number], processes=1)
                name = exhibit.name.replace(" ", "_")
                seconds[f"{name}_s"] = time.process_time() - before
        seconds["chapter_s"] = time.process_time() - began
    finish({"chapter 5": seconds}, most=MOST)


if __name__ == "__main__":
    main()
