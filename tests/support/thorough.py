"""How much of a long test runs: a part of it in `make test`, the whole in `make verify`.

Every test of a module that imports this one is run again by `make verify`, with the variable set.
"""

import os
from collections.abc import Iterable, Sequence
from typing import TypeVar

import numpy as np
import pytest

Case, Other = TypeVar("Case"), TypeVar("Other")

VARIABLE = "EQUIPOISE_THOROUGH"
THOROUGH = os.environ.get(VARIABLE) == "1"
whole = pytest.mark.whole  # not in `make test` at all


def count(all_: int, few: int) -> int:
    """Return how many draws, seeds or steps there are."""
    return all_ if THOROUGH else few


def some(cases: Sequence[Case], few: int) -> list[Case]:
    """Return all cases, or a few that are spread over them evenly, the first and last included."""
    if THOROUGH or few >= len(cases):
        return list(cases)
    return [cases[k] for k in np.linspace(0, len(cases) - 1, few).round().astype(int)]


def pairs(cases: Iterable[Case], others: Iterable[Other], every: int) -> list[tuple[Case, Other]]:
    """Return all pairs, or one in so many, in which each case and each of the others occurs."""
    columns = list(others)
    return [
        (case, other)
        for i, case in enumerate(cases)
        for j, other in enumerate(columns)
        if THOROUGH or (i + j) % every == 0
    ]


def few_draws(patch: pytest.MonkeyPatch) -> None:
    """For tests of what a linear method does, not of how well its sd are known."""
    if not THOROUGH:
        patch.setattr("equipoise.estimation.regression.linear_method.PAIRS", 12)
        patch.setattr("equipoise.estimation.regression.linear_method.SPARE", 3)


def few_platforms(patch: pytest.MonkeyPatch) -> None:
    """For tests of what a plan is made into, not of how good it is."""
    if not THOROUGH:
        patch.setattr("equipoise.planning.manoeuvre.predicted_sd.PLATFORMS", 24)
