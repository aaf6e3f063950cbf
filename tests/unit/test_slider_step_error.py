"""The error of the step that an answer tells is that of a solution on twice the step."""

import pytest

from asperity.casefile import read_case
from asperity.slider import TABLES, Model, solve


@pytest.mark.parametrize("waveform", ["sine", "triangle"])
def test_it_is_a_third_of_what_twice_the_step_changes_where_errors_fall_by_four(waveform):
    fine, coarse = (
        solve(
            Model.from_case(
                read_case(
                    "table-4.3", TABLES,
                    ["solve.method=periodic", f"solve.step={step}",
                     f"vibration.waveform={waveform}"],
                )
            ),
            history=False,
        )
        for step in ("0.25 us", "0.5 us")
    )  # fmt: skip
    assert fine.step_error == pytest.approx(abs(coarse.ratio - fine.ratio) / 3.0, rel=0.01)
