import re

import numpy as np
import pytest
from scipy.linalg import null_space

from asperity.block.deck import BlockSetup, abaqus_files, calculix_files, fric_subroutine
from asperity.block.deck.calculix import overclosure
from asperity.block.problem import held_coordinates
from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.contact.interface.normal import pressure
from asperity.errors import InputError
from asperity.mesh.inp import numbers

SMALL = ["block.elements=[3,2,2]"]
CASES = {
    "as shipped": [],
    "8 nodes": ["block.element=hex8"],
    "incompatible modes": ["block.element=hex8i"],
    "two stages": ["contact.normal=two-stage"],
    "hard": ["contact.normal=hard", "contact.stiffness=1 GPa/um"],
    "two-phase": ["solve.scheme=two-phase"],
    "body vibrated": ["vibration.applied_to=body"],
    "square wave": ["vibration.waveform=square", "vibration.rise_time=20 us"],
    "guided": ["slider.lateral=guided", "slider.drive_damping=10 N s/m"],
    "Coulomb": ["friction.model=coulomb", "friction.law=vector"],
    "vibration from the start": ["vibration.start=0 s"],
}


def setup_of(*settings, case="block-transverse"):
    return BlockSetup.from_case(read_case(case, case_tables(), [*SMALL, *settings]))


class Deck:
    """Keywords of a deck with their options and data lines."""

    def __init__(self, text):
        self.text = text
        self.blocks = []
        for line in text.splitlines():
            if line.startswith("*") and not line.startswith("**"):
                keyword, *options = (part.strip() for part in line.split(","))
                pairs = (option.partition("=") for option in options)
                self.blocks.append((keyword[1:], {k: v for k, _, v in pairs}, []))
            elif not line.startswith("**"):
                self.blocks[-1][2].append([part.strip() for part in line.split(",")])

    def all(self, keyword, **wanted):
        return [
            (options, rows)
            for name, options, rows in self.blocks
            if name == keyword and wanted.items() <= options.items()
        ]

    def one(self, keyword, **wanted):
        (found,) = self.all(keyword, **wanted)
        return found[1]

    def names(self):
        keys = {"NSET": "NSET", "ELSET": "ELSET", "ELEMENT": "ELSET", "SURFACE": "NAME"}
        keys |= {"MATERIAL": "NAME", "AMPLITUDE": "NAME", "SURFACE INTERACTION": "NAME"}
        return {options[keys[name]] for name, options, _ in self.blocks if name in keys}


@pytest.fixture(params=CASES)
def settings(request):
    return CASES[request.param]


def decks(settings):
    setup = setup_of(*settings)
    return [Deck(files(setup)["block.inp"]) for files in (abaqus_files, calculix_files)]


@pytest.mark.ordinary(2)
def test_the_same_case_gives_the_same_files(settings):
    assert abaqus_files(setup_of(*settings)) == abaqus_files(setup_of(*settings))
    assert calculix_files(setup_of(*settings)) == calculix_files(setup_of(*settings))


@pytest.mark.ordinary(8)
def test_every_name_a_deck_uses_is_defined_in_it(settings):
    for deck in decks(settings):
        known = deck.names()
        for keyword, options, rows in deck.blocks:
            for option in ("MATERIAL", "AMPLITUDE", "INTERACTION", "SLAVE", "MASTER"):
                assert options.get(option, "block") in known, keyword
            if keyword in ("RIGID BODY", "COUPLING"):
                assert {options.get(key, "base") for key in ("REF NODE", "SURFACE")} <= known
            if keyword in ("SPRING", "DASHPOT", "SOLID SECTION"):
                assert options["ELSET"] in known
            if keyword in ("BOUNDARY", "DLOAD", "DSLOAD", "CONTACT PAIR"):
                assert {row[0] for row in rows} <= known


@pytest.mark.ordinary(10)
def test_a_deck_keeps_within_what_the_programs_read(settings):
    for deck in decks(settings):
        for line in deck.text.splitlines():
            if line.startswith("**") or line.startswith("Block"):
                assert len(line) <= 100
                continue
            assert len(line) <= 256
            entries = [part.strip() for part in line.split(",")]
            assert len(entries) <= 17
            assert all(len(entry) <= 20 for entry in entries if not line.startswith("*"))


