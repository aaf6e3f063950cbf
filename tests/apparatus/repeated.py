"""Runs of lines of the package that stand twice: to the letter, or alike but for names and numbers.

``python tests/apparatus/repeated.py`` prints them with their lines. What counts are lines of code:
no docstrings, comments, imports, blank lines, nor lines of punctuation and keywords alone. For a
shape a line counts that has three names or values: fields, lists of names and calls by keyword are
alike everywhere.
"""

import ast
import io
import itertools
import keyword
import tokenize
from collections import defaultdict
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import NamedTuple

RUN = 6
"""Lines that make a run."""
TELLING = 3
"""Names and values in a line whose shape counts."""
COMMON = 8
"""Places above which a run is a common phrase and none of its pairs is listed."""


class Line(NamedTuple):
    """A line of code: its number, its text, and its shape, the text without names and values."""

    number: int
    text: str
    shape: str
    telling: bool


class Pair(NamedTuple):
    """Two places that share lines, each as (file, first line, last line)."""

    literal: bool
    first: tuple[str, int, int]
    second: tuple[str, int, int]

    @property
    def files(self) -> tuple[str, str]:
        """Both files, in their order."""
        return self.first[0], self.second[0]


def lines_of(text: str) -> list[Line]:
    """Return the lines of a module that count."""
    left_out = {n for node in _no_code(ast.parse(text)) for n in range(node[0], node[1] + 1)}
    parts: dict[int, list[tokenize.TokenInfo]] = defaultdict(list)
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        if token.type in (tokenize.NAME, tokenize.NUMBER, tokenize.STRING, tokenize.OP):
            parts[token.start[0]].append(token)
    return [
        Line(
            number,
            " ".join(t.string for t in tokens),
            " ".join(map(_shape, tokens)),
            sum(not _thin(t) for t in tokens) >= TELLING,
        )
        for number, tokens in sorted(parts.items())
        if number not in left_out and not all(map(_thin, tokens))
    ]


def _no_code(tree: ast.Module) -> Iterator[tuple[int, int]]:
    for node in ast.walk(tree):
        alone = node.value if isinstance(node, ast.Expr) else None
        text = isinstance(alone, ast.Constant) and isinstance(alone.value, str)
        if text or isinstance(node, ast.Import | ast.ImportFrom):
            yield node.lineno, node.end_lineno or node.lineno


def _thin(token: tokenize.TokenInfo) -> bool:
    return token.type == tokenize.OP or keyword.iskeyword(token.string)


def _shape(token: tokenize.TokenInfo) -> str:
    return token.string if _thin(token) else tokenize.tok_name[token.type]


def pairs(files: dict[str, list[Line]], run: int = RUN, common: int = COMMON) -> list[Pair]:
    """Return all pairs of places that share at least ``run`` lines, the longest of each."""
    return [
        Pair(literal, first, second)
        for literal in (True, False)
        for first, second in _shared(files, literal, run, common)
    ]


def _shared(
    files: dict[str, list[Line]], literal: bool, run: int, common: int
) -> Iterator[tuple[tuple[str, int, int], tuple[str, int, int]]]:
    if not literal:
        files = {file: [line for line in lines if line.telling] for file, lines in files.items()}
    windows: dict[tuple[str, ...], list[tuple[str, int]]] = defaultdict(list)
    said = {file: [x.text if literal else x.shape for x in lines] for file, lines in files.items()}
    for file, texts in said.items():
        for at in range(len(texts) - run + 1):
            windows[tuple(texts[at : at + run])].append((file, at))
    begun = set()
    for places in windows.values():
        if len(places) > common:
            continue
        for (file_a, a), (file_b, b) in itertools.combinations(sorted(places), 2):
            if file_a != file_b or b - a >= run:
                begun.add((file_a, a, file_b, b))
    for file_a, a, file_b, b in sorted(begun):
        if (file_a, a - 1, file_b, b - 1) in begun:
            continue
        last = 0
        while (file_a, a + last + 1, file_b, b + last + 1) in begun:
            last += 1
        here, there = files[file_a], files[file_b]
        stop = last + run - 1
        # To the letter it is listed once, as such.
        if literal or any(here[a + n].text != there[b + n].text for n in range(stop + 1)):
            yield (
                (file_a, here[a].number, here[a + stop].number),
                (file_b, there[b].number, there[b + stop].number),
            )


def read(package: Path) -> dict[str, list[Line]]:
    """Return the lines of every module of a package, by its path within."""
    return {
        path.relative_to(package).as_posix(): lines_of(path.read_text("utf-8"))
        for path in sorted(package.rglob("*.py"))
    }


def told(found: Iterable[Pair]) -> Iterator[str]:
    """Yield a line for each pair."""
    for pair in found:
        sides = " ~ ".join(f"{file}:{first}-{last}" for file, first, last in pair[1:])
        yield f"{'literal' if pair.literal else 'shape'} {sides}"


if __name__ == "__main__":
    import asperity

    print(*told(pairs(read(Path(asperity.__file__).parent))), sep="\n")
