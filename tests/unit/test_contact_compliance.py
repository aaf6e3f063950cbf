"""How the base of a block gives under friction, against a rigid block on springs and limits."""

import dataclasses

import numpy as np
import pytest

from asperity.block.problem import BlockProblem
from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.contact.compliance import base_compliance
from asperity.errors import InputError

LIGHT = ("block.elements=[4, 3, 3]", "block.element=hex8")


def problem(*settings):
    return BlockProblem.from_case(
        read_case("block-longitudinal", case_tables(), [*LIGHT, *settings])
    )


def test_a_rigid_block_on_springs_rocks_about_its_base():
    block = problem("block.youngs_modulus=100000 GPa", "contact.stiffness=1e10 Pa/m")
    (length, width, height), mass = block.block.size, block.mass
    area, k = length * width, 1e10
    turning = k * area * np.array([length, width]) ** 2 / 12.0
    give = 0.25 * height**2 / turning
    found = block.compliance
    assert np.diag(found.static) == pytest.approx(give, rel=1e-4)
    assert found.static[0, 1] == pytest.approx(0.0, abs=1e-9 * give[0])
    assert found.at_once == pytest.approx(np.zeros((2, 2)), abs=1e-4 * give[0])
    inertia = mass / 12.0 * (np.array([length, width]) ** 2 + height**2)
    squares = [*(turning / inertia), k * area / mass]
    assert found.frequencies == pytest.approx(np.sort(np.sqrt(squares)) / (2 * np.pi), rel=1e-3)


def test_friction_of_a_tenth_of_the_rocking_frequency_rocks_it_a_hundredth_more():
    found = problem().compliance
    slow, mean = found.static, found.at_once
    at = 0.1 * found.frequencies.min()
    rocks = (found.at(at) - mean)[1, 1] / (slow - mean)[1, 1]
    assert rocks == pytest.approx(1.0 / (1.0 - 0.01), rel=1e-9)
    assert found.at(0.0) == pytest.approx(slow)


def test_a_guided_block_gives_by_its_shear_alone():
    free, guided = problem().compliance, problem("slider.lateral=guided").compliance
    assert guided.static == pytest.approx(free.at_once, rel=1e-9)
    assert guided.levers.shape == (2, 1)
    assert np.linalg.eigvalsh(free.static - guided.static).min() > 0.5 * guided.static.min()


def test_modes_share_the_compliance_and_do_not_change_it():
    block = problem("block.modes=12")
    none, some = problem().compliance, block.compliance
    assert some.static == pytest.approx(none.static, rel=1e-9, abs=1e-22)
    assert len(some.frequencies) == 3 + len(block.body.mode_frequency)
    assert some.at_once[0, 0] < none.at_once[0, 0]


def test_hard_contact_is_the_limit_of_a_stiff_one():
    hard = problem("contact.normal=hard").compliance
    stiff = problem("contact.stiffness=1e20 Pa/m").compliance
    assert hard.static == pytest.approx(stiff.static, rel=1e-5, abs=1e-22)
    assert hard.static[0, 0] < problem().compliance.static[0, 0]


def test_two_stages_give_as_the_stage_their_pressure_is_in():
    # 55 N over the base press the contact not beyond its first stage, a tenth as stiff.
    block = problem("contact.normal=two-stage")
    soft = problem(f"contact.stiffness={0.1 * block.normal.stiffness:.17g} Pa/m")
    assert block.compliance.static == pytest.approx(soft.compliance.static, rel=1e-9, abs=1e-22)
    pressed = base_compliance(block.system.mechanism, block.surface, block.normal, 1e15)
    linear = problem(f"contact.stiffness={block.normal.stiffness:.17g} Pa/m")
    assert pressed.static == pytest.approx(linear.compliance.static, rel=1e-9, abs=1e-22)


def test_what_has_no_base_to_give_is_refused():
    block = problem()
    mechanism = block.system.mechanism
    with pytest.raises(InputError, match=r"mean_pressure is 0 Pa"):
        base_compliance(mechanism, block.surface, block.normal, 0.0)
    tied = dataclasses.replace(
        mechanism,
        shapes=mechanism.shapes[:, :0],
        mass=np.empty((0, 0)),
        stiffness=np.empty((0, 0)),
        held=np.empty(0, dtype=bool),
    )
    with pytest.raises(InputError, match=r"has 0 coordinates"):
        base_compliance(tied, block.surface, block.normal, 1.0)
