"""An optimum and a sensitivity keep what `[requirements]` asks, as sizing does."""

import math
import random

import pytest

import asperity
from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.errors import InputError
from asperity.rating.rate import rate_case
from asperity.runs import Run
from asperity.studies import optimise, sensitivity


def case_of(name="actuator-duty", *settings):
    return read_case(name, case_tables(), settings)


def optimum(case):
    return optimise.answer(optimise.prepare(case), Run())


def designs(best):
    return [best.after, *([best.made] if best.made else [])]


def tip_diameter(rated):
    g = rated.geometry
    return g.axial_module * (g.wheel_teeth + 2.0 * g.profile_shift + 2.0)


def reach(rated):
    """The chord that the line of the worm's tip cuts from the wheel's outside circle."""
    g = rated.geometry
    outside = 0.5 * (tip_diameter(rated) + g.axial_module)
    return 2.0 * math.sqrt(outside**2 - (g.centre_distance - 0.5 * g.worm_tip_diameter) ** 2)


def breaks(case, rated):
    """What a design breaks of a case's requirements, by the rating of that design alone."""
    asked = {name: getattr(case.require(REQUIREMENTS), name) for name in REQUIREMENTS.model_fields}
    broken = []
    for one in rated.self_locking:
        if one.state == "static":
            over = one.friction / one.limit
            if asked["self_locking"] == "wanted" and over < asked["locking_margin"]:
                broken.append(f"{one.standard} {over}")
            if asked["self_locking"] == "avoided" and over * asked["locking_margin"] >= 1.0:
                broken.append(f"{one.standard} {over}")
    if asked["wheel_diameter"] and tip_diameter(rated) > 1e3 * asked["wheel_diameter"]:
        broken.append("wheel")
    if asked["worm_length"] and reach(rated) > 1e3 * asked["worm_length"]:
        broken.append("worm")
    if any(s.value < asked["safety"] * s.demand.asked for s in rated.verdict.safeties):
        broken.append("safety")
    return broken


REQUIREMENTS = case_tables()["requirements"]


@pytest.mark.slow
@pytest.mark.parametrize(
    "settings",
    [
        (),
        ("requirements.locking_margin=1.1",),
        ("requirements.wheel_diameter=166.5 mm",),
        ("requirements.worm_length=73 mm", "requirements.self_locking=any"),
        ("requirements.safety=1.6", "requirements.self_locking=any"),
    ],
)
def test_the_best_design_keeps_what_is_required(settings):
    case = case_of("actuator-duty", *settings)
    best = optimum(case)
    assert [breaks(case, design) for design in designs(best)] == [[]] * len(designs(best))
    assert any("kept as [requirements] has it" in note for note in best.notes)


@pytest.mark.slow
def test_what_is_required_holds_the_best_design_back():
    free = optimum(case_of("actuator-duty", "requirements.self_locking=any"))
    held = optimum(case_of())
    assert held.after.iso14521["eta_z1_2"] < free.after.iso14521["eta_z1_2"]
    assert breaks(case_of(), free.after)
    assert "requirements.self_locking.iso14521.room" in {limit.key for limit in held.active}


@pytest.mark.slow
def test_the_trade_off_keeps_it_too():
    case = case_of("actuator-duty", "requirements.wheel_diameter=166.5 mm")
    numbers = optimum(case).curve.numbers
    teeth = 50 + 2.0 * numbers["profile_shift"] + 2.0
    assert max(numbers["axial_module_mm"] * teeth) <= 166.5


@pytest.mark.slow
@pytest.mark.parametrize(
    ("settings", "said"),
    [
        (("requirements.self_locking=avoided",), "self-locking avoided, which no design within"),
        (
            ("requirements.ratio=40",),
            r"requirements\.ratio is 40 within 3 %, and the gearset has 50",
        ),
        (("requirements.centre_distance=90 mm",), r"is 90 mm, and the gearset has 100 mm"),
        (("requirements.safety=50",), "safeties 50 times what is asked, which no design within"),
    ],
)
def test_what_no_design_keeps_is_refused_in_one_line(settings, said):
    with pytest.raises(InputError, match=said):
        optimum(case_of("actuator-duty", *settings))


