"""Kinds of options, and how help shows what they are when left out."""

from collections.abc import Sequence
from typing import Annotated, Any

from cyclopts import Parameter, Token

from equipoise.model.errors import InputError


def _plain(values: tuple[float, ...]) -> str:
    """Return numbers as people type them."""
    return " ".join(f"{value:g}" for value in values)


def _whole(_kind: Any, tokens: Sequence[Token]) -> int:
    """Return a whole number; one with a fraction would be rounded without a word."""
    (token,) = tokens
    try:
        return int(token.value)
    except ValueError:
        raise InputError(token.keyword or "number", token.value, "a whole number") from None


Flag = Annotated[bool, Parameter(show_default=False)]
Names = Annotated[tuple[str, ...], Parameter(show_default=False)]
Listed = Annotated[tuple[str, ...], Parameter(show_default=False, consume_multiple=True)]
Triple = Annotated[tuple[float, float, float], Parameter(show_default=_plain)]
Several = Annotated[tuple[float, ...], Parameter(show_default=_plain, consume_multiple=True)]
Whole = Annotated[int, Parameter(converter=_whole)]
