"""The table of designs that were tried: each with its numbers, the best alone marked."""

from types import SimpleNamespace

import numpy as np
import pytest

from asperity.drive.studies.relieved import Relieved

KEYS = (
    "edge_force_N", "force_worm_tip_N", "force_wheel_tip_N", "force_face_end_N",
    "pressure_flank_MPa", "pressure_peak_MPa",
)  # fmt: skip


@pytest.mark.parametrize("best", [0, 1, 2])
def test_the_best_row_is_marked_and_an_error_is_shown_in_microradians(best):
    axes = (SimpleNamespace(path="modification.tip_relief", key="tip_relief", unit="um"),)
    rows = [
        {key: 100.0 * n + m for m, key in enumerate(KEYS)}
        | {"transmission_error_rad": n * 1.5e-6, "k_h_beta": 1.0 + n}
        for n in range(1, 4)
    ]
    fake = SimpleNamespace(
        axes=axes, value=np.array([[0.0], [20.0], [40.0]]), rows=rows, best_number=best, notes=(),
    )  # fmt: skip
    (table,) = Relieved.tables(fake)
    text = [[str(cell) for cell in row] for row in table.rows]
    assert [float(row[0]) for row in text] == [0.0, 20.0, 40.0]
    assert [row[-1] for row in text] == ["best" if n == best else "" for n in range(3)]
    for n, row in enumerate(text):
        assert [float(cell) for cell in row[1:8]] == [
            *(100.0 * (n + 1) + m for m in range(6)),
            (n + 1) * 1.5,
        ]
        assert float(row[8]) == n + 2.0  # fmt: skip
