"""Every regular expression of the package takes a time that grows with a text, not with its square.

A file of 600 bytes held a cell of 100 000 digits; to say that it is no number took 20 s.
"""

import importlib
import itertools
import pkgutil
import re
import signal
from collections.abc import Iterator
from contextlib import contextmanager

import pytest

import equipoise

LENGTH = 20_000  # letters: 0.4 s or more where each is compared with each
LIMIT = 0.25  # s of processor time; a linear one takes less than 5 ms
BEGINNINGS = ("", "2: ", "x", "1", "[", "a=", "t")
REPEATED = ("1", " ", "a", "A", "_", "1.", "a=", "a=1,", "a=1 ", ",", "(", "-", "a:", '"')
ENDINGS = ("!", "\n!")


def expressions() -> dict[re.Pattern, str]:
    """Return every expression that a module of the package holds, with its name."""
    found: dict[re.Pattern, str] = {}
    for module in pkgutil.walk_packages(equipoise.__path__, "equipoise."):
        if module.name.endswith("__main__"):
            continue
        for name, held in vars(importlib.import_module(module.name)).items():
            parts = held.values() if isinstance(held, dict) else [held]
            for each in parts:
                if isinstance(each, re.Pattern):
                    found.setdefault(each, f"{module.name}.{name}")
    return found


class TooLateError(Exception):
    pass


@contextmanager
def ended_late() -> Iterator[None]:
    """Raise TooLateError in what takes longer; the engine of expressions lets signals in."""

    def end(*_: object) -> None:
        raise TooLateError

    before = signal.signal(signal.SIGVTALRM, end)
    signal.setitimer(signal.ITIMER_VIRTUAL, LIMIT)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0)
        signal.signal(signal.SIGVTALRM, before)


def slow_text(pattern: re.Pattern) -> str | None:
    """Return what a long text that is slow to match is made of; None: none was found."""
    for beginning, unit, ending in itertools.product(BEGINNINGS, REPEATED, ENDINGS):
        text = beginning + unit * (LENGTH // len(unit)) + ending
        subject = text.encode() if isinstance(pattern.pattern, bytes) else text
        try:
            with ended_late():
                pattern.match(subject)
                pattern.fullmatch(subject)
        except TooLateError:
            return f"{beginning!r}, {unit!r} again and again, {ending!r}"
    return None


def test_no_expression_is_slow_on_long_texts():
    found = expressions()
    assert len(found) > 50
    slow = {name: slow_text(pattern) for pattern, name in found.items()}
    assert {name: text for name, text in slow.items() if text} == {}


@pytest.mark.parametrize("bad", [r"\d+\.?\d*x", r"(a|a)+b", r"\s*(.*?)\s*\)"])
def test_a_slow_one_is_found(bad):
    assert slow_text(re.compile(bad))
