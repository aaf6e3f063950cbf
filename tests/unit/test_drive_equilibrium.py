"""Worm, wheel and shaft in balance, against a flank that is a spring."""

from types import SimpleNamespace

import numpy as np
import pytest

from asperity.drive.static.equilibrium import Equilibrium, TooDeepError
from asperity.drive.teeth.contact import FullError
from asperity.errors import ConvergenceError

STIFFNESS = 2e6


class Spring:
    """Stands in for the teeth: a torque that goes with the wheel's angle, and none beyond."""

    def __init__(self, stiffness=STIFFNESS):
        self.stiffness, self.side = stiffness, 1
        self.stand = SimpleNamespace(axes=np.eye(3), origin=np.array([0.05, 0.0, 0.0]), ratio=15.0)
        self.sector = SimpleNamespace(
            wheel=SimpleNamespace(pair=SimpleNamespace(geometry=SimpleNamespace(axial_module=4.0))),
            body=SimpleNamespace(places=np.array([[0.0, 0.04, 0.0]])),
            mean_compliance=0.0,
        )

    def act(self, beta, phi, shift, *, sense, tolerance):
        deep = max(-phi, 0.0)
        slope = np.zeros((6, 6))
        slope[5, 5] = self.stiffness if deep > 0.0 else 0.0
        wrench = np.zeros(6)
        wrench[5] = self.stiffness * deep
        return SimpleNamespace(wrench=wrench, slope=slope)


def test_a_balance_is_found_from_where_nothing_touches():
    found = Equilibrium(Spring()).balance(0.0, 300.0, touching=0.0)
    assert found.wheel_angle == pytest.approx(-300.0 / STIFFNESS, rel=1e-6)


def test_a_singular_contact_is_told_as_no_balance():
    class Singular(Spring):
        def act(self, *args, **kwargs):
            raise np.linalg.LinAlgError("singular")

    with pytest.raises(ConvergenceError, match="found no balance at 0 deg of the worm"):
        Equilibrium(Singular()).balance(0.0, 300.0, touching=0.0)


def test_a_step_to_where_too_much_touches_is_taken_back_and_a_load_there_is_refused():
    class Full(Spring):
        def act(self, beta, phi, shift, *, sense, tolerance):
            if phi < -2.2 * 300.0 / STIFFNESS:
                raise FullError("full")
            return super().act(beta, phi, shift, sense=sense, tolerance=tolerance)

    far = Full()
    far.sector.mean_compliance = 2.0 * 0.04**2 / STIFFNESS
    assert Equilibrium(far).balance(0.0, 300.0, touching=0.0).residual < 1e-6
    with pytest.raises(TooDeepError):
        Equilibrium(far).balance(0.0, 900.0, touching=0.0)


def test_a_slope_that_vanishes_under_load_is_told_as_no_balance():
    class Flat(Spring):
        def act(self, *args, **kwargs):
            wrench = np.zeros(6)
            wrench[5] = 100.0
            return SimpleNamespace(wrench=wrench, slope=np.zeros((6, 6)))

    with pytest.raises(ConvergenceError, match="found no balance"):
        Equilibrium(Flat()).balance(0.0, 300.0, touching=0.0)
