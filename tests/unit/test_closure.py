from pathlib import Path

import pytest

import asperity
from asperity.kernels.closure import Sources, closure, source_key

PACKAGE = Path(asperity.__file__).parent


def rooms_behind(module, **options):
    return {path.relative_to(PACKAGE).parts[0] for path in closure(module, **options)}


def test_a_kernel_follows_from_the_rooms_below_it_only():
    behind = rooms_behind("asperity.slider.kernels")
    assert {"slider", "friction", "kernels"} <= behind
    assert not {"rating", "flanks", "cli"} & behind


def test_a_module_imported_inside_a_function_counts_where_asked(tmp_path):
    (tmp_path / "late.py").write_text("x = 1\n")
    outer = tmp_path / "pack" / "outer.py"
    outer.parent.mkdir()
    (outer.parent / "late.py").write_text("x = 1\n")
    outer.write_text("def f():\n    from pack.late import x\n    return x\n")
    assert closure("pack.outer", file=outer) == (outer,)
    assert outer.parent / "late.py" in closure("pack.outer", file=outer, lazy=True)


def test_what_is_imported_for_types_alone_does_not_count(tmp_path):
    outer = tmp_path / "pack" / "outer.py"
    outer.parent.mkdir()
    (outer.parent / "types.py").write_text("class A: ...\n")
    outer.write_text(
        "from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    from pack.types import A\nx = 1\n"
    )
    assert closure("pack.outer", file=outer, lazy=True) == (outer,)


def test_names_over_several_lines_are_followed(tmp_path):
    outer = tmp_path / "pack" / "outer.py"
    outer.parent.mkdir()
    for name in ("one", "two"):
        (outer.parent / f"{name}.py").write_text("x = 1\n")
    outer.write_text("from pack import (\n    one,  # the first\n    two,\n)\n")
    assert len(closure("pack.outer", file=outer)) == 3


def test_tables_beside_a_source_belong_to_an_answer():
    assert any(path.suffix == ".toml" for path in closure("asperity.rating", lazy=True))


def test_a_module_that_is_not_there_is_named():
    with pytest.raises(LookupError, match="asperity_nothing"):
        source_key("asperity_nothing.here")


def test_sources_that_are_read_once_have_the_key_that_each_reading_has():
    modules = ("asperity.slider.march", "asperity.rating.rate", "asperity.slider.march")
    once = Sources()
    kept = [source_key(module, sources=once) for module in modules]
    assert kept == [source_key(module) for module in modules]
    assert kept[0] == kept[2] != kept[1]
