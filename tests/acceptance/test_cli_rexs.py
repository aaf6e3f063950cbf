"""``asperity rexs`` and ``asperity new gear --from`` as a user runs them."""

import json
from pathlib import Path

import pytest

EXAMPLE = Path(__file__).parents[1] / "rexs" / "FVA_worm_stage_1-4.rexs"


def test_a_gearset_goes_out_and_comes_back(asperity, tmp_path):
    file, case = tmp_path / "gearset.rexs", tmp_path / "again.toml"
    code, shown, _ = asperity("rexs", "gearset-3", "--out", file)
    assert code == 0
    assert "as REXS 1.5" in shown
    code, shown, errors = asperity("new", "gear", case, "--from", file)
    assert (code, errors) == (0, "")
    assert "asperity rate" in shown
    before = json.loads(asperity("rate", "gearset-3", "--json")[1])
    after = json.loads(asperity("rate", case, "--json")[1])
    assert abs(after["iso14521"]["mu_zm"] / before["iso14521"]["mu_zm"] - 1.0) < 1e-9
    # A file that is there is not written over.
    code, _, errors = asperity("rexs", "gearset-3", "--out", file)
    assert code == 2
    assert "is there already" in errors


@pytest.mark.slow
def test_the_public_example_is_a_case_and_says_what_it_assumes(asperity, tmp_path):
    case = tmp_path / "example.toml"
    code, _, errors = asperity("new", "gear", case, "--from", EXAMPLE)
    assert code == 0
    assert errors.startswith("the file gives gearset.wheel_material as '16MnCr5'")
    assert "# It was read from FVA_worm_stage_1-4.rexs." in case.read_text()
    assert asperity("check", case)[0] == 0


def test_what_cannot_be_read_is_one_line(asperity, tmp_path):
    for words, said in (
        (("new", "gear", "--from", tmp_path / "none.rexs"), "cannot be read"),
        (("new", "slide", "--from", EXAMPLE), "a REXS file is read as a gear"),
        (("new", "gear", "--ratio", "40", "--from", EXAMPLE), "keep one of them"),
        (("rexs", "table-4.3"), "a case of another kind"),
        (("rexs", "gearset-3", "--out", tmp_path / "x.xml"), "must end in .rexs"),
    ):
        code, _, errors = asperity(*words, cwd=tmp_path)
        assert code == 2
        assert said in errors
        assert errors.count("\n") == 1
