"""The list of mutants stays what it is while others edit the package, and each breaks one line."""

import ast
import json

import pytest
from mutants import near, run, sites

MODULE = '''
"""A module with 2.0 * 3 in its words."""

_MOST = 50


def half(x: "float | 1.0", y=0.5):
    """Return 0.5 * x."""
    if x < 0.0:
        raise ValueError(f"{x - 1} is too little by {2 * x}")
    return 0.5 * x + y**2


def last(rows, power=2.0):
    # The last - first.
    return rows[-1] - rows[0] if min(power, 3.0) else (rows[1] * power) / power
'''


def keys(source):
    return {mutant.key: mutant for mutant in sites.mutants_of("a.py", source)}


def test_each_mutant_changes_the_program_in_one_place():
    for mutant in keys(MODULE).values():
        broken = mutant.applied(MODULE)
        assert ast.dump(ast.parse(broken)) != ast.dump(ast.parse(MODULE)), mutant
        assert len(mutant.diff(MODULE).splitlines()) == 3, mutant


def test_every_kind_is_found_and_nothing_in_words_or_types():
    found = keys(MODULE).values()
    assert {mutant.kind for mutant in found} == set(sites.KINDS)
    changed = {(mutant.kind, mutant.text, mutant.broken) for mutant in found}
    assert changed >= {
        ("constant", "50", "25"),
        ("bound", "x < 0.0", "x > 0.0"),
        ("factor", "0.5", "0.55"),
        ("exponent", "2", "3"),
        ("index", "-1", "-2"),
        ("index", "0", "1"),
        ("sign", "rows[-1] - rows[0]", "+"),
        ("bound", "min(power, 3.0)", "max(power, 3.0)"),
    }
    assert not [mutant for mutant in found if "x - 1" in mutant.text or "2 * x" in mutant.text]
    assert not [mutant for mutant in found if mutant.line <= 4 and mutant.text != "50"]


def test_an_edit_elsewhere_leaves_what_is_chosen():
    edited = (
        MODULE.replace("_MOST = 50", "_MOST = 50\n\n\ndef other(a):\n    return a") + "\n# end\n"
    )
    assert keys(edited).keys() == keys(MODULE).keys()
    whole = list(keys(MODULE).values())
    before = sites.seeded(whole, 12)
    assert [m.key for m in sites.seeded(list(keys(edited).values()), 12)] == [m.key for m in before]
    without = [mutant for mutant in whole if mutant != before[0]]
    assert set(before[1:]) <= set(sites.seeded(without, 12))


def test_what_is_known_holds_while_the_line_is_what_it_was(tmp_path, monkeypatch):
    file, module = tmp_path / "results.jsonl", tmp_path / "asperity" / "a.py"
    module.parent.mkdir()
    monkeypatch.setattr(sites, "SOURCE", tmp_path)
    mutant = keys(MODULE)["a.py|half|exponent|2|0"]
    noted = {"key": mutant.key, "outcome": "caught", "diff": mutant.diff(MODULE)}
    file.write_text(json.dumps(noted) + "\n")
    for edited, holds in (
        (MODULE, True),
        (MODULE.replace("_MOST = 50", "_MOST = 60\n_LEAST = 1"), True),
        (MODULE.replace("x < 0.0", "x <= 0.0"), True),
        (MODULE.replace("return 0.5 * x + y**2", "return 0.6 * x + y**2"), False),
        (MODULE.replace("y**2", "y"), False),
    ):
        module.write_text(edited)
        assert bool(run.standing(list(keys(edited).values()), file)) is holds
    module.write_text(MODULE)
    assert run.share([mutant], file).startswith("1 of 1 caught, 100.0 %")


@pytest.mark.slow
def test_the_list_has_two_hundred_of_which_no_two_are_one():
    listed = sites.listed()
    assert len(listed) == sites.COUNT
    assert len({mutant.key for mutant in listed}) == len({m.name for m in listed}) == sites.COUNT
    kinds = [sum(mutant.kind == kind for mutant in listed) for kind in sites.KINDS]
    assert min(kinds) >= sites.COUNT // len(sites.KINDS) - 5


def test_those_that_are_always_tried_stand_where_they_stood():
    wanted = [entry["key"] for entry in sites.known()["always"]]
    found = [mutant.key for mutant in sites.always()]
    assert found == wanted, "a line was rewritten: name it anew in tests/mutants/known.toml"


def test_every_equivalent_has_its_reason():
    entries = sites.known()["equivalent"]
    assert len({entry["key"] for entry in entries}) == len(entries)
    assert all(len(entry["why"].split()) >= 4 for entry in entries)


@pytest.mark.slow
def test_each_mutant_of_the_list_has_tests_near_it():
    for mutant in sites.listed():
        tests = near.nearest(mutant)
        assert tests, mutant.key
        assert all((near.ROOT / test.partition("::")[0]).exists() for test in tests), mutant.key


@pytest.mark.slow
def test_a_copy_that_is_not_broken_passes_and_one_that_is_fails(tmp_path):
    copy = run.Copy(tmp_path)
    mutant = next(m for m in sites.always() if m.text == "50.0")
    whole = copy.text(mutant.module)
    tests = [
        "tests/unit/test_of_nothing.py",
        "tests/literature/test_iso14521.py::test_of_nothing",
        "tests/literature/test_iso14521.py",
    ]
    with copy.broken(mutant):
        assert (copy.package / mutant.module).read_text("utf-8") != whole
        assert copy.fails(tests).startswith("tests/literature/test_iso14521.py::")
    assert (copy.package / mutant.module).read_text("utf-8") == whole
    assert copy.fails(tests) == ""
    copy.close()


def test_dear_tests_of_a_line_come_behind_cheap_ones_and_whole_files_behind_both(monkeypatch):
    seconds = {"f.py::near": 0.3, "f.py::dear": 9.0, "f.py::far": 0.01, "f.py::dearest": 30.0}
    tests = ["f.py", "f.py::dearest", "f.py::dear", "f.py::near", "f.py::far", "untimed.py"]
    kept = {"tests": list(seconds), "seconds": list(seconds.values()), "near": {"m.py:f": []}}
    monkeypatch.setattr(near, "_kept", lambda: kept)
    near._seconds.cache_clear()
    ordered = sorted(tests, key=near._dearness)
    near._seconds.cache_clear()
    assert ordered[:2] == ["f.py::near", "f.py::far"]
    assert ordered[2:] == ["f.py::dear", "untimed.py", "f.py::dearest", "f.py"]
