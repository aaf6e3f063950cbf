"""Help says what is written, with every word in brackets."""

import itertools
import re

import pytest
import typer

from asperity.cli.application import app
from asperity.cli.command_line import built
from asperity.cli.helped import as_written
from asperity.commands import COMMANDS

BRACKETED = re.compile(r"\[[^\[\]\s]+\]")


def commands(command, words=()):
    yield words, command
    for name, one in getattr(command, "commands", {}).items():
        yield from commands(one, (*words, name))


EVERY = dict(commands(built(app)))


def texts(command):
    """All that a command's help holds, as it is written."""
    said = [getattr(command, name, None) for name in ("help", "epilog")]
    said += [getattr(parameter, "help", None) for parameter in command.params]
    for one in getattr(command, "commands", {}).values():
        said.append((one.short_help or one.help or "").split("\n\n")[0])
    return [text for text in said if text]


WITH_BRACKETS = {
    words: found
    for words, command in EVERY.items()
    if (found := sorted(set(BRACKETED.findall(" ".join(texts(command))))))
}


def test_there_is_help_with_words_in_brackets():
    assert {"[vibration]", "[friction]"} <= set(WITH_BRACKETS["methods",])
    told = itertools.chain.from_iterable((one.summary, one.files) for one in COMMANDS)
    assert len(set(BRACKETED.findall(" ".join(told)))) <= len(
        set(itertools.chain.from_iterable(WITH_BRACKETS.values()))
    )


@pytest.mark.parametrize("words", WITH_BRACKETS, ids=" ".join)
def test_help_keeps_every_word_in_brackets(asperity, words, monkeypatch):
    monkeypatch.setenv("COLUMNS", "1000")
    code, output, _ = asperity(*words, "--help")
    assert code == 0
    assert [one for one in WITH_BRACKETS[words] if one not in output] == []
    assert "\\" not in output


@pytest.mark.parametrize(
    "text", ["[bold]", "a [vibration] b", "[/]", "[red]x[/red]", "\\[x]", "[1]", "[a b]", "[]"]
)
def test_whatever_rich_would_take_for_its_own_is_printed(text):
    from rich.text import Text

    command = typer.main.get_command(app)
    command.help = text
    as_written(command)
    assert Text.from_markup(command.help).plain == text