def test_a_subroutine_stays_in_fixed_form(settings):
    for name, text in abaqus_files(setup_of(*settings)).items():
        if name == "user.f":
            assert max(map(len, text.splitlines())) <= 72
            assert text.isascii()


def test_weight_and_load_make_the_normal_force(settings):
    setup = setup_of(*settings)
    for deck in decks(settings):
        ((_, rows),) = deck.all("DLOAD")
        assert rows[0][:2] == ["block", "GRAV"]
        gravity, *direction = map(float, rows[0][2:])
        assert direction == [0.0, 0.0, -1.0]
        ((_, rows),) = deck.all("DSLOAD")
        density = float(deck.one("DENSITY")[0][0])
        force = density * setup.block.volume * gravity + float(rows[0][2]) * setup.block.area
        assert force == pytest.approx(setup.model.slider.normal_force, rel=1e-12)


def test_the_block_in_the_deck_has_its_size_and_its_elements():
    setup = setup_of("block.element=hex8i")
    deck = decks(["block.element=hex8i"])[1]
    points = np.array([[float(x) for x in row[1:]] for row in deck.all("NODE")[0][1]])
    np.testing.assert_allclose(np.ptp(points, axis=0), setup.block.size)
    assert points[:, 2].min() == pytest.approx(-overclosure(setup))
    cells = np.array(deck.one("ELEMENT", ELSET="block"), dtype=int)
    assert cells.shape == (12, 9)
    assert set(cells[:, 1:].ravel()) == set(range(1, len(points) + 1))
    assert len(deck.one("SURFACE", NAME="bottom")) == 6


def test_calculix_gets_eight_elements_for_a_27_node_one_on_the_same_nodes():
    setup = setup_of()
    abaqus, calculix = decks([])
    assert abaqus.all("ELEMENT", ELSET="block")[0][0]["TYPE"] == "C3D27"
    (options, rows), *_ = calculix.all("ELEMENT", ELSET="block")
    assert options["TYPE"] == "C3D8I"
    assert len(rows) == 8 * 12
    coarse, fine = setup.problem.mesh, setup.eight_node_mesh()
    np.testing.assert_allclose(coarse.points, fine.points, rtol=0, atol=1e-15)


def test_the_steps_are_those_of_the_thesis_and_last_as_long_as_the_case_says():
    setup = setup_of()
    deck = decks([])[0]
    steps = [options for options, _ in deck.all("STEP")]
    assert [step["NAME"] for step in steps] == ["weight", "load", "drive", "vibration"]
    assert all(step["UNSYMM"] == "YES" for step in steps)
    lengths = [float(rows[0][1]) for _, rows in deck.all("DYNAMIC")]
    assert sum(lengths[2:]) == pytest.approx(setup.model.duration)
    assert lengths[2] == pytest.approx(setup.model.start)
    assert [float(rows[0][0]) for _, rows in deck.all("DYNAMIC")][2:] == [setup.model.step] * 2


def test_a_vibration_from_the_start_has_no_step_of_driving_alone():
    deck = decks(["vibration.start=0 s"])[0]
    assert [o["NAME"] for o, _ in deck.all("STEP")] == ["weight", "load", "vibration"]
    assert len(deck.all("BOUNDARY", AMPLITUDE="drive")) == 1


@pytest.mark.parametrize("on_body", [False, True])
def test_the_base_moves_as_the_subroutine_takes_it_to_move(on_body):
    settings = ["vibration.direction=60 deg"]
    settings += ["vibration.applied_to=body"] if on_body else []
    setup = setup_of(*settings)
    model, deck = setup.model, decks(settings)[0]
    (_, props) = deck.all("FRICTION")[0]
    values = [float(value) for row in props for value in row if value]
    wave = deck.one("AMPLITUDE", NAME="vibration")
    assert float(wave[0][1]) == pytest.approx(2 * np.pi * values[5], rel=1e-12)
    assert float(wave[0][2]) == pytest.approx(values[4], rel=1e-12)
    assert values[4] == pytest.approx(0.02 + model.start)
    moved = {row[1]: float(row[3]) for row in deck.one("BOUNDARY", AMPLITUDE="vibration")}
    sign = -1.0 if on_body else 1.0
    assert moved["1"] == pytest.approx(sign * model.amplitude * np.cos(np.pi / 3))
    assert moved["2"] == pytest.approx(sign * model.amplitude * np.sin(np.pi / 3))
    # A body's law needs no motion of the base.
    assert values[6] == pytest.approx(0.0 if on_body else moved["2"], abs=1e-30)


