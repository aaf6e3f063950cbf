"""The language that people are shown: English, or another through one catalogue of sentences.

Every sentence is made in English, with its numbers in it. What is shown is looked up as it is
shown, in a catalogue that has a line a sentence: its English words, with a hole where a number, a
name or another text stands, and the words of the other language with the same holes. A language is
a file (``languages/de.toml``; a reader's own by its path). What has no line stays English.
"""

import contextlib
import contextvars
import functools
import itertools
import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import NamedTuple

from asperity.errors import InputError, one_of, plain, shown
from asperity.files.store import read_toml
from asperity.results.words import Number, Sentence

ENGLISH = "en"
_FOLDER = Path(__file__).with_name("languages")
_HOLE = re.compile(r"\{([A-Za-z_]\w*)\}")
_WORD = re.compile(r"(?<![\w.])(?:[a-z][a-z-]{2,}|[A-Z][a-z]{3,})(?![\w(=]|\.\w)")
# Short words and loud ones, which may be symbols and units where others are.
_SHORT_WORD = re.compile(r"(?<![\w.])(?:as|at|by|if|is|it|no|of|on|or|to|FAILS)(?![\w(=]|\.\w)")
# What parts the cases of an equation.
_CASES = re.compile(r"(?<= )(?:if|else)(?= )")
_OF_FORMULAS = frozenset(("else", "for", "rho", "psi", "tau"))
# Numbers of a sentence keep their digits and keys: signs of no language stand for them meanwhile.
_FIRST = 0xE000
_MARK = re.compile("[\ue000-\uf8ff]")
_THOUSANDS = re.compile(r"(?<=\d),(?=\d{3}(?!\d))")
# What a row of texts is joined by, where the row itself has no line.
_SHORT = len("_n")
_MOST_PIECES = 16
_BETWEEN = (". ", ": ", ", ", " and ", " + ", " (")


class _Line(NamedTuple):
    """A sentence with holes: what finds it, what of it is longest, and what it becomes."""

    found: "re.Pattern[str]"
    longest: str
    holes: tuple[str, ...]
    said: str


class Catalogue:
    """The sentences of a language.

    Parameters
    ----------
    texts : mapping of str to str
        By the English, with holes such as ``{a}``.
    kept : iterable of str
        Words that stay as they are, such as names.
    code : str
        Of the language, as pages name it.
    """

    def __init__(
        self, texts: Mapping[str, str], kept: tuple[str, ...] = (), code: str = ""
    ) -> None:
        self.code = code
        self._kept = frozenset(kept)
        self._texts = {english: said for english, said in texts.items() if "{" not in english}
        holed = [pair for pair in texts.items() if "{" in pair[0]]
        # What says more of a sentence in words of its own is nearer to it.
        holed.sort(key=lambda pair: -len(_HOLE.sub("", pair[0])))
        self._lines = [_line(*pair) for pair in holed]
        self._known: dict[str, str | None] = {}
        self.missing: set[str] = set()

    def said(self, text: str) -> str:
        """Return a text in this language; what has no line is kept, and noted in ``missing``."""
        found = self._found(text)
        if found is None:
            self.missing.add(text)
            return text
        return _apart(found)

    def of_case(self, word: "re.Match[str]") -> str:
        """Return "if" or "else" of an equation in this language, where it has a line."""
        return self._texts.get(word[0], word[0])

    def _found(self, text: str) -> str | None:
        if text not in self._known:
            self._known[text] = self._looked_up(text)
        return self._known[text]

    def _looked_up(self, text: str) -> str | None:
        if text in self._texts:
            return self._texts[text]
        bare = text.strip()
        if bare != text:
            inner = self._found(bare)
            return None if inner is None else text.replace(bare, inner)
        if text in self._kept:
            return text
        if not _WORD.search(text):
            # Of short words alone, as "of" and "at", only whole lines tell.
            short = _SHORT_WORD.search(text)
            return self._by_line(text, whole=True) or (None if short else text)
        small = text[0].lower() + text[1:]
        if small in self._texts:
            begun = self._texts[small]
            return begun[0].upper() + begun[1:]
        # A line is of one sentence of a row rather than of the whole row.
        return (
            self._by_line(text, whole=True)
            or self._in_row(text, "; ")
            or self._by_line(text, whole=False)
            or self._in_parts(text)
        )

    def _by_line(self, text: str, *, whole: bool) -> str | None:
        """Return a text by a line with holes; where they are ``whole`` none of them has a row."""
        for line in self._lines:
            if line.longest in text and (found := line.found.fullmatch(text)):
                if not all(_is_whole(part) and not (whole and "; " in part)
                           for part in found.groups()):  # fmt: skip
                    continue
                parts = {name: self._in_hole(name, found[name]) for name in line.holes}
                if None not in parts.values():
                    return line.said.format(**parts)
        return None

    def _in_hole(self, name: str, text: str) -> str | None:
        """Return what stands in a hole: in ``_name`` any text, in ``_n`` one without words."""
        if not name.startswith("_"):
            return self._found(text)
        if "; " in text or (len(name) == _SHORT and _WORD.search(text)):
            return None
        return text

    def _in_parts(self, text: str) -> str | None:
        """Return texts in a row, each by its own line."""
        if text.endswith(".") and (found := self._found(text[:-1])) is not None:
            return f"{found}."
        rows = (self._in_row(text, between) for between in _BETWEEN)
        return next((row for row in rows if row is not None), None)

    def _in_row(self, text: str, between: str) -> str | None:
        if between not in text or not (parts := self._row(text.split(between), between)):
            return None
        joint = self._texts.get(between.strip(), between.strip())
        return between.replace(between.strip(), joint).join(parts)

    def _row(self, pieces: list[str], between: str) -> list[str]:
        """Return the texts that pieces are of, as few pieces to each as have a line; or none."""
        if len(pieces) > _MOST_PIECES:
            return []
        for count in range(1, len(pieces)):
            first = self._found(between.join(pieces[:count]))
            if first is None:
                continue
            rest = pieces[count:]
            if len(rest) > 1 and (others := self._row(rest, between)):
                return [first, *others]
            if (last := self._found(between.join(rest))) is not None:
                return [first, last]
        return []


