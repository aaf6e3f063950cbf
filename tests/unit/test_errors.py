import pickle

import pytest

from asperity.errors import (
    AsperityError,
    ConvergenceError,
    InputError,
    MissingExtraError,
    StorageError,
    nearest,
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
