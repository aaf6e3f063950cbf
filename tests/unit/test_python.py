"""What a session in Python begins with: names at the top, one case or its tables, short reprs."""

import math
import subprocess
import sys
import textwrap

import numpy as np
import pytest

import asperity
from asperity.errors import InputError
from asperity.slider.closed_forms import directed_ratio

BODY = asperity.Slider(
    drive_velocity="0.5 mm/s", drive_stiffness="96068 N/m", mass="0.5 kg", normal_force="55 N"
)
CONTACT = asperity.Friction(mu=0.1, max_deflection="68.75 nm")
SHAKEN = asperity.Vibration(frequency="4 kHz", velocity_ratio=6.0)
PERIODIC = asperity.Solve(method="periodic")
GEARSET = asperity.Gearset(
    starts=2,
    wheel_teeth=40,
    centre_distance="100 mm",
    axial_module="4 mm",
    worm_material="case-hardened steel",
    wheel_material="CuSn12-C-GZ",
)
OPERATION = asperity.Operation(
    worm_speed="1500 rpm", output_torque="300 N m", lubricant="ISO VG 220 mineral"
)


def refusal(call, *arguments, **keywords):
    with pytest.raises(InputError) as raised:
        call(*arguments, **keywords)
    assert len(str(raised.value).splitlines()) == 1
    return str(raised.value)


@pytest.mark.slow
def test_the_names_at_the_top_are_imported_when_they_are_used():
    code = """
        import sys, asperity
        assert not {"numpy", "pydantic"} & set(sys.modules)
        assert set(asperity.__all__) <= set(dir(asperity))
        asperity.Gearset
        assert "numba" not in sys.modules and "matplotlib" not in sys.modules
    """
    subprocess.run([sys.executable, "-c", textwrap.dedent(code)], check=True)
    assert all(getattr(asperity, name) is not None for name in asperity.__all__)
    with pytest.raises(AttributeError, match="nothing"):
        _ = asperity.nothing


@pytest.mark.slow
def test_a_gearset_is_rated_by_name_by_case_or_by_its_tables_in_any_order():
    by_name = asperity.rate("gearset-3").to_json()
    assert asperity.rate(asperity.read("gearset-3")).to_json() == by_name
    tables = asperity.rate(OPERATION, GEARSET)
    assert tables.to_json() == asperity.rate(GEARSET, OPERATION).to_json()
    assert tables.verdict.holds.keys() == {"iso14521", "bs721", "agma6034"}
    assert tables.iso14521["S_H"] == tables.iso14521["safety_pitting"]
    alone = asperity.rate(
        "gearset-3", standard="bs721", settings=["operation.output_torque=200 N m"]
    )
    assert alone.iso14521 is None
    assert alone.bs721["output_torque_Nm"] == 200.0


def test_a_body_is_pulled_by_its_tables():
    result = asperity.slide(BODY, CONTACT, SHAKEN, PERIODIC)
    model = asperity.Model(BODY, CONTACT, SHAKEN, PERIODIC)
    assert result.ratio == asperity.solve(model).ratio


def test_a_model_is_taken_as_its_tables_are():
    model = asperity.Model(BODY, CONTACT, SHAKEN, PERIODIC)
    by_tables = asperity.slide(BODY, CONTACT, SHAKEN, PERIODIC).to_json()
    assert asperity.slide(model).to_json() | {"seconds": 0.0} == by_tables | {"seconds": 0.0}
    # Without vibration it holds all it can; static is asked for what shakes.
    shaken = asperity.static(asperity.Model(BODY, CONTACT, SHAKEN))
    by_tables = asperity.static(BODY, CONTACT, SHAKEN).to_json()
    assert shaken.to_json() | {"seconds": 0.0} == by_tables | {"seconds": 0.0}
    assert "is given twice" in refusal(asperity.slide, model, CONTACT)


def test_a_model_under_load_brings_all_its_tables():
    normal = asperity.Normal(law="linear", penetration="1 um")
    model = asperity.Model(BODY, CONTACT, SHAKEN, PERIODIC, normal=normal)
    assert [type(one).__name__ for one in model.tables] == [
        "Slider", "Friction", "Vibration", "Normal", "Solve",
    ]  # fmt: skip


@pytest.mark.parametrize(
    "name", ["rate", "slide", "static", "sensitivity", "methods", "optimise", "flank"]
)
def test_every_command_says_for_itself_what_it_takes_and_gives(name):
    said = getattr(asperity, name).__doc__
    assert "; as :func:" not in said
    for section in ("Parameters", "Returns", "Raises"):
        assert f"{section}\n    ---" in said


