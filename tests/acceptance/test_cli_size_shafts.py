"""Shafts and bearings of a duty are among what ``size`` judges, as ``rate`` judges them."""

import copy
import json
import math

import pytest

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.files.shipped import case_file
from asperity.files.store import read_toml
from asperity.rating import rate_case
from asperity.runs import Run
from asperity.shafts.study import beside_rating
from asperity.start.duty import complete, duty
from asperity.start.gear import MACRO, proposals

RATIO = 50.0


def begun(**worm_bearing):
    """Return the duty of the actuator with shafts and 50 teeth, the worm's bearing A otherwise."""
    values = copy.deepcopy(duty("actuator-shafts"))
    for key in MACRO:
        values["gearset"].pop(key)
    values["gearset"]["wheel_teeth"] = 50
    values["worm_shaft"]["bearing"][0]["bearing"].update(worm_bearing)
    complete(values)
    return values


@pytest.fixture
def duty_file(tmp_path):
    """Return a duty file; the text of the case that ships, of its gearset the teeth alone."""
    text = case_file("actuator-shafts").read_text("utf-8")
    free = [key for key in MACRO if key != "wheel_teeth"]
    lines = [line for line in text.splitlines() if line.split(" = ")[0] not in free]
    path = tmp_path / "duty.toml"
    path.write_text("\n".join([*lines, "[requirements]", "ratio = 50"]), "utf-8")
    assert "gearset" in read_toml(path)
    return path


def changed(path, old, new):
    text = path.read_text("utf-8")
    assert old in text
    path.write_text(text.replace(old, new), "utf-8")


def rated(path):
    """Return the rating of a file with its shafts and bearings, as ``asperity rate`` has it."""
    case = read_case(path, case_tables())
    return beside_rating(case)(rate_case(case), Run())


@pytest.mark.slow
def test_every_proposal_has_the_verdict_of_its_rating_to_the_last_bit(asperity, duty_file):
    folder = duty_file.parent / "out"
    code, _, errors = asperity("size", str(duty_file), "--uncut", "--out", str(folder))
    assert code == 0, errors
    told = json.loads((folder / "size.json").read_text("utf-8"))["proposals"]
    assert told
    for place, one in enumerate(told, 1):
        own = rated(folder / f"proposal-{place}.toml")
        verdict = own.verdict.to_json()
        assert one["rows"] == verdict["rows"]
        margins = [s["value"] / s["asked"] for s in verdict["safeties"]]
        margins += [row.value / row.asked for row in own.rows]
        assert one["margin"] == min(margins)
        assert one["efficiency"] == own.iso14521["eta_ges"]
        assert one["holds"] == (min(margins) >= 1.0)


@pytest.mark.slow
def test_a_bearing_too_small_for_any_fails_every_proposal_and_is_named(asperity, duty_file):
    changed(duty_file, 'dynamic_rating = "36 kN"', 'dynamic_rating = "0.2 kN"')
    folder = duty_file.parent / "out"
    code, output, errors = asperity("size", str(duty_file), "--uncut", "--out", str(folder))
    assert code == 0, errors
    words = " ".join(output.split())
    assert words.startswith("None holds with its shafts and bearings; these come nearest")
    assert "whose shafts or bearings do not hold; nearest to it: worm bearing A by ISO 281" in words
    assert "the first one" not in words
    found = json.loads((folder / "size.json").read_text("utf-8"))["proposals"]
    assert found[0]["limited_by"] == "worm bearing A"
    assert not any(one["holds"] for one in found)


def worth(found):
    return {
        (p.centre_distance_mm, p.starts, p.wheel_teeth, p.axial_module_mm, p.diameter_factor)
        for p in found
    }


@pytest.mark.parametrize(
    "rating",
    [
        pytest.param("4 kN", marks=pytest.mark.slow),
        "1.5 kN",
        pytest.param("0.9 kN", marks=pytest.mark.slow),
    ],
)
def test_those_that_are_judged_last_are_those_that_nothing_beats(monkeypatch, rating):
    """Judging only what nothing else beats finds what judging every one would find."""
    from asperity.studies import proposals as room

    values = begun(dynamic_rating=rating)
    quick = proposals(values, RATIO)

    def slowly(kept, margins, best, judges, least, known=None):
        rows = {int(n): judges.borne(judges.keys(n)) for n in kept}
        for n, own in rows.items():
            margins[n] = min(margins[n], *(row.value / row.asked for row in own.rows))
        left = kept if least is None else kept[margins[kept] >= least]
        return room.Chosen(best(left) if len(left) else left, rows, 0, (), {})

    monkeypatch.setattr(room, "choose", slowly)
    assert worth(proposals(values, RATIO).found) == worth(quick.found)
    assert all(p.holds for p in quick.found)
    assert rating == "4 kN" or any("do not hold" in note for note in quick.notes)