def test_the_deck_hands_the_numbers_of_the_friction_to_the_subroutine():
    setup = setup_of("friction.exponent=1.5")
    ((options, rows),) = decks(["friction.exponent=1.5"])[0].all("FRICTION")
    written = fric_subroutine(setup.model, before=0.02)
    assert options["DEPVAR"] == str(written.state_variables)
    assert options["PROPERTIES"] == str(len(written.properties))
    assert all(len(row) <= 8 for row in rows)
    values = [float(value) for row in rows for value in row if value]
    assert values == pytest.approx(written.properties, rel=1e-12)
    assert values[:4] == [0.1, 1.5, 75.49e-9, 0.71]


def test_a_friction_stiffness_becomes_the_limit_at_the_nominal_force():
    settings = ["friction.tangential_stiffness=80 MN/m"]
    written = fric_subroutine(setup_of(*settings).model)
    assert written.properties[2] == pytest.approx(0.1 * 50.8 / 80e6)


def test_coulomb_friction_needs_no_subroutine_but_a_square_wave_does():
    coulomb = ["friction.model=coulomb", "friction.law=vector"]
    assert set(abaqus_files(setup_of(*coulomb))) == {"block.inp"}
    files = abaqus_files(setup_of(*coulomb, *CASES["square wave"]))
    assert "SUBROUTINE DISP" in files["user.f"]
    assert "SUBROUTINE FRIC" not in files["user.f"]
    assert "*BOUNDARY, USER" in files["block.inp"]


def test_friction_with_rate_effects_is_refused():
    with pytest.raises(InputError, match=r"friction.model is 'lugre'; FRIC is written for 'dahl'"):
        abaqus_files(setup_of("friction.model=lugre"))


def test_asperities_that_keep_their_stiffness_are_refused_but_by_phases():
    with pytest.raises(InputError, match=r"keeps is 'stiffness'; FRIC is written for 'deflection'"):
        abaqus_files(setup_of("friction.keeps=stiffness"))
    assert "FRIC" in abaqus_files(setup_of("solve.scheme=two-phase"))["user.f"]


def test_the_second_slip_direction_is_one_way_or_the_other():
    with pytest.raises(InputError, match="side is 0; it must be -1 or 1"):
        fric_subroutine(setup_of().model, side=0)


HELD = {
    "guided": (["slider.lateral=guided"], False),
    "rigid drive": ([], True),
    "guided rigid drive": (["slider.lateral=guided"], True),
}


def held_setup(name, *more):
    """A block with a guide, a rigid drive, or both, and which coordinates the package holds."""
    settings, rigid = HELD[name]
    case = read_case("block-transverse", case_tables(), [*SMALL, *settings, *more])
    if rigid:
        case = case.replace_values({"slider.drive_stiffness": None, "slider.drive_damping": None})
    setup = BlockSetup.from_case(case)
    slider = setup.model.slider
    held = held_coordinates(setup.problem.body, rigid=slider.rigid, guided=not slider.free)
    return setup, held[:6]


def rigid_motion(points):
    """Displacements, shape (3N, 6), of shifts and of turns about the middle of some points."""
    arms = points - 0.5 * (points.min(axis=0) + points.max(axis=0))
    turns = [np.cross(axis, arms).ravel() for axis in np.eye(3)]
    return np.transpose([*(np.tile(axis, len(points)) for axis in np.eye(3)), *turns])


def strained(points):
    """Displacements, shape (3N, 30), whose gradients are constant or linear over a body."""
    x, y, z = (points / np.ptp(points, axis=0)).T
    fields = [x, y, z, x * x, y * y, z * z, x * y, y * z, z * x, x + y * y]
    return np.transpose([np.outer(field, axis).ravel() for field in fields for axis in np.eye(3)])