def test_a_law_of_many_velocities_is_that_of_each_and_says_what_it_holds():
    law = asperity.homogenise(asperity.Model(BODY, CONTACT, SHAKEN, PERIODIC))
    velocities = np.array([[-3e-3, -1e-6, 0.0], [5e-4, 2e-3, 10.0]])
    forces = law(velocities)
    assert forces.shape == (2, 3)
    assert forces.tolist() == [[law(float(v)) for v in row] for row in velocities]
    assert law(np.empty(0)).shape == (0,)
    said = repr(law)
    assert "\n" not in said
    assert f"{law.velocity.size} mean velocities" in said
    assert "full friction 5.5 N" in said
    assert len(said) < 200


@pytest.mark.slow
def test_bodies_are_solved_by_the_dozen_whatever_the_method():
    models = [
        asperity.Model(BODY, CONTACT, SHAKEN.model_copy(update={"velocity_ratio": k}), PERIODIC)
        for k in (2.0, 4.0)
    ]
    found = asperity.solve_many(models)
    assert [one.ratio for one in found] == [asperity.solve(one).ratio for one in models]


def test_closed_forms_take_angles_with_their_unit():
    radians = directed_ratio(2.0, math.pi / 4.0)
    assert directed_ratio(2, "45 deg") == radians
    assert directed_ratio(2, theta="0.125 turn") == pytest.approx(radians, rel=1e-15)
    assert directed_ratio([1.0, 2.0], "45 deg").tolist()[1] == radians
    assert "theta is '45 kg'" in refusal(directed_ratio, 2.0, "45 kg")
    assert "theta is '45'" in refusal(directed_ratio, 2.0, "45")
    assert "k is '2'" in refusal(directed_ratio, "2", 0.0)


@pytest.mark.slow
def test_what_was_written_is_read(tmp_path):
    path = asperity.rate(GEARSET, OPERATION).save(tmp_path / "rate.nc")
    assert asperity.read(path).to_json()["bs721"]["M_w_Nm"] > 0.0


def test_gearsets_are_proposed_and_files_checked(tmp_path):
    found = asperity.size(40, "300 N m", "1500 rpm").found
    assert found[0].holds
    (tmp_path / "wrong.toml").write_text("[gearset]\nstarts = 0\n[x]\n")
    texts = [mistake.text for mistake in asperity.check(tmp_path / "wrong.toml")]
    assert "gearset.starts is 0; it must be at least 1" in texts
    assert len(texts) == 5
    assert not asperity.check("gearset-3")


@pytest.mark.parametrize(
    ("call", "given", "said"),
    [
        (asperity.rate, (), "nothing is given; name a case such as 'gearset-3'"),
        (asperity.rate, ("gearset-33",), "did you mean 'gearset-3'?"),
        (asperity.rate, (GEARSET,), "the tables given: the table [operation] is missing; add it"),
        (asperity.rate, (GEARSET, GEARSET), "[gearset] is given twice; keep one of them"),
        (asperity.rate, (GEARSET, 3), "3 is neither the name of a case, nor its file"),
        (asperity.slide, (BODY, SHAKEN), "the table [friction] is missing; add it"),
        (asperity.size, (40, 300, "1500 rpm"), "output_torque is 300; it must be a torque with"),
        (asperity.size, (40, "3 kg", "1500 rpm"), "output_torque is '3 kg'; it must be a torque"),
    ],
)
def test_what_cannot_be_used_is_one_line(call, given, said):
    assert said in refusal(call, *given)


def test_settings_are_a_list():
    said = "settings is 'gearset.starts=3'; it must be a list: ['gearset.starts=3']"
    assert said in refusal(asperity.rate, "gearset-3", settings="gearset.starts=3")


def test_settings_change_cases_and_not_tables():
    assert "model_copy" in refusal(asperity.rate, GEARSET, OPERATION, settings=["gearset.starts=3"])


def lines_of(text):
    return sum(max(1, -(-len(line) // 80)) for line in text.splitlines())


@pytest.mark.slow
def test_whatever_is_shown_takes_at_most_fifteen_lines():
    rated = asperity.rate("gearset-2")
    model = asperity.Model(BODY, CONTACT, SHAKEN, PERIODIC)
    result = asperity.solve(model)
    case = asperity.read("gearset-2")
    shown = (
        rated, rated.iso14521, rated.verdict, rated.geometry, rated.self_locking, case,
        *case.tables.values(), case["operation"].lubricant, case["gearset"].wheel_material,
        model, result, result.ledger, asperity.homogenise(model),
        asperity.size(40, "300 N m", "1500 rpm"), asperity.sensitivity("gearset-2"),
    )  # fmt: skip
    for thing in shown:
        assert lines_of(repr(thing)) <= 15, type(thing)
        assert " at 0x" not in repr(thing)


def test_a_table_is_shown_as_what_would_make_it_again():
    for table in (BODY, CONTACT, SHAKEN, GEARSET, OPERATION):
        again = eval(repr(table), {type(table).__name__: type(table)})
        assert again == table
