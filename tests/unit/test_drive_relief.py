"""The search for a relief that takes the load off the edges of a loaded gearset."""

import numpy as np
import pytest

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.drive.static.loaded import Loaded
from asperity.drive.studies import optimum, relief
from asperity.errors import ConvergenceError, InputError
from asperity.runs import Run

OVER = ["modification.tip_relief=0,10,20,30,40 um", "hob.oversize=1.05,1.12,1.2"]


def search(*settings, over=OVER, at=()):
    case = read_case("drive-screw", case_tables(), ("drive.teeth=1", "drive.phases=2", *settings))
    return relief.prepare(case, over=over, at=at)


def loaded(worm_tip, flank, wheel_tip=0.0, error=70e-6, k_h_beta=2.0):
    numbers = dict.fromkeys(Loaded.__dataclass_fields__, 0.0)
    numbers |= {
        "force_worm_tip": worm_tip, "force_wheel_tip": wheel_tip, "normal_force": 7000.0,
        "pressure_flank": flank, "pressure_worm_tip": 7e9 * (worm_tip > 0.0),
        "transmission_error": error, "k_h_beta": k_h_beta,
    }  # fmt: skip
    return Loaded(**numbers | {"pattern": np.zeros(1)})


@pytest.fixture
def solved(monkeypatch):
    """Edges bear less with relief and at small loads, flanks more with relief; what was asked."""
    asked = []

    def solve(problems, _run):
        found = []
        for problem in problems:
            asked.append(problem)
            off = 1e6 * (problem.modification.tip_relief if problem.modification else 0.0)
            over = problem.hob.oversize
            edge = max(0.0, 900.0 * problem.load / 366.0 - 45.0 * off)
            found.append(loaded(edge, 1e9 * (1.0 + 0.01 * off + 2.0 * abs(over - 1.1))))
        return found

    monkeypatch.setattr(relief, "solve_points", solve)
    return asked


def test_the_least_relief_that_takes_the_edge_away_at_the_worst_load_is_the_best(solved):
    found = relief.answer(search(), Run())
    # 20 um are just enough at the load, and the hob nearest to the flank's best.
    assert found.best == "modification.tip_relief=20 um, hob.oversize=1.12"
    assert found.edge_force_before == pytest.approx(900.0)
    assert found.edge_force_after == 0.0
    said, few = found.headline()
    assert few.startswith("all of it by 2 phases alone")
    assert "20 um" in said
    assert "takes the worm's tip edge away: the force on edges goes from 900 to 0 N" in said
    assert "from 7000 to 1240 MPa" in said
    best = found.to_json()["designs"][found.best_number]
    assert best["values"] == {"modification.tip_relief [um]": 20.0, "hob.oversize [1]": 1.12}
    # Each design once, at the load and a third of it.
    assert len(solved) == 2 * found.tried
    assert len(set(found.name)) == found.tried


def test_of_designs_whose_edges_bear_little_the_flank_decides(solved):
    # Ten newtons of 7000 count for nothing.
    merits = [
        relief._design(search(), (n, -1), [loaded(edge, flank)]).merit
        for n, (edge, flank) in enumerate([(80.0, 1e9), (10.0, 1.3e9), (0.0, 1.4e9)])
    ]
    assert sorted(merits) == [merits[1], merits[2], merits[0]]


def test_a_design_counts_by_where_it_stands_worst(solved):
    found = relief.answer(search(at=["operation.output_torque=100,366,500 N m"]), Run())
    assert found.stands == tuple(f"operation.output_torque={t} N m" for t in (100, 366, 500))
    assert found.edge_force_before == pytest.approx(900.0 * 500.0 / 366.0)
    assert "modification.tip_relief=30 um" in found.best


def test_the_corners_of_the_tolerances_are_borne_with_where_nothing_else_is_said():
    made = search("tolerances.centre_distance=js7", "tolerances.shaft_angle=0.02 deg")
    assert len(made.stands) == 2 + 4
    assert made.stands[0][0] == "operation.output_torque=366 N m"
    assert made.stands[2][1]["operation.output_torque"] == 366.0
    assert made.stands[2][1]["mount.shaft_angle_error"] < 0.0


