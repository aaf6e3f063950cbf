"""Make the excerpt of the thesis that the quotations of the ledger are tested against.

``python tests/excerpt.py TEXT`` looks up each quotation of ``thesis/said.toml`` in the text of the
thesis as a machine read it, and writes the words that stand there, uncorrected, with a hash of
their line, into ``tests/literature/thesis-excerpt.toml``. What is not found is said. Nothing else
of the text goes into the project.
"""

import hashlib
import json
import sys
from pathlib import Path

from apparatus.thesis_words import plain

from asperity.files.store import write_text
from asperity.thesis.contents import CLAIMS
from asperity.thesis.said import said_of, slips

EXCERPT = Path(__file__).with_name("literature") / "thesis-excerpt.toml"
_HEAD = """\
# The thesis as the machine read it: the words that the ledger quotes, uncorrected, with lines,
# and the first digits of a SHA-256 of each whole line, for whoever has the text; tests/excerpt.py.
"""


def mended(line: int, text: str) -> str:
    """Return a text of a line with its letters mended."""
    for slip in slips():
        if slip.line == line and not slip.why:
            text = text.replace(slip.has, slip.should)
    return text


def found(line: int, words: str, text: str) -> str:
    """Return the shortest stretch of a line that holds some words, as it stands there."""
    wanted = plain(words)
    low, high = 0, len(text)
    while low < high and wanted in plain(mended(line, text[low + 1 : high])):
        low += 1
    while high > low and wanted in plain(mended(line, text[low : high - 1])):
        high -= 1
    return text[low:high]


def main(path: Path) -> int:
    """Write the excerpt; returns how many quotations were not found."""
    lines = path.read_text("utf-8").split("\n")
    entries, missing = set(), 0
    for number in CLAIMS:
        for line, words in said_of(number).said:
            text = lines[line - 1]
            if plain(words) not in plain(mended(line, text)):
                print(f"claim {number}: not in line {line}: {words}")
                missing += 1
                continue
            digest = hashlib.sha256(text.encode()).hexdigest()[:16]
            entries.add((line, found(line, words, text), digest))
    told = "".join(
        f"\n[[line]]\nnumber = {line}\ntext = {json.dumps(text, ensure_ascii=False)}\n"
        f'whole = "{digest}"\n'
        for line, text, digest in sorted(entries)
    )
    write_text(EXCERPT, _HEAD + told)
    return missing


if __name__ == "__main__":
    sys.exit(1 if main(Path(sys.argv[1])) else 0)
