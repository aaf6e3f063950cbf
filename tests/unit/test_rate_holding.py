"""What holds the load of a worm gearset when its motor stops."""

import math

import pytest
from apparatus.gearsets import MINIMAL, RUN

from asperity.gearset import Gearset
from asperity.rating import Operation, RatingOptions, rate


def held(gearset=(), options=()):
    rated = rate(
        Gearset(**{**MINIMAL, **dict(gearset)}, units="SI"),
        Operation(**RUN, units="SI"),
        RatingOptions(**dict(options), units="SI"),
    )
    return rated, {(one.standard, one.factored): one for one in rated.holding}


def test_the_brake_balances_the_load_on_a_wedge_with_friction():
    rated, found = held({"starts": 4, "wheel_teeth": 40})
    lead = math.atan(4 / 10)
    assert list(found) == [("iso14521", False), ("bs721", False), ("agma6034", False)]
    mu = {(v.standard, v.state): v.friction for v in rated.self_locking}
    for standard in ("iso14521", "bs721"):
        one = found[standard, False]
        for torque, state in ((one.at_rest, "static"), (one.moving, "dynamic")):
            rho = math.atan(mu[standard, state])
            assert torque == pytest.approx(300 / 10 * math.tan(lead - rho) / math.tan(lead))
    # AGMA 6034: balance of the forces on an inclined flank, normal force cos(phi_n) across it.
    f, c = mu["agma6034", "dynamic"], math.cos(math.radians(20))
    pushed = (c * math.sin(lead) - f * math.cos(lead)) / (c * math.cos(lead) + f * math.sin(lead))
    assert found["agma6034", False].moving == pytest.approx(30.0 * pushed / math.tan(lead))


def test_without_friction_the_brake_bears_the_load_by_the_ratio():
    _, found = held(options={"friction_factor": 0.0})
    assert {factored for _, factored in found} == {True}
    for one in found.values():
        assert one.at_rest == one.moving == pytest.approx(300 / 20)
        assert one.state == "runs back"


def test_a_load_is_held_until_moved_where_only_the_friction_at_rest_locks():
    rated, found = held({"starts": 1, "diameter_factor": 14, "centre_distance": "108 mm"})
    for one in found.values():
        verdicts = {v.state: v.locks for v in rated.self_locking if v.standard == one.standard}
        moved = "held" if verdicts["dynamic"] else "held until it is moved"
        assert one.state == (moved if verdicts["static"] else "runs back")
    assert found["bs721", False].state == "held until it is moved"
    assert found["bs721", False].to_json()["brake_at_rest_Nm"] == 0.0
    assert found["bs721", False].to_json()["brake_moving_Nm"] > 0.0


def test_vibration_sets_a_load_free_that_is_held_without_it():
    lead = math.atan(1 / 10)
    _, found = held({"starts": 1}, options={"friction": 0.12, "friction_factor": 0.5})
    shaken, still = found["given", True], found["given", False]
    assert (still.state, shaken.state) == ("held", "runs back")
    for one, mu in ((shaken, 0.06), (still, 0.12)):
        torque = 300 / 40 * math.tan(lead - math.atan(mu)) / math.tan(lead)
        assert one.at_rest == one.moving == pytest.approx(torque)
    assert still.to_json()["lowering_Nm"] == -still.moving > 0.0


def test_a_rating_tells_what_its_steel_was_taken_for():
    rated, _ = held({"worm_material": "42CrMo4"})
    assert any("42CrMo4 (1.7225) is taken for 0.4C steel" in note for note in rated.notes)
    assert any(
        "not known to be hardened" in note
        for note in rated.agma6034.notes + rated.agma6034.violations
    )
    plain, _ = held({"worm_material": "0.4C steel"})
    assert rated.bs721["M_26k_Nm"] == plain.bs721["M_26k_Nm"]
