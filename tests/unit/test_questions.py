"""What somebody looks for who has the README, docs/built.rst and the tree is where they look."""

import re
import tomllib
from pathlib import Path

import pytest

import asperity

PACKAGE = Path(asperity.__file__).parent
LIST = Path(__file__).with_name("questions.toml")
QUESTIONS = tomllib.loads(LIST.read_text("utf-8"))["question"]


def text_of(file):
    return (PACKAGE / file).read_text("utf-8")


@pytest.mark.parametrize("question", QUESTIONS, ids=lambda question: question["asked"])
def test_the_file_that_answers_a_question_holds_the_answer(question):
    assert question["holds"] in text_of(question["answer"])
    assert all((PACKAGE / file).is_file() for file in question["opened"])


def test_there_are_forty_questions_of_each_of_two_newcomers_none_twice():
    assert len({question["asked"] for question in QUESTIONS}) == len(QUESTIONS) == 80


def test_thirty_six_of_forty_are_found_within_two_openings():
    for asked in (QUESTIONS[:40], QUESTIONS[40:]):
        assert sum(q["answer"] in q["opened"][:2] for q in asked) >= 36


@pytest.mark.parametrize(
    "question",
    [question for question in QUESTIONS if question["opened"][0].endswith("/__init__.py")],
    ids=lambda question: question["asked"],
)
def test_a_door_that_was_opened_names_what_was_opened_next(question):
    door, answer = question["opened"]
    assert re.search(rf"[`.]{Path(answer).stem}`", text_of(door))