def test_a_case_that_is_best_as_it_is_is_left_as_it_is(solved):
    found = relief.answer(search("modification.tip_relief=20 um", over=OVER[:1]), Run())
    assert found.best_number == 0
    assert found.headline()[0] == "no design that was tried is better than the case as it is"


def test_a_design_without_an_answer_is_none_and_told(monkeypatch, solved):
    whole = relief.solve_points

    def solve(problems, run):
        return [
            "no balance" if p.modification and p.modification.tip_relief > 15e-6 else each
            for p, each in zip(problems, whole(problems, run), strict=True)
        ]

    monkeypatch.setattr(relief, "solve_points", solve)
    found = relief.answer(search(over=OVER[:1]), Run())
    assert found.best == "modification.tip_relief=10 um"
    assert "modification.tip_relief=20 um: no balance" in found.notes
    assert found.to_json()["designs"][2]["edge_force_N"] is None
    with pytest.raises(ConvergenceError, match="as the case has it: no balance"):
        relief.answer(search("modification.tip_relief=20 um", over=OVER[:1]), Run())


@pytest.fixture
def at_the_wheel_s_tip(monkeypatch):
    """The wheel's tip edge bears whatever the tip relief, and less with root relief."""

    def solve(problems, _run):
        found = []
        for problem in problems:
            made = problem.modification
            tip, root = (1e6 * made.tip_relief, 1e6 * made.root_relief) if made else (0.0, 0.0)
            edges = max(0.0, 900.0 - 45.0 * tip), max(0.0, 500.0 - 10.0 * root)
            found.append(loaded(edges[0], 1e9 * (1.0 + 0.01 * (tip + root)), edges[1]))
        return found

    monkeypatch.setattr(relief, "solve_points", solve)


def test_left_to_itself_the_search_goes_on_at_the_worm_s_root_where_the_wheel_s_tip_bears(
    at_the_wheel_s_tip,
):
    found = relief.answer(search(over=()), Run())
    # 20 um at the tip, and of what takes 500 N off the wheel's tip the least that is tried.
    assert found.best == "modification.tip_relief=20 um, modification.root_relief=60 um"
    assert found.edge_force_before == pytest.approx(1400.0)
    assert found.edge_force_after == 0.0
    assert found.value.shape == (found.tried, 2)
    assert found.value[0].tolist() == [0.0, 0.0]
    assert found.name[0] == "as the case is"
    assert "takes the worm's tip edge and the wheel's tip edge away" in found.headline()[0]
    assert not any("--over" in note for note in found.notes)


def test_values_that_leave_the_wheel_s_tip_edge_are_told_what_takes_it_off(at_the_wheel_s_tip):
    found = relief.answer(search(over=OVER[:1]), Run())
    assert found.best == "modification.tip_relief=20 um"
    (said,) = (note for note in found.notes if "the wheel's own tip edge" in note)
    assert "bears the most then, 500 N" in said
    assert "--over modification.root_relief" in said


def test_left_to_itself_the_search_ends_at_the_tip_where_that_takes_the_edges_away(solved):
    found = relief.answer(search(over=()), Run())
    assert found.best == "modification.tip_relief=20 um"
    assert [axis.path for axis in found.axes] == ["modification.tip_relief"]


def test_what_is_looked_for_as_well_counts_among_the_points_that_are_too_many():
    stands = ["mount.axial_offset=-12:12:1 um"]
    assert len(search(over=OVER[:1], at=stands).stands) == 25
    with pytest.raises(InputError, match="25 loads and mountings of 10 designs are more than 200"):
        search(over=(), at=stands)


LENGTHS = "axial_offset", "centre_distance_error"


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"over": ["mount.axial_offset=0,10 um"]}, "--over mount.axial_offset: take keys"),
        ({"at": ["modification.tip_relief=0,10 um"]}, "--at modification.tip_relief: take keys"),
        ({"at": ["mount.axial_offset=-50:50:1 um"]}, "more than 200 points"),
        ({"at": ["nan"]}, "^--at nan: it must be table.key="),
        ({"at": ["mount.axial_offset=nan"]}, "^--at mount.axial_offset=nan: mount.axial_offset is"),
        ({"at": 2 * ["mount.axial_offset=1,2 um"]}, "give one --at for the same thing"),
        ({"at": [f"mount.{key}=0:1:0.0009 mm" for key in LENGTHS]}, "^--at: the grid has"),
    ],
)
def test_what_is_no_search_is_refused_in_a_line(options, said):
    with pytest.raises(InputError, match=said):
        search(**options)


