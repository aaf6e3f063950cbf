import pickle

import pytest

from asperity.errors import (
    AsperityError,
    ConvergenceError,
    InputError,
    MissingExtraError,
    StorageError,
    is_plain,
    nearest,
    one_of,
    plain,
    shown,
    suggestion,
)


@pytest.mark.parametrize(
    ("error", "also", "exit_code"),
    [
        (InputError, ValueError, 2),
        (ConvergenceError, RuntimeError, 3),
        (StorageError, OSError, 2),
        (MissingExtraError, ImportError, 2),
    ],
)
def test_errors_are_of_the_package_and_of_the_usual_kind(error, also, exit_code):
    raised = error("what was given")
    assert isinstance(raised, AsperityError)
    assert isinstance(raised, also)
    assert raised.exit_code == exit_code
    assert str(raised) == "what was given"


def test_convergence_error_carries_what_was_reached_to_another_process():
    raised = ConvergenceError("no periodic state", reached={"residual": 1e-3, "cycles": 400})
    arrived = pickle.loads(pickle.dumps(raised))
    assert arrived.reached == {"residual": 1e-3, "cycles": 400}
    assert str(arrived) == "no periodic state"


def test_a_near_word_is_suggested_and_otherwise_all_are_listed():
    known = ["split", "unsplit", "vector"]
    assert nearest("splt", known) == " (did you mean 'split'?)"
    assert nearest("VECTOR", known) == " (did you mean 'vector'?)"
    assert nearest("xyz", known) == " (allowed: 'split', 'unsplit', 'vector')"
    assert nearest("xyz", []) == ""
    assert suggestion("xyz", known) == ""


def test_nothing_is_near_to_what_is_no_text():
    assert suggestion(5, ["5"]) == ""
    assert nearest(None, ["split"]) == " (allowed: 'split')"


def test_a_plain_text_is_the_same_and_any_other_can_do_nothing():
    for text in ("CuSn12-C-GZ", "\u03bc = 0.1 \u00b0C", "\u65e5\u672c", "non\u00a0breaking", ""):
        assert is_plain(text)
        assert plain(text) == text
    for text, escaped in {
        "a\x1b[2J": r"a\x1b[2J",
        "a\r\nb\0": r"a\r\nb\x00",
        "\u202egpj": r"\u202egpj",
        "\x85\u2028": r"\x85\u2028",
        "\udcff": r"\udcff",
    }.items():
        assert not is_plain(text)
        assert plain(text) == escaped
    assert plain("a\nb\x1b", keep="\n") == "a\nb\\x1b"


def test_a_value_is_shown_short_whatever_it_is():
    assert shown("x") == "'x'"
    assert len(shown("x" * 10**6)) == 60
    assert shown(1 << 100000) == "a whole number of very many digits"


def test_a_word_that_is_not_known_is_told_those_that_are_and_the_nearest():
    assert one_of(("sine", "square"), "sin") == (
        "it must be one of 'sine', 'square' (did you mean 'sine'?)"
    )
    assert one_of(("sine",), "saw") == "it must be 'sine'"
    assert one_of((5, 6), 13.0) == "it must be one of '5', '6'"
