"""What people are shown in another language is the answer, with all its numbers."""

import functools
import re
import tomllib

import numpy as np
import pytest
from apparatus.grid import slow
from matplotlib.figure import Figure

from asperity.casefile.project import Project
from asperity.commands.listed import COMMANDS
from asperity.commands.shown import shown_as
from asperity.errors import InputError
from asperity.files.shipped import shipped_cases
from asperity.flanks.measuring.corners import Corner, Offset, Side, corner_table
from asperity.python import size
from asperity.results.language import Catalogue, catalogue_of, languages, said, spoken
from asperity.results.report import Heading
from asperity.results.table import Table
from asperity.results.terminal import rendered
from asperity.results.unit_systems import shown_in, shown_table, shown_text
from asperity.results.words import Number, Sentence
from asperity.runs import Run

FOUND = {
    "holds by {standards}": "hält nach {standards}",
    "wear of {what}": "{what}verschleiß",
    "wheel": "Rad",
    "and": "und",
    "{a} of the {b} asked": "von {b} sind {a} da",
    "{_name}, rated": "{_name}, gerechnet",
    "{what} is {_a}; {_s} is valid to {_b}": "{what} ist {_a}; {_s} gilt bis {_b}",
}


@pytest.fixture(autouse=True)
def undrawn(monkeypatch):
    """Pictures are given their words; drawing them takes longest and says nothing of these."""
    monkeypatch.setattr(Figure, "savefig", lambda *_, **options: None)


@pytest.fixture
def words():
    return Catalogue(FOUND, code="xx")


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("wear of wheel", "Radverschleiß"),
        ("holds by ISO/TR 14521 and BS 721", "hält nach ISO/TR 14521 und BS 721"),
        ("lifting gear 3, rated", "lifting gear 3, gerechnet"),
        ("wear of wheel; wheel is 3; ISO is valid to 2; wheel",
         "Radverschleiß; Rad ist 3; ISO gilt bis 2; Rad"),
        (" wheel.", " Rad."),
        ("S_W 1.53", "S_W 1.53"),
        # What has no line is kept whole, rather than half of it in each language.
        ("wear of axle", "wear of axle"),
        ("wheel and axle", "wheel and axle"),
    ],
)  # fmt: skip
def test_a_text_is_shown_by_its_line(words, text, shown):
    with spoken(words):
        assert said(text) == shown
    assert said(text) == text
    assert words.missing == ({text} if shown == text and "axle" in text else set())


def test_numbers_of_a_sentence_keep_digits_and_keys_where_they_change_places(words):
    text = Sentence(Number.of(1.53, ".3g", "S"), " of the ", Number.of(1.1, "g", "asked"), " asked")
    with spoken(words):
        shown = said(text)
    assert shown == "von 1.1 sind 1.53 da"
    numbers = [part for part in shown.parts if isinstance(part, Number)]
    assert [(one.value, one.key) for one in numbers] == [(1.1, "asked"), (1.53, "S")]


@functools.cache
def answer_of(case, *settings, command="rate"):
    found = next(one for one in COMMANDS if one.name == command)
    options = {option.name: option.default for option in found.options}
    read = found.case_of(case, settings, **options)
    return read, found.solved(found.prepared(read, **options), Run())


CASES = [
    ("gearset-2",), ("gearset-3",), ("actuator-duty",), ("actuator-shafts",),
    ("actuator-duty", "tolerances.centre_distance=js7", "tolerances.thread=['-40 um','-70 um']",
     "tolerances.tooth=['-50 um','-100 um']"),
    ("gearset-3", "operation.worm_speed=6000 rpm", "operation.oil_temperature=95 degC",
     "gearset.hand=left"),
]  # fmt: skip
# What all of them have these have.
FEW_CASES = [case if case in CASES[3:] else slow(case) for case in CASES]


@pytest.mark.slow
@pytest.mark.parametrize("given", FEW_CASES, ids=" ".join)
def test_the_german_screen_and_report_of_a_rating_leave_nothing_english(given):
    case, result = answer_of(*given)
    german = catalogue_of("de")
    german.missing.clear()
    with spoken(german):
        screen = result.brief()
        rendered(result.tables())
        report = result.to_html(Heading.of(case))
    # A gearset is called what its case calls it.
    assert german.missing <= {result.gearset.name}
    assert '<html lang="de">' in report
    assert "Urteil" in report
    assert max(map(len, screen.splitlines())) <= 79
    assert result.brief() != screen


