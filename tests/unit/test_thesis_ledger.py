import ast
import collections
import doctest
import re
import tomllib
from pathlib import Path

import pytest
from apparatus.thesis_words import plain

from asperity import thesis
from asperity.thesis.contents import CLAIMS, FIGURES, TABLES
from asperity.thesis.products import VERDICTS, Finding
from asperity.thesis.reproduce import page as report
from asperity.thesis.said import disputed, findings, said_of, slips
from asperity.thesis.sliding.bodies import Body, Sweep
from asperity.thesis.sliding.claims import drive_stiffness


def finding(**parts):
    return Finding.judged(parts, "1.0", "Because.", {"ratio": 1.0}, ["asperity slide table-4.3"])


def test_a_claim_is_reproduced_if_every_part_holds():
    judged = finding(first=True, second=True)
    assert judged.verdict == "reproduced"
    assert judged.reason == "Because."


def test_a_claim_differs_if_one_part_fails_and_names_it():
    judged = finding(first=True, second=False)
    assert judged.verdict == "differs"
    assert (judged.held, judged.failed) == (("first",), ("second",))
    assert judged.reason == "Because."


def test_a_claim_of_which_nothing_holds_claims_no_success():
    assert (finding(only=False).held, finding(only=False).failed) == ((), ("only",))


@pytest.mark.parametrize("kind", VERDICTS)
def test_what_an_input_was_made_from_holds_as_fitted_and_what_is_lost_never_differs(kind):
    def judged(holds):
        return Finding.judged({"one": holds}, "1", "Because.", {}, [], verdict=kind).verdict

    assert judged(True) == kind
    assert judged(False) == ("not testable" if kind == "not testable" else "differs")


EXCERPT = Path(__file__).parents[1] / "literature" / "thesis-excerpt.toml"


def lines_as_read():
    """What is quoted of each line as the machine read it, with the slips mended that are listed."""
    found = collections.defaultdict(list)
    for one in tomllib.loads(EXCERPT.read_text("utf-8"))["line"]:
        text = one["text"]
        for slip in slips():
            if slip.line == one["number"] and not slip.why:
                text = text.replace(slip.has, slip.should)
        found[one["number"]].append(plain(text))
    return found


def test_every_claim_quotes_the_thesis_by_a_line_where_the_words_stand():
    read = lines_as_read()
    for number in CLAIMS:
        said = said_of(number).said
        assert said, number
        for line, words in said:
            assert any(plain(words) in text for text in read[line]), (number, line, words)


def test_quotations_are_short_and_nothing_else_of_the_thesis_ships():
    quoted = [(line, plain(words)) for number in CLAIMS for line, words in said_of(number).said]
    for line, texts in lines_as_read().items():
        for text in texts:
            assert len(text) < 200
            assert (line, text) in quoted


def test_another_number_in_the_text_is_not_the_quoted_one():
    assert plain("$T_{Bs} = 33.8$ Nm") == plain("T_Bs = 33.8 Nm")
    assert plain("T_Bs = 33.9 Nm") != plain("T_Bs = 33.8 Nm")


def test_what_is_disputed_is_of_claims_that_are_there():
    numbers = [one.claim for one in disputed()]
    assert len(numbers) == len(set(numbers))
    assert set(numbers) <= set(CLAIMS)


def test_what_a_claim_rests_on_and_where_to_see_it_is_there():
    shelves = {"claim": CLAIMS, "figure": FIGURES, "table": TABLES}
    resting = collections.Counter()
    for number in CLAIMS:
        said = said_of(number)
        resting.update(said.rests_on)
        for name in said.see:
            kind, _, which = name.partition(" ")
            assert which in shelves[kind], (number, name)
            assert name != f"claim {number}"
    assert set(resting) == set(findings())
    # What one claim alone rests on belongs into it.
    assert all(count > 1 for name, count in resting.items() if name != "one-cycle")


REFERENCE = re.compile(
    r"""
    \b(?:[Cc]laims?|[Ff]igures?|[Tt]ables?|[Gg]earsets?|[Ss]ets?|[Ss]ections?|chapter|TR|BS|AGMA)
    \ \d[\d.]*(?:(?:,|,?\ and|\ or|\ to)\ \d[\d.]*)*
    | \(\d+\)                              # an equation
    | \b\d(?:\.\d+){2,}                    # a section
    | \bk(?:_\w)?\ =\ \d+(?:\ and\ \d+)?    # where it is computed
    | \b[A-Za-z]+[_*^]\w*                  # a symbol
    | \bL\d\b | \be6\b | \b(?:m|mm|s)[23]\b     # a body, a power of ten, a unit
    | (?<![\d.])[01](?![\d.]*\d)            # bounds of a share
    """,
    re.X,
)


def typed(text):
    """Numbers in a text that no computation gave."""
    return re.findall(r"\d[\d.]*", REFERENCE.sub("", text))


