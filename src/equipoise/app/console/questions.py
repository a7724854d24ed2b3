"""Questions that a person answers at the terminal, each with its default in brackets."""

import sys
from collections.abc import Callable
from dataclasses import dataclass
from typing import Generic, TypeVar

from equipoise.app.console.terminal import complain, reply_to
from equipoise.model.errors import InputError

Answer = TypeVar("Answer")


@dataclass(frozen=True, slots=True)
class Question(Generic[Answer]):
    """What is asked, with the unit; ``read`` raises InputError for a text that is no answer."""

    text: str
    default: str
    read: Callable[[str], Answer]


def is_person_there() -> bool:
    """Return whether a person can read a question and answer it."""
    return all(stream is not None and stream.isatty() for stream in (sys.stdin, sys.stderr))


def answered(question: Question[Answer], number: int) -> Answer:
    """Ask until the answer can be read; an empty one is the default.

    Raises InputError where the input ends.
    """
    while True:
        try:
            given = reply_to(f"{number}. {question.text} [{question.default}]: ")
        except EOFError:
            raise InputError(question.text, "the end of the input", "an answer") from None
        try:
            return question.read(given or question.default)
        except InputError as error:
            complain(str(error))