ENGLISH_WORDS = re.compile(r"\b(?:the|of|and|with|for|which|loads?|rated|if|else|is|it)\b")
RAW = {name: tomllib.loads(path.read_text("utf-8")) for name, path in shipped_cases().items()}
DUTIES = [
    (case, command, settings)
    for case, raw in RAW.items()
    if "operation" in raw and ("spectrum" in raw or "duty_cycle" in raw["operation"])
    for command, settings in (
        ("rate", ()),
        ("rate", ("tolerances.fit=C", "tolerances.centre_distance=js7")),
        ("rexs", ()),
        *((("shafts", ("worm_shaft.load=[{at='2 mm', radial='3000 N'}]",)),
           ("shafts", ("worm_shaft.bearing=[{at='24 mm', carries='both'}, {at='186 mm'}]",)),
           ("rate", ("worm_shaft.bearing=[{at='8 mm', carries='both'}, {at='45 mm'}]",)))
          if "worm_shaft" in raw else ()),
    )
]  # fmt: skip


def test_the_shipped_duties_are_looked_at():
    assert {case for case, *_ in DUTIES} >= {"actuator-duty", "actuator-shafts"}


@pytest.mark.slow
@pytest.mark.parametrize(
    "given", [slow(one) if one[1] == "rexs" or not one[2] else one for one in DUTIES], ids=str
)
def test_german_of_every_shipped_duty_leaves_nothing_english(given):
    name, command, settings = given
    case, result = answer_of(name, *settings, command=command)
    german = catalogue_of("de")
    german.missing.clear()
    with spoken(german):
        heads = [said(result.heading()), *map(said, result.headline())]
        rendered(result.tables(sources=True) if command == "rate" else result.tables())
        report = result.to_html(Heading.of(case))
        shown = [shown_table(table) for table in result.tables()]
    assert german.missing <= {case["gearset"].name}
    heads += re.findall(r"<(?:title|h1|h2|figcaption)[^>]*>([^<]*)<", report)
    # Equations too, whose cases are told apart by words.
    for table in shown:
        place = [column.heading for column in table.columns]
        if "Gleichung" in place:
            heads += [row[place.index("Gleichung")] for row in table.rows]
    assert not [head for head in heads if ENGLISH_WORDS.search(str(head))]


WORDY = [
    ("actuator-duty", "tolerances.fit=C", "tolerances.centre_distance=js7", "tolerances.grade=8",
     "tolerances.temperatures={housing='60 degC', gears='70 degC'}", "spectrum.duty=S3 15 %",
     "housing.area_rule=well ribbed", "housing.idle_loss=30 W", "operation.fan=true"),
    ("gearset-2", "spectrum.duty_class=EN 15714-2 A"),
    ("gearset-3", "spectrum.step=60 N m, 700 rpm, 10 h", "spectrum.duty=S3 15 %",
     "gearset.wheel_material=EN-GJS-400-15", "gearset.flank=ZC"),
    ("gearset-3", "operation.input_power=2 kW", "rating.iso14521_edition=1998"),
    # What may jam.
    ("gearset-3", "tolerances.thread=['0 um','-10 um']", "tolerances.tooth=['-40 um','-60 um']",
     "tolerances.centre_distance=js9"),
    # What locks on the reference circle only.
    ("drive-actuator", "rating.friction=0.09"),
    ("drive-actuator", "rating.friction=0.09", "rating.bs721_friction_angle=mu_over_cos"),
]  # fmt: skip


@pytest.mark.parametrize("given", WORDY, ids=lambda given: given[-1])
def test_all_that_a_rating_tells_in_full_leaves_nothing_english(given):
    _, result = answer_of(*given)
    german = catalogue_of("de")
    german.missing.clear()
    with spoken(german):
        result.brief()
        assert "nachgerechnet" in said(f"{result.heading()}, rated")
        for table in result.tables(sources=True):
            shown_table(table)
    assert german.missing <= {result.gearset.name}


SIZED = [
    {"ratio": 40, "output_torque": "300 N m", "worm_speed": "1500 rpm",
     "settings": ("operation.service=valve", "tolerances.fit=C")},
    {"case": "actuator-shafts", "ratio": 50, "settings": (
        "bearings.static_safety=9", "requirements.self_locking=wanted",
        "requirements.locking_margin=1.01", "requirements.centre_distance=300 mm",
        "requirements.wheel_diameter=500 mm", "requirements.safety=1.2")},
    {"ratio": 15, "output_torque": "36600 N m", "worm_speed": "1440 rpm", "rank": "margin",
     "settings": ("requirements.hobs=standard", "requirements.ratio_tolerance=0.1")},
]  # fmt: skip


