"""The other flanks of the teeth, which bear as the drive runs backwards."""

from types import SimpleNamespace

import pytest

from asperity.drive.static import solve
from asperity.drive.static.equilibrium import TooDeepError


def test_patterns_of_a_drive_that_runs_backwards_are_of_the_flanks_behind(monkeypatch):
    asked = []

    class Contact:
        def __init__(self, sector, friction, *, side):
            asked.append((sector, friction, side))

    def too_deep(*given):
        raise TooDeepError("none bear")

    monkeypatch.setattr(solve, "TeethContact", Contact)
    monkeypatch.setattr(solve, "Equilibrium", lambda contact, compliance: contact)
    monkeypatch.setattr(solve, "Pattern", lambda resolved: SimpleNamespace(evaluate=None))
    monkeypatch.setattr(solve, "touching_angles", lambda contact, phases: None)
    monkeypatch.setattr(solve, "sweep", too_deep)
    model = SimpleNamespace(
        sector="teeth", friction=0.1, resolved=None, phases=(), run=None,
        problem=SimpleNamespace(load=1.0), equilibrium=SimpleNamespace(compliance=0.0),
    )  # fmt: skip
    # Where none bear there is no pattern.
    assert solve._back_patterns(model, 0, 1) is None
    assert asked == [("teeth", pytest.approx(0.1), -1)]
