"""A rating by one way is the rating by every other: random worm gearsets, every safety.

The ways: the workbook calculated anew by a spreadsheet of its own, arrays of variants, the same
macro-geometry said by other keys, a duty cycle of equal parts for a life, and a valve's service
said by its torque.
"""

import importlib.util
import math
import random
import sys
from pathlib import Path

import numpy as np
import pytest

from asperity.errors import InputError
from asperity.gearset import Gearset
from asperity.rating import Operation, RatingOptions, rate, variants
from asperity.rating.spectrum import Spectrum
from asperity.rating.workbook import write_rating

FILE = Path(__file__).parents[1] / "unit" / "test_workbook.py"
SPEC = importlib.util.spec_from_file_location("workbooks", FILE)
workbooks = importlib.util.module_from_spec(SPEC)
sys.modules["workbooks"] = workbooks
SPEC.loader.exec_module(workbooks)

PARTS, EACH = 40, 10
OILS = ("ISO VG 220 mineral", "ISO VG 460 polyglycol", "ISO VG 220 polyalphaolefin")
WHEELS = ("CuSn12-C-GZ", "CuSn12Ni2-C-GZ", "CuAl10Fe5Ni5-C-GZ", "EN-GJL-250", "EN-GJS-400-15")
WORMS = ("case-hardened steel", "0.4C steel", "0.55C steel")


def gearset(rng):
    """Tables of a random gearset; some lie beyond an end of a table or a formula."""
    starts, module = rng.randint(1, 5), rng.choice([0.8, 1.0, 1.6, 2.5, 4.0, 6.3, 10.0])
    teeth, factor = rng.randint(20, 75), rng.uniform(6.0, 20.0)
    shift = rng.choice([0.0, rng.uniform(-0.5, 0.5)])
    size = 0.5 * module * (factor + teeth + 2.0 * shift)
    gears = {
        "starts": starts, "wheel_teeth": teeth, "axial_module": 1e-3 * module,
        "diameter_factor": factor, "centre_distance": 1e-3 * size,
        "pressure_angle": math.radians(rng.uniform(15.0, 29.0)),
        "worm_roughness": 1e-6 * rng.uniform(0.3, 1.6),
        "worm_material": rng.choice(WORMS), "wheel_material": rng.choice(WHEELS),
        "tooth_proportions": rng.choice(["bs721", "iso"]),
        "flank": rng.choice(["ZI", "ZA", "ZN", "ZK", "ZC"]),
    }  # fmt: skip
    torque = (size / 100.0) ** 3 * math.exp(rng.uniform(2.0, 7.0))
    run = {
        "worm_speed": math.exp(rng.uniform(math.log(5.0), math.log(400.0))),
        "output_torque": torque, "lubricant": rng.choice(OILS), "fan": rng.random() < 0.4,
        "immersed": rng.choice(["worm", "wheel"]), "lubrication": rng.choice(["bath", "spray"]),
        "starts_per_hour": rng.choice([0.0, 30.0]), "seals": rng.randint(0, 3),
        "application_factor": rng.choice([1.0, 1.25]),
    }  # fmt: skip
    if rng.random() < 0.3:
        run["oil_temperature"] = rng.uniform(300.0, 360.0)
    options = {"iso14521_edition": rng.choice(["1998", "2010"])}
    if rng.random() < 0.3:
        options["friction_factor"] = rng.uniform(0.3, 1.0)
    if rng.random() < 0.3:
        options["bs721_friction_angle"] = "mu_over_cos"
    return gears, run, options


def tables(gears, run, options):
    return Gearset(**gears, units="SI"), Operation(**run, units="SI"), RatingOptions(**options)


def safeties(found):
    return {safety.demand.path: safety.value for safety in found.verdict.safeties}


def same(one, other, seed, way):
    assert one.keys() == other.keys(), (seed, way)
    for path, value in one.items():
        assert other[path] == pytest.approx(value, rel=1e-9), (seed, way, path)


def other_macro(gears):
    """The same gearset by the profile shift in place of one of the other three."""
    m, q, a = (gears[key] for key in ("axial_module", "diameter_factor", "centre_distance"))
    shift = a / m - 0.5 * (q + gears["wheel_teeth"])
    for left_out in ("axial_module", "diameter_factor", "centre_distance"):
        kept = {key: value for key, value in gears.items() if key != left_out}
        yield {**kept, "profile_shift": shift}
    kept = {key: value for key, value in gears.items() if key != "diameter_factor"}
    yield {**kept, "worm_pitch_diameter": q * m}


def test_every_way_to_rate_two_gearsets_has_the_same_safeties(tmp_path):
    assert _tried(range(2), tmp_path) > 0


