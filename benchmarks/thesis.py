"""How long the figures and the claim of chapter 5 take, most of what ``asperity thesis`` does.

Run it with ``make bench``. They are made into a folder that holds nothing yet, with no block kept
from before, on one core; kernels not yet compiled are compiled on the way.
"""

import os
import tempfile
import time
from pathlib import Path

from _common import finish, on_one_core

from asperity.files.folders import cache_folder
from asperity.thesis import contents
from asperity.thesis.reproduce.run import run

CHAPTER = "5"
MOST = {"chapter_s": 180.0}


def main():
    """Make all and print one line for each."""
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