@pytest.mark.slow
def test_a_shaft_that_cannot_be_judged_is_refused_as_rate_refuses_it(asperity, duty_file):
    tandem = 'arrangement = "pair tandem"\ncarries = "away"'
    changed(duty_file, 'arrangement = "pair back-to-back"', tandem)
    code, _, errors = asperity("size", str(duty_file), "--uncut")
    assert code == 2
    assert "no bearing carries the axial force" in errors
    assert len(errors.strip().splitlines()) == 1


def test_a_duty_without_shafts_says_nothing_of_them(asperity):
    found = proposals(duty_without_shafts(), RATIO)
    assert not any(p.rows for p in found.found)
    assert "rows" not in found.to_json()["proposals"][0]
    assert len(found.tables()) == 2


def duty_without_shafts():
    values = begun()
    for table in ("worm_shaft", "wheel_shaft", "bearings"):
        values.pop(table)
    return values


def test_what_is_not_given_of_shafts_is_told_with_the_proposals():
    values = begun()
    assert not any("not given" in note for note in proposals(values, RATIO).notes)
    values.pop("wheel_shaft")
    values["worm_shaft"].pop("material")
    said = "not given: wheel shaft, steel of the worm shaft"
    assert said in proposals(values, RATIO).notes


@pytest.mark.slow
def test_a_margin_that_is_asked_for_counts_for_shafts_too():
    values = begun(dynamic_rating="4 kN")
    free = proposals(values, RATIO).found[0]
    life = next(row for row in free.rows if row.name == "worm bearing A")
    safety = math.nextafter(life.value / life.asked, math.inf)
    values["requirements"] = {"safety": f"{safety:.9g}"}
    assert "worm bearing A" not in {p.limited_by for p in proposals(values, RATIO).found if p.holds}


SHELF = """
[source.maker]
name = "invented"
confidence = "own choice"
"""
BEARING = """
[bearing."{name}"]
kind = "{kind}"
bore = "{bore} mm"
outside_diameter = "{outside} mm"
width = "16 mm"
dynamic_rating = "{c} kN"
static_rating = "{c0} kN"
from = {{ "*" = "maker" }}
{more}
"""
ANGLE = 'contact_angle = "40 deg"'


def of_shelf(name, kind, outside, c, c0, more="", bore=30):
    return BEARING.format(name=name, kind=kind, outside=outside, c=c, c0=c0, more=more, bore=bore)


@pytest.mark.slow
def test_the_smallest_bearing_of_the_shelf_that_does_stands_where_none_is_named(
    asperity, duty_file
):
    folder = duty_file.parent
    shelf = SHELF + "".join(
        (
            of_shelf("large", "angular contact", 72, 60, 40, ANGLE),
            of_shelf("right", "angular contact", 62, 36, 26, ANGLE),
            # One that bears the running, but not what the peak puts on it at rest.
            of_shelf("soft", "angular contact", 58, 36, 0.5, ANGLE),
            of_shelf("small", "angular contact", 55, 0.4, 26, ANGLE),
            of_shelf("wide bore", "angular contact", 52, 36, 26, ANGLE, bore=32),
            of_shelf("no pair", "cylindrical", 47, 36, 26),
        )
    )
    (folder / "shelf.toml").write_text(shelf, "utf-8")
    text = duty_file.read_text("utf-8")
    first, rest = text.split("[worm_shaft.bearing.bearing]", 1)
    rest = rest.partition("\n\n")[2]
    second, rest = rest.split("[worm_shaft.bearing.bearing]", 1)
    rest = rest.partition("\n\n")[2]
    asked = '[requirements]\nbearings = "own"'
    duty_file.write_text((first + second + rest).replace("[requirements]", asked), "utf-8")
    command = ("--materials", str(folder / "shelf.toml"), "size", str(duty_file), "--uncut")
    code, output, errors = asperity(*command, "--out", str(folder / "out"))
    assert code == 0, errors
    assert "Bearings of the shelf" in output
    told = json.loads((folder / "out" / "size.json").read_text("utf-8"))["proposals"]
    for one in told:
        assert one["holds"]
        assert list(one["bearings"].values()) == ["right", "no pair"]
    code, output, errors = asperity(
        "--materials", str(folder / "shelf.toml"), "rate", str(folder / "out" / "proposal-1.toml"),
        "--json",
    )  # fmt: skip
    assert code == 0, errors
    assert json.loads(output)["verdict"]["rows"] == told[0]["rows"]
    # Where nothing does, the one that comes nearest is named.
    code, output, errors = asperity(*command, "--json", "--set", "requirements.safety=1e2")
    found = json.loads(output)["proposals"]
    assert not any(one["holds"] for one in found)
    (folder / "shelf.toml").write_text(SHELF, "utf-8")
    code, _, errors = asperity(*command)
    assert code == 2
    assert 'requirements.bearings is "own", but no data file has a bearing' in errors
    (folder / "shelf.toml").write_text(SHELF + of_shelf("a", "cylindrical", 47, 36, 26), "utf-8")
    code, _, errors = asperity(*command)
    assert code == 2
    assert "worm_shaft.bearing at 30 mm names none, and of the 1 of data files none has" in errors
    assert len(errors.strip().splitlines()) == 1