def random_case(seed):
    """A gearset of the series for a load drawn at random, with requirements drawn at random."""
    rng = random.Random(seed)
    torque, speed = 10 ** rng.uniform(1.3, 3.0), 10 ** rng.uniform(2.6, 3.3)
    ratio = rng.choice([10, 15, 20, 30, 40, 50])
    wanted = rng.choice(["any", "wanted", "avoided"])
    asked = [
        f"requirements.self_locking={wanted}",
        f"requirements.locking_margin={rng.choice([1.0, 1.05, 1.2])}",
        f"requirements.ratio_tolerance={rng.choice([1, 3, 8])} %",
        f"requirements.ratio={ratio * rng.uniform(0.98, 1.02):.4g}",
        f"requirements.centre_distance={rng.choice([160, 250, 500])} mm",
        f"requirements.safety={rng.choice([1.0, 1.2])}",
    ]
    lubricant = "operation.lubricant=ISO VG 220 polyglycol"
    try:
        found = asperity.size(
            None, f"{torque} N m", f"{speed} rpm", settings=[lubricant, *asked], cut=False
        )
    except InputError:
        return None, []
    proposal = rng.choice(found.found)
    if proposal.starts > 4:
        return None, []
    asked.append(
        f"requirements.wheel_diameter={rng.uniform(1.6, 1.95) * proposal.centre_distance_mm} mm"
    )
    settings = [
        *proposal.settings, *asked, lubricant, "gearset.name=drawn",
        f"operation.output_torque={torque} N m",
        f"operation.through_travel_torque={torque} N m", f"operation.worm_speed={speed} rpm",
    ]  # fmt: skip
    return proposal, settings


def refused_or(case):
    try:
        return optimum(case)
    except InputError as refused:
        return str(refused)


def check(seed):
    """Return whether a drawn gearset had an optimum; it breaks nothing."""
    proposal, settings = random_case(seed)
    if proposal is None:
        return False
    case = case_of("gearset-3", "gearset.diameter_factor=10", *settings)
    wanted = case.require(REQUIREMENTS)
    off = abs(proposal.wheel_teeth / proposal.starts / wanted.ratio - 1.0)
    assert off <= wanted.ratio_tolerance * (1 + 1e-9)
    assert proposal.centre_distance_mm <= 1e3 * wanted.centre_distance
    best = refused_or(case)
    if isinstance(best, str):
        assert "[requirements] asks for" in best
        return False
    for design in designs(best):
        broken = breaks(case, design)
        # A safety of 1 asks nothing of a gearset that has less as it is.
        assert broken == [] or (broken == ["safety"] and wanted.safety == 1.0)
    return True


@pytest.mark.slow
def test_no_optimum_of_a_random_gearset_breaks_a_requirement():
    assert sum(check(seed) for seed in range(4)) >= 1


@pytest.mark.slow
@pytest.mark.campaign(tried_by="test_no_optimum_of_a_random_gearset_breaks_a_requirement")
def test_no_optimum_of_random_gearsets_breaks_a_requirement():
    assert sum(check(seed) for seed in range(4, 40)) >= 6


@pytest.mark.slow
def test_a_sensitivity_tells_where_a_rise_breaks_a_requirement():
    case = case_of()
    found = sensitivity.answer(sensitivity.prepare(case), Run())
    # Locking needs tan(gamma) = z_1/q at most; a larger ratio has fewer starts and locks more.
    assert "self_locking.iso14521" not in found["diameter_factor"].broken_above
    tight = case_of("actuator-duty", "requirements.wheel_diameter=170 mm")
    found = sensitivity.answer(sensitivity.prepare(tight), Run())
    rise = found["axial_module"].broken_above.get("wheel_diameter")
    # With the centre distance as it is, m (z_2 + 2 x + 2) = 2 a - m (q - 2) falls with the module.
    assert rise is None
    rise = found["centre_distance"].broken_above["wheel_diameter"]
    # 2 a - m (q - 2) = 170 mm
    assert 100.0 * (1.0 + rise) == pytest.approx(0.5 * (170.0 + 3.15 * 10.5), rel=1e-6)
    remarks = " ".join(found.tables()[1].remarks)
    assert "requirements.wheel_diameter is no longer kept" in remarks
    data = found.to_json()["inputs"]["centre_distance"]
    assert data["broken_above_percent"]["wheel_diameter"] == pytest.approx(100.0 * rise)


def test_a_sensitivity_without_requirements_says_nothing_of_them():
    found = sensitivity.answer(sensitivity.prepare(case_of("gearset-2")), Run())
    assert all(not one.broken_above for one in found.influences)


def test_the_rating_of_the_case_is_what_is_compared():
    assert breaks(case_of(), rate_case(case_of())) == []