@pytest.mark.parametrize("given", SIZED, ids=["valve", "shafts", "margin"])
def test_german_proposals_leave_nothing_english(given):
    german = catalogue_of("de")
    german.missing.clear()
    with spoken(german):
        text = rendered(size(**given, cut=False).tables())
    assert german.missing == set()
    assert "nachgerechnet" in text


@pytest.mark.parametrize(
    ("command", "case"),
    [("rexs", "actuator-duty"), ("rexs", "actuator-shafts"), ("shafts", "actuator-shafts"),
     ("crossed", "gearset-3"), ("sensitivity", "actuator-duty"), ("sensitivity", "gearset-3"),
     pytest.param("optimise", "gearset-3", marks=pytest.mark.slow),
     pytest.param("optimise", "actuator-duty", marks=pytest.mark.slow),
     pytest.param("flank", "gearset-3", marks=pytest.mark.slow)],
)  # fmt: skip
def test_german_tables_of_a_designers_commands_leave_nothing_english(command, case):
    read, result = answer_of(case, command=command)
    german = catalogue_of("de")
    german.missing.clear()
    with spoken(german):
        for text in (result.heading(), *result.headline()):
            shown_text(text)
        rendered(result.tables())
    assert german.missing <= {read["gearset"].name}


def test_german_tables_of_tolerances_by_the_exact_flanks_leave_nothing_english():
    """Words of both tables, without the flanks that the numbers come from."""
    names = "hob and worm", "thread", "tooth", "centre distance", "axial offset", "shaft angle"
    told = f"on the mean circle: {'; '.join(f'{name} -1 to 1 um' for name in names)}"
    side = Side(0.18, 1.7, 0.011, 1e-4)
    nominal, corner = (
        Corner(place, {1: side, -1: side}, np.zeros((1, 1)))
        for place in (Offset(), Offset(0.1, -0.1, 0.1))
    )
    german = catalogue_of("de")
    german.missing.clear()
    with spoken(german):
        for error in (1.0, 1e-9):
            rendered((corner_table((corner,), nominal, error),))
        for text in (told, "Backlash, by the exact flanks", "upper allowance of the tooth"):
            shown_text(text)
    assert not german.missing


def test_nothing_of_short_words_is_taken_for_a_symbol(words):
    with spoken(words):
        for text in ("as it is", "at 3", "3 of 4", "1.2 FAILS"):
            assert said(text) == text
        for text in ("d at_2", "K_A of(3)", "F_to", "3 in", "S_W 1.53"):
            assert said(text) == text
    assert words.missing == {"as it is", "at 3", "3 of 4", "1.2 FAILS"}


def test_an_equation_that_has_words_is_shown_in_the_language(words):
    heads = ("symbol", "equation")
    formula = "pi tau a/2 if a < 2 else 3"
    table = Table.of(heads, [("c", "wheel"), ("a", formula), ("b", "axle")])
    with spoken(words):
        shown = shown_table(table)
    assert [row[1] for row in shown.rows] == ["Rad", formula, "axle"]
    assert words.missing == {"symbol", "equation", "axle"}


@pytest.mark.slow
@pytest.mark.parametrize("given", FEW_CASES, ids=" ".join)
def test_a_german_report_has_the_numbers_of_the_english_one(given):
    _, result = answer_of(*given)
    english = result.to_html()
    with spoken(catalogue_of("de")):
        german = result.to_html()
    marked = re.compile(r"<data [^>]*>[^<]*</data>")
    # A comma between thousands is of English.
    german = german.replace("\N{NARROW NO-BREAK SPACE}", ",")
    assert sorted(marked.findall(german)) == sorted(marked.findall(english))


def test_inches_are_the_same_in_both_languages():
    _, result = answer_of("actuator-duty")
    number = re.compile(r"\d+(?:[.,]\d+)?(?: (?:hp|lbf·in|degF))?")
    with shown_in("us"):
        english = number.findall(result.brief())
        with spoken(catalogue_of("de")):
            german = number.findall(result.brief().replace("\N{NARROW NO-BREAK SPACE}", ","))
    assert sorted(german) == sorted(english)
    assert sum("hp" in each for each in english) >= 2


