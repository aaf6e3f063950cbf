"""Nothing stands twice in the package but what is listed, each pair with its reason."""

import tomllib
from pathlib import Path

import pytest
from apparatus.repeated import lines_of, pairs, read, told

import asperity

LIST = Path(__file__).with_name("duplicates.toml")
SIX = "".join(f"    total_{n} = force_{n} * way_{n} + {n}.5\n" for n in range(6))


def module(body, name="found"):
    return lines_of(f'def {name}():\n    """Say what is found."""\n{body}')


def kinds(**files):
    return [(pair.literal, *pair.files) for pair in pairs(files)]


def test_six_lines_to_the_letter_are_a_pair():
    assert kinds(one=module(SIX), two=module(SIX, "other")) == [(True, "one", "two")]


def test_six_lines_with_other_names_and_numbers_are_a_pair_of_shape():
    renamed = SIX.replace("force", "pull").replace(".5", ".25")
    assert kinds(one=module(SIX), two=module(renamed, "other")) == [(False, "one", "two")]


def test_five_lines_are_none():
    assert kinds(one=module(SIX[: SIX.rindex("    total")]), two=module(SIX, "other")) == []


def test_what_is_said_and_not_done_is_no_pair_of_shape():
    fields = "".join(f"    {name}: float = {n}.0 + 1.0\n" for n, name in enumerate("abcdef"))
    others = fields.replace("float", "int").replace(".0", ".5")
    classes = [lines_of(f"class {name}:\n{text}") for name, text in (("A", fields), ("B", others))]
    assert kinds(one=classes[0], two=classes[1]) == []


def test_comments_docstrings_and_imports_do_not_count():
    text = '"""' + "\n".join(f"Line {n} of it." for n in range(9)) + '"""\n'
    imports = "".join(f"import module_{n}\n" for n in range(9))
    comments = "".join(f"# comment {n}\n" for n in range(9))
    assert lines_of(text + imports + comments) == []


def test_a_longer_run_is_listed_once_with_its_lines():
    long = SIX + "    product = force_0 * force_1\n"
    (found,) = pairs({"one": module(long), "two": module("    way = 1\n" + long, "other")})
    assert (found.first, found.second) == (("one", 3, 9), ("two", 4, 10))


def test_a_phrase_that_stands_everywhere_is_none():
    files = {f"file_{n}": module(SIX, f"name_{n}") for n in range(9)}
    assert pairs(files) == []


@pytest.mark.slow
def test_what_stands_twice_in_the_package_is_listed_with_its_reason():
    listed = tomllib.loads(LIST.read_text("utf-8"))
    known = {(kind, *pair["files"]) for kind, rows in listed.items() for pair in rows}
    found = pairs(read(Path(asperity.__file__).parent))
    seen = {("literal" if pair.literal else "shape", *pair.files) for pair in found}
    new = [
        pair for pair in found if ("literal" if pair.literal else "shape", *pair.files) not in known
    ]
    assert not new, "\n".join(["merge it, or list it with its reason:", *told(new)])
    assert not known - seen, "listed, and no longer there"
    assert all(pair["why"] for rows in listed.values() for pair in rows)
