"""A recording of ten blocks is long enough to be reduced, one of nine is refused."""

from types import SimpleNamespace

import pytest

from asperity.errors import InputError
from asperity.tribometer.reduction import blocks


def recording(samples):
    return SimpleNamespace(
        name="a.h5", index_of=lambda signal: 0, sample_interval=1e-3, samples=samples,
        duration=1e-3 * samples,
    )  # fmt: skip


@pytest.mark.parametrize(("samples", "short"), [(0, True), (199, True), (200, False), (500, False)])
def test_ten_blocks_are_asked_for(monkeypatch, samples, short):
    def long_enough(recording, channels):
        raise StopIteration

    monkeypatch.setattr(blocks, "lines_of", long_enough)
    with pytest.raises(InputError if short else StopIteration) as raised:
        blocks.blocks_of(recording(samples), None, 20e-3)
    if short:
        assert f"holds {samples} samples, {1e-3 * samples:.3g} s" in str(raised.value)
