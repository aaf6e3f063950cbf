"""Bytecode of tests that is made before pytest starts is what pytest would make."""

import bytecode
from _pytest.assertion import rewrite


def test_pytest_takes_what_is_made_until_the_test_is_another(tmp_path):
    path = tmp_path / "test_a.py"
    path.write_text("def test_a():\n    assert 1 + 1 == 3\n")
    made = bytecode.rewrite(path)
    assert rewrite._read_pyc(path, made) == rewrite._rewrite_test(path, None)[1]
    path.write_text("def test_a():\n    assert 1 + 1 == 4\n")
    assert rewrite._read_pyc(path, made) is None


def test_a_module_is_compiled_and_what_cannot_be_is_left(tmp_path):
    good, bad = tmp_path / "good.py", tmp_path / "bad.py"
    good.write_text("LIMIT = 42.5\n")
    bad.write_text("LIMIT =\n")
    for path in (good, bad):
        bytecode.make(path)
    assert [path.name.partition(".")[0] for path in tmp_path.rglob("*.pyc")] == ["good"]
