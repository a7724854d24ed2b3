"""Kinds of options, and how help shows what they are when left out."""

from typing import Annotated

from cyclopts import Parameter


def _plain(values: tuple[float, ...]) -> str:
    """Return numbers as people type them."""
    return " ".join(f"{value:g}" for value in values)


Flag = Annotated[bool, Parameter(show_default=False)]
Names = Annotated[tuple[str, ...], Parameter(show_default=False)]
Triple = Annotated[tuple[float, float, float], Parameter(show_default=_plain)]
