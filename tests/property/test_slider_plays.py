"""Fits, comparisons and branches of bodies by lot, beside the plain way of `apparatus.plain_body`.

What has not settled is marked: it is no best, no saving and no prediction. What is not marked is
where the plain way is, which marches on for as long as it takes.
"""

import json
import math
import re

import numpy as np
import pytest
from apparatus.bodies import lots
from apparatus.plain_body import solved

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.errors import AsperityError
from asperity.runs import Run
from asperity.slider import Model, solve
from asperity.start.compare import compare
from asperity.sweep import branches
from asperity.tribometer.fit.study import answer, prepare

BAR = 2e-3
STEADY = 1e-3  # that halves of a window may differ by; cycles that repeat may make them differ more
LONG = 800  # cycles, of the plain way
FEW = 200  # cycles, of the plain way of what is measured
MOST = 12800  # cycles, of the plain way of what is fitted
RATIOS = (0.6, 1.5, 3.0)


def case_of(lot, folder, name, **solved_by):
    """Return a body by lot as a case, of a file in a folder where the samples lie."""
    lot.model(folder)
    tables = lot.tables | {"solve": lot.tables["solve"] | solved_by}
    path = folder / f"{name}.toml"
    path.write_text(lot._replace(tables=tables).toml())
    return read_case(path, case_tables())