def test_optimise_over_the_flanks_finds_the_least_relief_between_the_values(solved):
    case = read_case("drive-screw", case_tables(), ("drive.teeth=1", "drive.phases=2"))
    over = ["modification.tip_relief=10,40 um", "hob.oversize=1.05,1.12,1.2"]
    found = optimum.answer(optimum.prepare(case, over=over), Run())
    best = found.to_json()["designs"][found.best_number]["values"]
    # 900 N less 45 N/um come to a hundredth of 7000 N at 18.4 um: of 10, 17.5, 21.25 and 25 um the
    # third; the hob nearest to 1.1 of those from 1.05 to 1.12 by eighths.
    assert best["modification.tip_relief [um]"] == pytest.approx(21.25)
    assert best["hob.oversize [1]"] == pytest.approx(1.1025)
    assert found.edge_force_after < 70.0
    assert len(set(found.name)) == found.tried


def test_of_equal_edges_and_pressures_the_smaller_error_counts(solved):
    merits = [
        relief._design(search(), (n, -1), [loaded(0.0, 1e9, error=error)]).merit
        for n, error in enumerate([70e-6, 50e-6])
    ]
    assert merits[1] < merits[0]


def best_of(*designs):
    known = {(n,): relief._design(search(), (n, -1), [loaded(**d)]) for n, d in enumerate(designs)}
    return relief._best(list(known), known)[0]


def test_what_differs_by_less_than_a_percent_is_equal_and_the_next_decides():
    # Of 500 and 503 N the flank decides, of 500 and 510 N the edges do.
    assert best_of({"worm_tip": 500.0, "flank": 1.2e9}, {"worm_tip": 503.0, "flank": 1e9}) == 1
    assert best_of({"worm_tip": 500.0, "flank": 1.2e9}, {"worm_tip": 510.0, "flank": 1e9}) == 0
    # Where both flow the error does, and of equal errors the pattern.
    flows = {"worm_tip": 500.0, "flank": 0.98e9}
    assert best_of({**flows, "error": 60e-6}, {**flows, "error": 50e-6}) == 1
    assert best_of({**flows, "k_h_beta": 3.0}, {**flows, "k_h_beta": 1.5}) == 1
    assert best_of({**flows, "k_h_beta": 3.0}, {**flows, "error": 72e-6, "k_h_beta": 1.5}) == 0
    # Of designs that are equal in all the first is left as it is.
    assert best_of(flows, {**flows, "worm_tip": 499.0}) == 0


def test_the_largest_pressure_is_said_to_stay_where_the_wheel_flows(monkeypatch):
    flow = search().case and relief.DriveProblem.from_case(search().case, shaken=False)
    cap = flow.gearset.wheel_material.flow_pressure

    def told(**changes):
        def solve(problems, _run):
            reliefs = [
                1e6 * (p.modification.tip_relief if p.modification else 0.0) for p in problems
            ]
            at_cap = {"pressure_worm_tip": cap} | changes
            return [
                Loaded(**{**vars(loaded(900.0 - 10.0 * off, cap)), **at_cap}) for off in reliefs
            ]

        monkeypatch.setattr(relief, "solve_points", solve)
        return relief.answer(search(over=OVER[:1]), Run()).headline()[0]

    stays = f"the largest pressure stays at {cap / 1e6:.4g} MPa, at which the wheel flows"
    said = told(pressure_flank=cap)
    assert f"{stays}, " in said
    assert "K_Hbeta from 2 to 2" in said
    # Else it reads as if nothing were gained.
    said = told(pressure_flank=0.5 * cap, force_wheel_tip=300.0)
    assert f"{stays} at what still bears, the worm's tip edge and the wheel's tip edge, " in said


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        ({"at": ["operation.output_torque=100 N m"]}, "name what may change with --over"),
        ({"over": OVER, "free": "axial_module"}, "take one after the other"),
        ({"over": ["gearset.ratio=10,20"]}, "--over gearset.ratio"),
    ],
)
def test_optimise_refuses_what_is_of_the_other_search(asked, said):
    case = read_case("drive-screw", case_tables(), ())
    with pytest.raises(InputError, match=said):
        optimum.prepare(case, **asked)