@pytest.mark.slow
def test_optimise_keeps_what_shafts_and_bearings_bear(asperity):
    case = ("actuator-shafts", "--set", "worm_shaft.peak=15")
    code, output, errors = asperity("optimise", *case, "--json")
    assert code == 0, errors
    told = json.loads(output)
    for design in ("given", "optimum", "made"):
        assert all(row["holds"] for row in told["rows"][design]), design
    # Nearly all of what the worm's shaft has to spare is used up, and some of the efficiency lost.
    least = next(row for row in told["rows"]["optimum"] if row["name"] == "worm shaft")
    assert least["safety"] == pytest.approx(1.2, rel=1e-6)
    (note,) = (note for note in told["notes"] if note.startswith("shafts and bearings are kept"))
    without = float(note.split()[-2])
    assert told["given"]["iso14521"]["eta_z1_2"] < told["optimum"]["iso14521"]["eta_z1_2"]
    assert 100.0 * told["optimum"]["iso14521"]["eta_z1_2"] < without
    assert any("bounds are assumed" in note for note in told["notes"])


@pytest.mark.slow
@pytest.mark.parametrize("life", ["9e6 h", "1.05e7 h"])
def test_optimise_finds_another_pressure_angle_where_a_bearing_asks_for_it(asperity, life):
    # No thicker worm saves the wheel's bearing, which a steep flank loads: 1.01e7 h as it is.
    case = ("actuator-shafts", "--set", f"bearings.life={life}")
    code, output, errors = asperity("optimise", *case, "--json")
    assert code == 0, errors
    told = json.loads(output)
    for design in ("optimum", "made"):
        assert all(row["holds"] for row in told["rows"][design]), design
    active = [limit["key"] for limit in told["constraints"] if limit["active"]]
    assert "wheel bearing A (ISO 281)" in active
    assert told["given"]["iso14521"]["eta_z1_2"] < told["made"]["iso14521"]["eta_z1_2"]
    settings = [word for setting in told["made_settings"] for word in ("--set", setting)]
    code, output, errors = asperity("rate", *case, *settings, "--json")
    assert code == 0, errors
    assert all(row["holds"] for row in json.loads(output)["verdict"]["rows"])


@pytest.mark.slow
def test_optimise_tells_what_shafts_and_bearings_come_to_with_its_design(asperity, tmp_path):
    case = ("actuator-shafts", "--set", "worm_shaft.peak=20")
    code, output, errors = asperity("optimise", *case, "--free", "worm_roughness", "--json")
    assert code == 0, errors
    told = json.loads(output)
    code, output, errors = asperity("rate", *case, "--json")
    assert told["rows"]["given"] == json.loads(output)["verdict"]["rows"]
    settings = [word for setting in told["made_settings"] for word in ("--set", setting)]
    code, output, errors = asperity("rate", *case, *settings, "--json")
    assert code == 0, errors
    made = json.loads(output)["verdict"]["rows"]
    assert [row["name"] for row in told["rows"]["made"]] == [row["name"] for row in made]
    for own, rated in zip(told["rows"]["made"], made, strict=True):
        key = "life_h" if "life_h" in own else "safety"
        assert own[key] == pytest.approx(rated[key], rel=1e-9)
    failing = [row["name"] for row in made if not row["holds"]]
    assert failing
    for name in failing:
        assert any(note.startswith(name) and "does not hold" in note for note in told["notes"])