@pytest.mark.slow
@pytest.mark.campaign(
    over="part", tried_by="test_every_way_to_rate_two_gearsets_has_the_same_safeties"
)
@pytest.mark.parametrize("part", range(PARTS))
def test_every_way_to_rate_a_gearset_has_the_same_safeties(tmp_path, part):
    assert _tried(range(EACH * part, EACH * (part + 1)), tmp_path) > EACH // 2


def _tried(seeds, folder):
    """Try gearsets by their seeds; returns how many had an answer."""
    tried = 0
    for seed in seeds:
        rng = random.Random(seed)
        gears, run, options = gearset(rng)
        try:
            found = rate(*tables(gears, run, options))
        except InputError:
            continue
        mine = safeties(found)
        if not mine:
            continue
        tried += 1
        _by_workbook(found, folder, seed)
        _by_variants(gears, run, options, mine, rng, seed)
        for other in other_macro(gears):
            same(mine, safeties(rate(*tables(other, run, options))), seed, "macro")
        _by_parts(gears, run, options, rng, seed)
        _by_variants_of_a_duty(gears, run, options, random.Random(f"duty {seed}"), seed)
        valve = rate(*tables(gears, {**run, "service": "valve"}, options))
        said = {**run, "service": "valve", "through_travel_torque": run["output_torque"] / 3.0}
        same(safeties(valve), safeties(rate(*tables(gears, said, options))), seed, "service")
    return tried


def _by_workbook(found, folder, seed):
    path = write_rating(
        found.rating_inputs, found.tables_bs721, found.found, folder / f"{seed}.xlsx"
    )
    count, wrong = workbooks.differences(workbooks.Workbook(path), found)
    assert count > 0
    assert not wrong, seed
    path.unlink()


def _by_variants(gears, run, options, mine, rng, seed):
    speeds = np.array([run["worm_speed"], run["worm_speed"] * rng.uniform(0.8, 1.2)])
    many = variants(*tables(gears, run, options), worm_speed=speeds)
    for path, value in mine.items():
        assert many[path][0] == pytest.approx(value, rel=1e-9), (seed, "variants", path)


def _by_variants_of_a_duty(gears, run, options, rng, seed):
    """Hold parts that go through the formulas in rows to gearsets that are rated alone."""
    steps = [
        {
            "duration": 3600.0 * math.exp(rng.uniform(0.0, 9.0)),
            "output_torque": run["output_torque"] * rng.uniform(0.2, 1.0),
            "worm_speed": rng.choice([None, run["worm_speed"] * rng.uniform(0.5, 2.0)]),
            "starts_per_hour": rng.choice([None, rng.uniform(0.0, 60.0)]),
            "drives": rng.choice(["worm", "worm", "worm", "load"]),
        }
        for _ in range(rng.randint(2, 5))
    ]  # fmt: skip
    spectrum = Spectrum(step=steps, oil_temperature=rng.choice(["mean", "each"]), units="SI")
    gearset, _, option = tables(gears, run, options)
    operation = Operation(**run, spectrum=spectrum, units="SI")
    roughness = gears["worm_roughness"] * np.array([1.0, 1.7])
    many = variants(gearset, operation, option, worm_roughness=roughness)
    torques = variants(
        gearset, operation, option, ("agma6034",), worm_roughness=roughness, loads=False
    ) if "agma6034.safety_torque" in many else many  # fmt: skip
    assert torques is many or "agma6034.t_s_degC" not in torques
    for place, rough in enumerate(roughness):
        try:
            alone = safeties(
                rate(gearset.model_copy(update={"worm_roughness": rough}), operation, option)
            )
        except InputError:
            continue
        for path, value in alone.items():
            assert many[path][place] == pytest.approx(value, rel=1e-9), (seed, "duty", path)
        if "agma6034.safety_torque" in alone:
            assert torques["agma6034.safety_torque"][place] == many["agma6034.safety_torque"][place]


def _by_parts(gears, run, options, rng, seed):
    hours = rng.uniform(10.0, 30000.0)
    life = rate(*tables(gears, {**run, "life": 3600.0 * hours}, options))
    shares = [rng.uniform(0.1, 1.0) for _ in range(rng.randint(1, 4))]
    steps = [
        {"duration": 3600.0 * hours * share / sum(shares), "output_torque": run["output_torque"]}
        for share in shares
    ]
    cycle = rate(*tables(gears, {**run, "duty_cycle": steps}, options))
    same(safeties(life), safeties(cycle), seed, "duty cycle")
    # The same, said of parts with a speed of their own beside another speed of the operation.
    own = [step | {"worm_speed": run["worm_speed"]} for step in steps]
    other = {**run, "worm_speed": run["worm_speed"] * rng.uniform(0.5, 1.5), "duty_cycle": own}
    same(safeties(life), safeties(rate(*tables(gears, other, options))), seed, "speeds of parts")