def judgements():
    """Texts of what is ours, why, and what is assumed, as written in the sources of the claims."""
    for path in sorted(Path(thesis.__file__).parent.rglob("*.py")):
        for call in ast.walk(ast.parse(path.read_text("utf-8"))):
            if isinstance(call, ast.Call) and getattr(call.func, "attr", "") == "judged":
                told = [*call.args[1:3], *(k.value for k in call.keywords if k.arg == "assumed")]
                yield path, told


def written(tree):
    """The pieces of a text that are not computed."""
    computed = {
        piece
        for one in ast.walk(tree)
        if isinstance(one, ast.FormattedValue)
        for piece in ast.walk(one)
    }
    for piece in ast.walk(tree):
        if isinstance(piece, ast.Constant) and piece not in computed:
            yield str(piece.value)


@pytest.mark.slow
def test_no_reason_holds_a_number_that_is_typed_in():
    found = list(judgements())
    assert len(found) >= len(CLAIMS)
    for path, told in found:
        for tree in told:
            for text in written(tree):
                assert not typed(text), (path.name, typed(text), text)


def test_what_is_told_once_and_could_fail_holds_no_number_either():
    texts = [one.text for one in findings().values()]
    texts += [said_of(number).fails_by for number in CLAIMS]
    texts += [one.text for one in disputed()]
    for text in texts:
        assert not typed(text), text


@pytest.mark.parametrize(
    ("text", "numbers"),
    [
        ("33.8 N m at k_w = 5, by (143)", ["33.8"]),
        ("claims 7.3 and 7.4, Tables 3.2, 3.5", []),
        ("mu_0T of ISO/TR 14521 is 0.0715", ["0.0715"]),
        ("on an axis from 0 to 1, section 7.3, 5.3.1", []),
        ("1.5 and 10 and 0.1", ["1.5", "10", "0.1"]),
    ],
)
def test_a_typed_number_is_told_from_a_reference(text, numbers):
    assert typed(text) == numbers


def test_the_printed_points_give_the_printed_drive_stiffness():
    stiffness = drive_stiffness(
        0.5, 0.5e-3, (1.500001386, 1.500006410), (0.1833e-3, 0.2234e-3), 0.749175e-3, -3.91128
    )
    assert round(stiffness) == 96068


def test_a_body_at_rest_under_a_force_has_the_stiffness_of_a_spring():
    assert drive_stiffness(3.0, 1.0, (1.0, 2.0), (0.0, 0.0), 1.5, 10.0) == pytest.approx(20.0)


def test_a_body_knows_its_command():
    body = Body("table-4.3", ("solve.method=periodic", "vibration.direction=45 deg"))
    assert body.command() == (
        "asperity slide table-4.3 --set solve.method=periodic --set 'vibration.direction=45 deg'"
    )


def test_a_sweep_knows_its_command_its_values_and_its_models():
    sweep = Sweep(
        "table-4.4",
        (("vibration.velocity_ratio", "2,20"), ("vibration.direction", "0:90:45")),
        ("solve.method=periodic",),
    )
    assert sweep.command() == (
        "asperity sweep table-4.4 --over vibration.velocity_ratio=2,20 "
        "--over vibration.direction=0:90:45 --set solve.method=periodic"
    )
    assert sweep.values(0).tolist() == [2.0, 20.0]
    assert sweep.values(1).tolist() == [0.0, 45.0, 90.0]
    ratios = sweep.ratios()
    assert ratios.shape == (2, 3)
    for settings, ratio in (("2", "90"), ratios[0, 2]), (("20", "0"), ratios[1, 0]):
        given = ("vibration.velocity_ratio", "vibration.direction")
        one = [f"{key}={value}" for key, value in zip(given, settings, strict=True)]
        body = Body("table-4.4", ("solve.method=periodic", *one))
        assert ratio == pytest.approx(body.result.ratio, rel=1e-9)


def test_a_point_that_cannot_be_solved_is_not_passed_over():
    sweep = Sweep("table-4.3", (("vibration.velocity_ratio", "2,6"),), ("solve.duration=0.1 s",))
    with pytest.raises(ValueError, match=r"solve\.duration"):
        sweep.ratios()


def test_symbols_are_set_and_everything_else_is_escaped():
    assert report.typeset("k <= 1: v_a < v_d") == ("k ≤ 1: v<sub>a</sub> &lt; v<sub>d</sub>")
    assert doctest.testmod(report).failed == 0


def test_a_page_without_ledger_and_figures_says_how_to_get_them():
    page = report.render((), (), {}, "0.0")
    assert "asperity thesis" in page
    assert "✓" not in page


def test_a_reason_leads_with_two_sentences_and_loses_none():
    reason = "First, of 1.5 N m. Second (by (61)): third. “Fourth” is told below. Fifth."
    assert report.lead(reason) == "First, of 1.5 N m. Second (by (61)): third."
    assert f"{report.lead(reason)} {report.rest(reason)}" == reason
