"""How long the figures of elastic blocks take that ``asperity thesis`` draws on a light mesh.

Run it with ``make bench``. Drawn are the figures of chapter 5 into a folder that holds nothing yet,
on one core; kernels not yet compiled are compiled on the way.
"""

import tempfile
import time

from _common import finish, on_one_core

from asperity.thesis import contents
from asperity.thesis.reproduce.run import run

CHAPTER = "5."
MOST = {"chapter_s": 180.0}


def main():
    """Draw all and print one line a figure."""
    on_one_core()
    figures = {}
    with tempfile.TemporaryDirectory() as folder:
        began = time.process_time()
        for number in contents.FIGURES:
            if number.startswith(CHAPTER):
                before = time.process_time()
                run(folder, [number])
                figures[f"figure_{number}_s"] = time.process_time() - before
        figures["chapter_s"] = time.process_time() - began
    finish({"chapter 5": figures}, most=MOST)


if __name__ == "__main__":
    main()
