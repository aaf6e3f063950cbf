"""What is kept of an entry has another name as soon as what it follows from is another, not before.

Names as another process finds them where a source is as if it were another.
"""

from pathlib import Path

import pytest

from asperity.kernels import closure
from asperity.kernels.native import keys
from asperity.kernels.native.entries import listed

ROOT = Path(closure.__file__).parents[2]
TANGENT = "asperity/friction/tangent.py"
MARCH = "asperity.slider.kernels.march_stretches"
STORED = "asperity.friction.springs.stored_in_springs"
GAP = "asperity.flanks.meshing.kernels.pattern.smallest_gap"


@pytest.fixture
def named(monkeypatch):
    """The name of an entry of each of some kernels."""

    def clear():
        for each in (keys._maker, keys.closure_digest):
            each.cache_clear()

    def named():
        clear()
        return {name: keys.key(listed().named(name)[0]) for name in (MARCH, STORED, GAP)}

    yield named
    monkeypatch.undo()
    clear()


@pytest.fixture
def change(monkeypatch):
    """Let one source hold something else."""

    def change(name):
        assert (ROOT / name).is_file()
        content = closure.Sources.content

        def other(self, path):
            held = content(self, path)
            return held + b"\n" if path.endswith(f"/{name}") else held

        monkeypatch.setattr(closure.Sources, "content", other)

    return change


def renamed(before, after):
    assert len(set(after.values())) == len(after)
    return {name for name in before if before[name] != after[name]}


@pytest.mark.parametrize(
    ("source", "follow"),
    [
        # Of another room, and of a room below that it calls.
        ("asperity/slider/kernels.py", {MARCH}),
        (TANGENT, {MARCH}),
        ("asperity/friction/springs.py", {STORED}),
        ("asperity/flanks/meshing/kernels/pattern.py", {GAP}),
        # Of none of them.
        ("asperity/cli/main.py", set()),
        ("asperity/kernels/building/turns.py", set()),
        # What makes machine code, and what calls it.
        ("asperity/kernels/building/lean.py", {MARCH, STORED, GAP}),
        ("asperity/kernels/native/gather.py", {MARCH, STORED, GAP}),
    ],
)
def test_a_changed_source_renames_what_follows_from_it_and_nothing_else(
    source, follow, named, change
):
    before = named()
    change(source)
    assert renamed(before, named()) == follow


@pytest.mark.parametrize(
    ("package", "follow"),
    [("numba", {MARCH, STORED, GAP}), ("llvmlite", {MARCH, STORED, GAP}), ("numpy", set())],
)
def test_another_compiler_renames_all_and_another_numpy_none(package, follow, named, monkeypatch):
    before = named()
    other = keys.versions() | {package: "0.0.1"}
    monkeypatch.setattr(keys, "versions", lambda: other)
    assert renamed(before, named()) == follow


def test_another_platform_renames_all(named, monkeypatch):
    before = named()
    monkeypatch.setattr(keys, "platform_name", lambda: "aarch64-linux")
    assert renamed(before, named()) == {MARCH, STORED, GAP}


def test_no_two_entries_have_one_name():
    assert len({keys.key(entry) for entry in listed().entries}) == len(listed().entries)