def _apart(text: str) -> str:
    """Return a text whose thousands stand apart: a comma between them is of English."""
    return _THOUSANDS.sub("\N{NARROW NO-BREAK SPACE}", text)


def _is_whole(text: str) -> bool:
    """Return whether what stands in a hole may be one: it has both of each pair of brackets."""
    depth = 0
    for sign in text:
        depth += (sign == "(") - (sign == ")")
        if depth < 0:
            return False
    return depth == 0


def _line(english: str, said: str) -> _Line:
    pieces = _HOLE.split(english)
    holes = tuple(pieces[1::2])
    pattern = "".join(
        re.escape(piece)
        if place % 2 == 0
        else f"(?P<{piece}>.*?)"
        if piece.startswith("_")
        else f"(?P<{piece}>.+?)"
        for place, piece in enumerate(pieces)
    )
    return _Line(re.compile(pattern, re.DOTALL), max(pieces[::2], key=len), holes, said)


def has_words(equation: str) -> bool:
    """Return whether an equation has words that are of a language, besides those of formulas."""
    return any(word not in _OF_FORMULAS for word in _WORD.findall(equation)) or (
        _SHORT_WORD.search(equation.replace("if ", "")) is not None
    )


def said_equation(equation: str) -> str:
    """Return an equation in the language that is spoken: its sentence, or its "if" and "else"."""
    if has_words(equation):
        return said(equation)
    catalogue = _language.get()
    return equation if catalogue is None else _CASES.sub(catalogue.of_case, equation)


class Spoken(str):
    """A text that is in its language already."""


_language: contextvars.ContextVar[Catalogue | None] = contextvars.ContextVar(
    "language", default=None
)


def languages() -> tuple[str, ...]:
    """Return the languages that there are."""
    return ENGLISH, *sorted(path.stem for path in _FOLDER.glob("*.toml"))


def catalogue_of(language: str) -> Catalogue | None:
    """Return the catalogue of a language by its name or by a file's path; None for English.

    Raises
    ------
    InputError
        There is no such language, or its file cannot be read or is no catalogue.
    """
    if language in ("", ENGLISH):
        return None
    path = Path(language)
    if path.suffix != ".toml":
        if language not in languages():
            raise InputError(
                f"language {plain(shown(language))}: {one_of(languages(), language)}, or a file of "
                "sentences that ends in .toml"
            )
        path = _FOLDER / f"{language}.toml"
    return _read(path)


@functools.cache
def _read(path: Path) -> Catalogue:
    name = f"language {plain(shown(str(path)))}"
    found = read_toml(path, name)
    texts, kept, code = found.get("texts"), found.get("kept", []), found.get("code", path.stem)
    if not isinstance(texts, dict) or not all(isinstance(said, str) for said in texts.values()):
        raise InputError(f'{name} has no table [texts] of lines "English words" = "other words"')
    if not isinstance(kept, list) or not all(isinstance(word, str) for word in kept):
        raise InputError(f"{name}: kept is {shown(kept)}; it must be a list of words that stay")
    for english, said in texts.items():
        holes = _HOLE.findall(english)
        if sorted(set(_HOLE.findall(said))) != sorted(holes):
            raise InputError(
                f"{name}: {shown(english)} must have each of its holes once, and {shown(said)} the "
                "same ones"
            )
        if any(brace in _HOLE.sub("", each) for each in (english, said) for brace in "{}"):
            raise InputError(
                f"{name}: {shown(english)} has a brace that belongs to no hole; a hole is a name "
                "in braces, such as {a} or {_name}"
            )
    return Catalogue(texts, tuple(kept), str(code))


@contextlib.contextmanager
def spoken(language: "Catalogue | None") -> Iterator[None]:
    """Show what is shown within the block in a language; None: in English."""
    token = _language.set(language)
    try:
        yield
    finally:
        _language.reset(token)


def language() -> str:
    """Return the code of the language that people are shown."""
    own = _language.get()
    return ENGLISH if own is None else own.code


def said(text: str) -> str:
    """Return a text in the language that people are shown, its numbers as they are.

    Examples
    --------
    >>> with spoken(Catalogue({"{a} of the {b} asked": "{a} von den verlangten {b}"})):
    ...     said(Sentence(Number.of(1.53, ".3g", "S"), " of the 1.1 asked"))
    '1.53 von den verlangten 1.1'
    """
    own = _language.get()
    if own is None or isinstance(text, Number | Spoken):
        return text
    if not isinstance(text, Sentence):
        return own.said(text)
    numbers = [
        Number(_apart(part), part.value, part.key, part.times)
        for part in text.parts
        if isinstance(part, Number)
    ]
    signs = map(chr, itertools.count(_FIRST))
    marked = "".join(next(signs) if isinstance(part, Number) else part for part in text.parts)
    found = own.said(marked)
    if found == marked:
        return text
    pieces = _MARK.split(found)
    placed = [numbers[ord(sign) - _FIRST] for sign in _MARK.findall(found)]
    return Sentence(
        *(piece for pair in itertools.zip_longest(pieces, placed, fillvalue="") for piece in pair)
    )