@pytest.mark.ordinary(2)
@pytest.mark.parametrize("name", HELD)
def test_in_abaqus_guide_and_rigid_drive_hold_the_mean_motion_of_the_mass(name):
    setup, held = held_setup(name)
    deck = Deck(abaqus_files(setup)["block.inp"])
    points = np.array([[float(x) for x in row[1:]] for row in deck.all("NODE")[0][1]])
    ((options, rows),) = deck.all("SURFACE", TYPE="NODE")
    assert [int(node) for node, _ in rows] == list(range(1, len(points) + 1))
    weights = np.array([float(weight) for _, weight in rows])
    assert weights.sum() == pytest.approx(setup.problem.mass, rel=1e-12)
    ((coupling, _),) = deck.all("COUPLING", SURFACE=options["NAME"])
    assert ["1", "6"] in [row[:2] for _, rows in deck.all("DISTRIBUTING") for row in rows]
    # The reference node goes as the rigid body with the momenta of the weights does.
    reference = rigid_motion(points)
    weighted = reference * np.repeat(weights, 3)[:, None]
    mean = np.linalg.solve(reference.T @ weighted, weighted.T)
    np.testing.assert_allclose(mean @ reference, np.eye(6), atol=1e-12)
    body = setup.problem.uncondensed
    own = np.linalg.solve(body.rigid_mass, body.inertia.T)
    fields = strained(points)
    np.testing.assert_allclose(mean @ fields, own @ fields, atol=1e-10)
    fixed = {int(row[1]) for row in deck.all("BOUNDARY")[0][1] if row[0] == coupling["REF NODE"]}
    assert fixed == set(np.flatnonzero(held) + 1)
    ((_, node),) = deck.all("NSET", NSET=coupling["REF NODE"])
    place = {row[0]: row[1:] for _, rows in deck.all("NODE") for row in rows}[node[0][0]]
    np.testing.assert_allclose([float(x) for x in place], body.centre, atol=1e-12)


@pytest.mark.ordinary(2)
@pytest.mark.parametrize("element", ["hex27", "hex8i"])
@pytest.mark.parametrize("name", HELD)
def test_in_calculix_equations_hold_the_mean_motion_of_the_mass(name, element):
    setup, held = held_setup(name, f"block.element={element}", "block.elements=[4,2,2]")
    deck = Deck(calculix_files(setup)["block.inp"])
    nodes = len(setup.problem.mesh.points)
    (drive,) = deck.all("NSET", NSET="drive_point")
    point = 3 * (int(drive[1][0][0]) - 1)
    equations = []
    for _, (count, *rows) in deck.all("EQUATION"):
        terms = [row[i : i + 3] for row in rows for i in range(0, len(row), 3)]
        assert len(terms) == int(count[0])
        equations.append([(3 * (int(n) - 1) + int(f) - 1, float(c)) for n, f, c in terms])
    matrix = np.zeros((len(equations), 1 + max(at for terms in equations for at, _ in terms)))
    for row, terms in zip(matrix, equations, strict=True):
        for at, factor in terms:
            row[at] += factor
    # The program takes the first freedom of each out of its unknowns: no other may hold it.
    first = [terms[0][0] for terms in equations]
    assert (np.count_nonzero(matrix[:, first], axis=0) == 1).all()
    # What is left when the nodes added for the sums are taken out holds for the block alone.
    others = np.delete(matrix[:, 3 * nodes :], point - 3 * nodes, axis=1)
    alone = null_space(others.T).T if others.any() else np.eye(len(matrix))
    left = alone @ matrix[:, [*range(3 * nodes), point]]
    body = setup.problem.uncondensed
    means = np.linalg.solve(body.rigid_mass, body.inertia.T)
    wanted = [np.append(means[j], -float(j == 0)) for j in np.flatnonzero(held)]
    if not setup.model.slider.rigid:
        share = setup.problem.nodal_drive
        wanted.append(np.append(share, -1.0))
    assert np.linalg.matrix_rank(left) == len(left) == len(wanted)
    for mean in wanted:
        mean = mean / np.linalg.norm(mean)
        part = np.linalg.lstsq(left.T, mean)[0] @ left
        np.testing.assert_allclose(part, mean, atol=1e-9)
    for j, shift in enumerate(rigid_motion(body.mesh.points).T):
        # The drive's point goes along, or stays where a rigid drive holds it.
        along = shift @ setup.problem.nodal_drive if not setup.model.slider.rigid else 0.0
        broken = np.abs(left @ np.append(shift, along)).max() > 1e-6 * np.abs(shift).max()
        assert broken == held[j]