@pytest.mark.ordinary(2)
@pytest.mark.parametrize(
    ("command", "given"),
    [
        ("rate", ("actuator-shafts",)),
        ("rate", ("actuator-duty", "tolerances.fit=C")),
        ("shafts", ("actuator-shafts", "worm_shaft.peak=2.5")),
        ("shafts", ("actuator-shafts", "wheel_shaft.section=[{length='60 mm', diameter='30 mm'}, "
                    "{length='100 mm', diameter='25 mm'}]")),
    ],
)  # fmt: skip
def test_every_number_of_the_screen_in_inches_is_the_same_in_both_languages(command, given):
    _, result = answer_of(*given, command=command)
    number = re.compile(r"(?<![\w.])-?\d[\d,\N{NARROW NO-BREAK SPACE}]*(?:\.\d+)?(?:e[+-]?\d+)?")

    def numbers():
        texts = [getattr(result, "brief", str)(), *map(shown_text, result.headline())]
        for table in map(shown_table, result.tables()):
            cells = (cell for row in table.rows for cell in row if "=" not in str(cell))
            texts += [table.title, *table.remarks, *map(str, cells)]
        blank = "\N{NARROW NO-BREAK SPACE}"
        return sorted(one.strip("," + blank).replace(blank, ",") for text in texts
                      for one in number.findall(text))  # fmt: skip

    with shown_in("us"):
        english = numbers()
        with spoken(catalogue_of("de")):
            assert numbers() == english


def test_a_table_is_shown_in_the_language_that_is_spoken_and_else_as_it_is(words):
    table = Table.of(("wheel", "and"), [("wear of wheel", "and")], title="wheel", remarks=["and"])
    assert shown_table(table) == table
    with spoken(words):
        shown = shown_table(table)
    assert [column.heading for column in shown.columns] == ["Rad", "und"]
    assert shown.rows == (("Radverschleiß", "und"),)
    assert (shown.title, *shown.remarks) == ("Rad", "und")


def test_every_line_of_a_shipped_language_has_the_holes_of_the_english():
    assert languages() == ("en", "de")
    assert catalogue_of("en") is None
    assert catalogue_of("de").code == "de"


def test_a_language_of_a_readers_own_is_a_file_beside_the_case(tmp_path):
    (tmp_path / "fr.toml").write_text('[texts]\n"wear" = "usure"\n', "utf-8")
    with shown_as(Project(language="fr.toml"), tmp_path):
        assert said("wear") == "usure"
    with shown_as(Project(), tmp_path, language=str(tmp_path / "fr.toml")):
        assert said("wear") == "usure"


@pytest.mark.parametrize(
    ("content", "said"),
    [
        ("texts = 3", r"no table \[texts\]"),
        ("[texts", "not valid TOML"),
        ("kept = 3\n[texts]", "kept is 3; it must be a list"),
        ("kept = [3]\n[texts]", "must be a list of words"),
        ('[texts]\n"{0} h" = "{0} h"', "a brace that belongs to no hole"),
        ('[texts]\n"a" = "a {"', "a brace that belongs to no hole"),
        ('[texts]\n"{a b}" = "{a b}"', "a brace that belongs to no hole"),
        ('[texts]\n"{a} of {b}" = "{a}"', "each of its holes once"),
        ('[texts]\n"{a} of {a}" = "{a}"', "each of its holes once"),
    ],
)
def test_a_file_that_is_no_catalogue_is_refused(tmp_path, content, said):
    file = tmp_path / "xx.toml"
    file.write_text(content, "utf-8")
    with pytest.raises(InputError, match=said):
        catalogue_of(str(file))


def test_a_language_that_there_is_not_is_one_line(tmp_path):
    with pytest.raises(InputError, match="it must be one of 'en', 'de', or a file"):
        catalogue_of("tlh")
    with pytest.raises(InputError, match="cannot be read: no such file"):
        catalogue_of(str(tmp_path / "none.toml"))


def test_a_line_of_short_words_is_said_as_well_and_each_number_has_its_unit():
    german = catalogue_of("de")
    assert german.said("5.76 um of 71 um") == "5.76 um von 71 um"
    assert german.said("at 2.5 T_2") == "bei 2.5 T_2"
    # Numbers alone stay, and are not missed.
    assert german.said("5.76 um") == "5.76 um"
    assert "5.76 um" not in german.missing