def plain_ratio(model, cycles):
    """Mean of the last fifth of so many cycles by the plain way, and by how much steps change."""
    found = solved(model, cycles, max(cycles // 5, 4))
    return found.ratio, found.error


def compared(seed, folder, beside):
    """Compare two or three bodies; yield what is wrong with what the JSON and the tables say.

    Those that were held beside the plain way are added to ``beside``, here and below.
    """
    rng = np.random.default_rng(seed)
    drawn = lots(int(rng.integers(1 << 30)), int(rng.integers(2, 4)), folder)
    cases = [case_of(lot, folder, f"body-{n}") for n, lot in enumerate(drawn)]
    answers = []

    def slid(_, case):
        answers.append(solve(Model.from_case(case), history=False))
        return answers[-1]

    try:
        found = compare(cases, slid)
    except AsperityError:
        return
    told = json.loads(json.dumps(found.to_json(), allow_nan=False))
    headings = [str(column.heading) for column in found.tables()[1].columns][2:]
    remarks = [str(each) for each in found.tables()[1].remarks]
    for n, (lot, one) in enumerate(zip(drawn, answers, strict=True)):
        if told["settled"][n] is not one.settled:
            yield n, "settled in JSON", told["settled"], lot.toml()
        marked = any(remark.startswith(f"* {found.cases[n]}: Not settled") for remark in remarks)
        if one.settled is headings[n].endswith(" *") or one.settled is marked:
            yield n, "marked", headings, remarks, lot.toml()
        ratios = told["results"].get("ratio")
        if ratios is not None and ratios[n] != one.ratio:
            yield n, "ratio", ratios, one.ratio, lot.toml()
        if one.settled:
            beside.append(n)
            plain, error = plain_ratio(one.model, lot.cycles + LONG)
            more = error + 2.0 * (one.step_error or 0.0) + min(one.residual, STEADY)
            if abs(plain - one.ratio) > BAR + more:
                yield n, "plain way", one.ratio, plain, error, one.notes, lot.toml()


def test_a_comparison_marks_what_has_not_settled(tmp_path):
    beside = []
    assert not list(compared((1, 0), tmp_path, beside))
    assert len(beside) == 2


@pytest.mark.slow
@pytest.mark.campaign(tried_by="test_a_comparison_marks_what_has_not_settled")
@pytest.mark.parametrize("part", range(10))
def test_comparisons_mark_what_has_not_settled(tmp_path, part):
    beside = []
    assert not [wrong for n in range(12) for wrong in compared((2, part, n), tmp_path, beside)]
    assert beside


def measured(rng, folder):
    """Return a body by lot, and its ratios by the plain way at some velocity ratios."""
    (lot,) = lots(int(rng.integers(1 << 30)), 1, folder, models=("dahl",), pressed=False)
    lot.tables["vibration"].pop("start", None)
    rows = []
    # With asperities that come to their limit soon the plain way need not take long.
    lot.tables["friction"]["exponent"] = 1.0
    for ratio in RATIOS:
        tables = lot.tables | {"vibration": lot.tables["vibration"] | {"velocity_ratio": ratio}}
        model = lot._replace(tables=tables).model(folder)
        rows.append((ratio, plain_ratio(model, FEW)[0]))
    return lot, rows


def steady_ratio(model):
    """Mean by the plain way when twice the cycles have the same, how far off, and by steps.

    From where the drive is stretched and the asperities are bent on; nothing where that or the
    rest takes too long.
    """
    friction, slider = model.friction, model.slider
    way = friction.max_deflection + model.full_friction / (slider.drive_stiffness or math.inf)
    cycles = FEW + math.ceil(2.0 * way * model.frequency / slider.drive_velocity)
    plain = math.inf
    while cycles <= MOST:
        later, error = plain_ratio(model, cycles)
        if abs(later - plain) <= STEADY:
            return later, abs(later - plain), error
        plain, cycles = later, 2 * cycles
    return None


def fitted(seed, folder, beside):
    """Fit two parameters to what the plain way measures; yield what is wrong with the answer.

    A fit that is refused is none; predictions that the plain way takes too long for are not held.
    """
    rng = np.random.default_rng(seed)
    lot, rows = measured(rng, folder)
    sd = 5e-3
    noise = sd * rng.normal(size=len(rows))
    path = folder / "data.csv"
    lines = [f"{k},{ratio + off},{sd}" for (k, ratio), off in zip(rows, noise, strict=True)]
    path.write_text("\n".join(["vibration.velocity_ratio,ratio,sd", *lines]))
    case = case_of(lot, folder, "fitted")
    free = "friction.max_deflection,friction.mu"
    try:
        found = answer(prepare(case, data=str(path), free=free), Run())
    except AsperityError:
        return
    told = json.loads(json.dumps(found.to_json(), allow_nan=False))
    loose = {row["row"] for row in told["failed"] if row["row"] is not None}
    kept = [n for n in range(len(rows)) if n + 2 not in loose]
    if len(kept) != told["points"]:
        yield "rows", told["failed"], told["points"], lot.toml()
        return
    # What is predicted is where the plain way with the fitted parameters comes to.
    given = {one["key"].partition(".")[2]: one["value"] for one in told["parameters"]}
    friction = lot.tables["friction"] | {
        "max_deflection": f"{given['max_deflection']!r} m", "mu": given["mu"]
    }  # fmt: skip
    for n, left in zip(kept, told["residuals"], strict=True):
        k, ratio = rows[n]
        vibration = lot.tables["vibration"] | {"velocity_ratio": k}
        tables = lot.tables | {"friction": friction, "vibration": vibration}
        model = lot._replace(tables=tables).model(folder)
        predicted = ratio + noise[n] - left * sd
        if (there := steady_ratio(model)) is None:
            continue
        beside.append(k)
        plain, unsteady, error = there
        if abs(plain - predicted) > BAR + 2.0 * (error + unsteady):
            yield k, predicted, plain, error, unsteady, lot.toml()
    # And what is left out is told with its reason.
    for row in told["failed"]:
        if not row["why"]:
            yield "no reason", row, lot.toml()


def test_a_fit_predicts_as_the_plain_way_does(tmp_path):
    beside = []
    assert not list(fitted((1, 1), tmp_path, beside))
    assert beside == list(RATIOS)


@pytest.mark.slow
@pytest.mark.campaign(tried_by="test_a_fit_predicts_as_the_plain_way_does")
@pytest.mark.parametrize("part", range(6))
def test_fits_predict_as_the_plain_way_does(tmp_path, part):
    beside = []
    assert not [wrong for n in range(4) for wrong in fitted((2, part, n), tmp_path, beside)]
    assert beside


def branched(seed, folder, beside):
    """Follow a body along its velocity ratio and back; yield states that are not as they are told.

    A body by the plain way comes from rest: it is in one of the two states that stay, if both were
    found, or in one that is told of a body from rest alone.
    """
    rng = np.random.default_rng(seed)
    (lot,) = lots(int(rng.integers(1 << 30)), 1, folder, models=("dahl", "lugre"))
    lot.tables["vibration"].pop("start", None)
    case = case_of(lot, folder, "followed", method="periodic")
    values = [0.7, 1.1, 1.8, 3.0]
    axis = f"vibration.velocity_ratio={','.join(map(str, values))}"
    try:
        found = branches.answer(branches.prepare(case, over=[axis]), Run())
    except AsperityError:
        return
    told = json.loads(json.dumps(found.to_json(), allow_nan=False))
    if told.get("ratio") is None:
        return
    for way, table in enumerate(found.tables()):
        for place, row in enumerate(table.rows):
            loose = told["settled"][way][place] == 0.0
            if str(row[1]).endswith(" *") is not loose:
                yield way, place, "marked", [str(cell) for cell in row], lot.toml()
    for place, value in enumerate(values):
        both = [told["ratio"][way][place] for way in (0, 1)]
        rest = told.get("ratio_from_rest", [None] * len(values))[place]
        stays = [told["settled"][way][place] == 1.0 for way in (0, 1)]
        if not all(stays):
            continue
        vibration = lot.tables["vibration"] | {"velocity_ratio": value}
        model = lot._replace(tables=lot.tables | {"vibration": vibration}).model(folder)
        plain, error = plain_ratio(model, LONG)
        later, _ = plain_ratio(model, 2 * LONG)
        unsteady = abs(later - plain) * max(lot.tables["friction"].get("exponent", 1.0), 1.0)
        if unsteady > BAR:
            continue
        beside.append(value)
        more = error + 2.0 * unsteady
        more += 2.0 * max(told["step_error"][way][place] or 0.0 for way in (0, 1))
        known = [*both, *([] if rest is None else [rest])]
        # Where it has come to no state yet, its ratio on the way is told.
        on_its_way = rf"it has (?:.*, )?([\d.]+) at vibration\.velocity_ratio={value}[,;]"
        told_of = [re.search(on_its_way, note) for note in told.get("notes", ())]
        known += [float(one[1]) for one in told_of if one]
        if min(abs(later - ratio) for ratio in known) > BAR + more:
            yield value, known, plain, later, error, told.get("notes"), lot.toml()


@pytest.mark.slow
@pytest.mark.campaign
@pytest.mark.parametrize("part", range(24))
def test_bodies_are_in_states_that_their_branches_have(tmp_path, part):
    beside = []
    assert not list(branched((2, part, 0), tmp_path, beside))
    if not beside:
        pytest.skip("of this body nothing has settled that could be compared")


def test_the_plain_way_knows_a_ratio_on_paper(tmp_path):
    """Rigid friction along the drive: :math:`(2/\\pi)\\arcsin(1/k)`."""
    (lot,) = lots(9, 1, tmp_path, models=("coulomb",), pressed=False)
    vibration = lot.tables["vibration"] | {
        "waveform": "sine", "direction": "0 deg", "velocity_ratio": 2.0, "applied_to": "base",
    }  # fmt: skip
    vibration.pop("rise_time", None)
    vibration.pop("samples", None)
    slider = {k: v for k, v in lot.tables["slider"].items() if not k.startswith("drive_s")}
    slider.pop("drive_damping", None)
    tables = lot.tables | {"vibration": vibration, "slider": slider | {"lateral": "guided"}}
    plain, _ = plain_ratio(lot._replace(tables=tables).model(tmp_path), 20)
    assert plain == pytest.approx(2.0 / math.pi * math.asin(0.5), abs=2e-3)
