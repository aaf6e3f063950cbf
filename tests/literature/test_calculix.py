"""The deck for CalculiX run by CalculiX: the load, the package's own pressure, a bar's shortening,
Coulomb's friction.

G. Dhondt, K. Wittig: CalculiX, a free software three-dimensional structural finite element program.
"""

import re
import subprocess

import numpy as np
import pytest

from asperity.block.deck import BlockSetup, calculix_files
from asperity.block.deck.calculix import overclosure, stick_slope
from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.contact.motion.rest import rest_under_load

FLOAT = r"[-+]?\d\.\d+E[-+]\d+"


class Run:
    """What CalculiX says of a case."""

    def __init__(self, folder, *settings, steps=2):
        self.setup = BlockSetup.from_case(read_case("block-longitudinal", case_tables(), settings))
        parts = re.split(r"(?<=\*END STEP)\n", calculix_files(self.setup)["block.inp"])
        (folder / "block.inp").write_text("\n".join([*parts[:steps], ""]))
        done = subprocess.run(
            ["ccx", "block"], cwd=folder, capture_output=True, text=True, check=False, timeout=120
        )
        assert "Job finished" in done.stdout, done.stdout[-2000:]
        text = (folder / "block.dat").read_text()
        contact = re.findall(
            rf"area,  normal force \(\+ = tension\) and shear force \(size\)\s+"
            rf"({FLOAT})\s+({FLOAT})\s+({FLOAT})",
            text,
        )
        self.area, normal, self.shear = np.array(contact, float).T
        self.normal = -normal
        self.place, self.pull = (
            np.array(re.findall(rf"{name}.*\n\n\s+\d+\s+({FLOAT})", text), float)
            for name in ("set DRIVE_POINT", "set DRIVE_END")
        )
        self.frames = list(_frames((folder / "block.frd").read_text()))


def _frames(text):
    """Fields at the nodes, one after the other: name and values by node number."""
    block = re.compile(r"^ -4  (\w+).*\n(?:^ -5.*\n)+((?:^ -1.*\n)+)", re.MULTILINE)
    for name, rows in block.findall(text):
        values = {
            int(row[3:13]): [float(row[i : i + 12]) for i in range(13, len(row), 12)]
            for row in rows.splitlines()
        }
        yield name, values


def field(run, name, number):
    return [values for found, values in run.frames if found == name][number]


@pytest.fixture(scope="module")
def sliding(tmp_path_factory):
    return Run(tmp_path_factory.mktemp("ccx"), "block.elements=[3,2,2]")


@pytest.mark.slow
def test_the_mean_contact_pressure_is_load_over_area(sliding):
    assert sliding.area[0] == pytest.approx(sliding.setup.block.area, rel=1e-6)
    mean = sliding.normal[0] / sliding.area[0]
    assert mean == pytest.approx(sliding.setup.problem.mean_pressure, rel=1e-6)


@pytest.mark.slow
def test_the_pressure_over_the_face_is_that_of_the_package(tmp_path):
    run = Run(tmp_path, "block.elements=[6,5,4]", "block.element=hex8i", steps=1)
    problem, mean = run.setup.problem, run.setup.problem.mean_pressure
    surface = problem.surface
    own = rest_under_load(problem.system, problem.loads).contact.pressure
    own = own.reshape(surface.weights.shape)
    assert surface.integral(own) / surface.area == pytest.approx(mean, rel=1e-9)
    # CalculiX as well writes at the nodes what it has between them.
    # The field of the surface's shape functions that is nearest in the mean square.
    nodes = np.eye(len(surface.nodes))
    nodal = np.linalg.solve(surface.to_forces(surface.to_points(nodes)), surface.to_forces(own))
    other = np.array([field(run, "CONTACT", 0)[node + 1][3] for node in surface.nodes])
    # Weight and friction bend the lower face: one percent less at the corners.
    assert np.ptp(other) > 0.01 * mean
    np.testing.assert_allclose(nodal, other, rtol=0, atol=0.0015 * mean)
    assert np.corrcoef(nodal, other)[0, 1] > 0.999


@pytest.mark.slow
def test_a_block_on_contact_in_two_stages_is_brought_to_rest(tmp_path):
    run = Run(tmp_path, "block.elements=[2, 2, 2]", "contact.normal=two-stage")
    assert run.normal[-1] == pytest.approx(55.0, rel=1e-3)


@pytest.mark.slow
def test_the_spring_pulls_until_full_friction_and_no_further(sliding):
    full = sliding.setup.model.full_friction
    np.testing.assert_allclose(sliding.pull[1:], sliding.shear[1:], rtol=1e-5)
    assert sliding.shear.max() <= full * (1 + 1e-6)
    assert sliding.shear[-1] == pytest.approx(full, rel=1e-6)
    assert sliding.place[-1] > 50 * sliding.setup.model.friction.max_deflection


@pytest.mark.slow
def test_before_it_slides_the_contact_is_as_stiff_as_the_asperities(sliding):
    sticking = sliding.pull < 0.5 * sliding.setup.model.full_friction
    give = np.polyfit(sliding.pull[sticking], sliding.place[sticking], 1)[0]
    asperities = 1.0 / (stick_slope(sliding.setup) * sliding.setup.block.area)
    # The block gives as well, a few percent of what the asperities do.
    assert asperities < give < 1.1 * asperities


@pytest.mark.slow
def test_a_guide_keeps_the_pulled_block_from_leaning_and_bears_none_of_its_load(tmp_path):
    small = ("block.elements=[3,2,2]", "block.element=hex8i")
    runs = []
    for name, *settings in (("free",), ("guided", "slider.lateral=guided")):
        (tmp_path / name).mkdir()
        runs.append(Run(tmp_path / name, *small, *settings))
    free, guided = runs
    body = guided.setup.problem.uncondensed
    turn = body.inertia[:, 4] / body.rigid_mass[4, 4]
    last = np.flatnonzero(guided.pull < 0.9 * guided.setup.model.full_friction)[-1]

    def lean(run):
        places = field(run, "DISP", last)
        return turn @ np.ravel([places[node + 1] for node in range(len(turn) // 3)])

    # Pulled at half its height a free block turns forwards, by what the contact gives and more.
    length, width, height = free.setup.block.size
    resists = free.setup.normal.stiffness * width * length**3 / 12.0
    assert lean(free) > 0.5 * height * free.pull[last] / resists
    # A way is written in six digits.
    assert abs(lean(guided)) < 1e-4 * lean(free)
    np.testing.assert_allclose(guided.normal, free.normal, rtol=1e-5)
    for when in (slice(1, last + 1), slice(-2, None)):
        np.testing.assert_allclose(guided.pull[when], guided.shear[when], rtol=1e-6)


def test_without_friction_and_weight_the_block_is_a_bar_between_two_pressures(tmp_path):
    settings = ["block.elements=[3,2,2]", "block.element=hex8i", "friction.mu=1e-9"]
    run = Run(tmp_path, *settings, "slider.mass=1 mg", steps=1)
    setup = run.setup
    bottom, top = range(1, 13), range(25, 37)
    pressure = [field(run, "CONTACT", 0)[node][3] for node in bottom]
    np.testing.assert_allclose(pressure, setup.problem.mean_pressure, rtol=1e-5)
    moved = np.array([field(run, "DISP", 0)[node][2] for node in (*bottom, *top)])
    squeeze = setup.problem.mean_pressure * setup.block.size[2] / setup.block.youngs_modulus
    np.testing.assert_allclose(moved[:12], 0.0, atol=1e-5 * overclosure(setup))
    np.testing.assert_allclose(moved[12:], -squeeze, rtol=1e-5)