def test_a_free_block_with_a_spring_is_held_by_nothing_but_its_base():
    abaqus, calculix = decks([])
    assert not abaqus.all("SURFACE", TYPE="NODE")
    assert len(abaqus.all("COUPLING")) == 1
    assert len(calculix.all("EQUATION")) == 1


@pytest.mark.parametrize("files", [abaqus_files, calculix_files])
def test_a_rigid_drive_moves_what_it_holds_without_a_spring(files):
    setup, _ = held_setup("rigid drive")
    deck = Deck(files(setup)["block.inp"])
    assert not deck.all("SPRING")
    first, *later = (rows for _, rows in deck.all("BOUNDARY"))
    (moved, *_) = [row for rows in later for row in rows if row[0] != "base_point"]
    assert [row[1:] for row in first if row[0] == moved[0]][-1] == ["1", "1"]
    assert moved[1:3] == ["1", "1"]
    assert float(moved[3]) > 0.0


def test_two_stages_are_written_point_by_point():
    setup = setup_of("contact.normal=two-stage")
    table = np.array(setup.pressure_table())
    assert np.all(np.diff(table, axis=0) > 0.0)
    for over in np.linspace(0.0, setup.normal.end, 40):
        exact = pressure(over, 0.0, setup.normal.numbers)[0]
        read = np.interp(over, table[:, 1], table[:, 0])
        assert read == pytest.approx(exact, rel=5e-3, abs=1e-6)
    abaqus, calculix = decks(["contact.normal=two-stage"])
    ((options, rows),) = abaqus.all("SURFACE BEHAVIOR")
    assert options == {"PRESSURE-OVERCLOSURE": "TABULAR"}
    np.testing.assert_allclose([[float(v) for v in row] for row in rows], table, rtol=1e-12)
    # CalculiX does not come to an equilibrium with such a table: a line to the mean pressure.
    options, rows = calculix.all("SURFACE BEHAVIOR")[0]
    assert options == {"PRESSURE-OVERCLOSURE": "LINEAR"}
    assert float(rows[0][0]) * overclosure(setup) == pytest.approx(setup.problem.mean_pressure)


def test_two_stages_are_written_as_far_as_a_block_goes():
    stages = ["contact.normal=two-stage", 'contact.transition=["0 nm", "0.1 nm"]']
    setup = setup_of(*stages)
    table = np.array(setup.pressure_table())
    assert np.all(np.diff(table, axis=0) > 0.0)
    assert table[0] == pytest.approx([0.0, 0.0])
    assert table[-1, 0] == pytest.approx(100.0 * setup.problem.mean_pressure)


def test_the_block_stands_in_the_base_as_deep_as_its_mean_pressure_presses_it():
    beyond = ["contact.normal=two-stage", 'contact.transition=["0.01 nm", "0.02 nm"]']
    for settings in ([], ["contact.normal=two-stage"], beyond):
        setup = setup_of(*settings)
        depth = overclosure(setup)
        assert pressure(depth, 0.0, setup.normal.numbers)[0] == pytest.approx(
            setup.problem.mean_pressure, rel=1e-9
        )


@pytest.mark.parametrize(
    ("settings", "why"),
    [
        (
            ["slider.normal_force=19 N"],
            "slider.normal_force is 19 N; it must be at least the weight of the block, 19.61 N",
        ),
        (["slider.mass=6 kg"], "give a smaller slider.mass"),
    ],
)
def test_a_block_heavier_than_its_normal_force_is_refused(settings, why):
    with pytest.raises(InputError, match=re.escape(why)):
        setup_of(*settings)


def test_a_case_without_a_block_or_a_mass_is_refused():
    with pytest.raises(InputError, match=r"the table \[block\] is missing"):
        BlockSetup.from_case(read_case("table-4.3", case_tables()))
    bare = read_case("block-transverse", case_tables()).replace_values(
        {"slider.drive_stiffness": None, "slider.drive_damping": None, "slider.mass": None,
         "slider.lateral": None}
    )  # fmt: skip
    with pytest.raises(InputError, match=r"slider.mass is missing; it makes the density"):
        BlockSetup.from_case(bare)


def test_a_number_never_loses_its_end():
    assert numbers(7.164982974299455e-05, 0.5) == "7.164982974299e-05, 0.5"
    assert numbers(9.80665) == "9.80665,"
    assert all(len(part) <= 20 for part in numbers(-1 / 3e200, 2 / 3).split(", "))
