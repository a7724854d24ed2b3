"""Whether a gyro met the end of its range: rows in a run at the same extreme value."""

import numpy as np

from equipoise.model.arrays import Bools, Series1
from equipoise.model.finding import Finding
from equipoise.model.reasons.finding_reasons import FindingReason as Why
from equipoise.model.reasons.reason import one_reason
from equipoise.model.recording import Samples, runs

RUN = 4  # rows in a row at the extreme, chosen: quantised noise seldom makes as many
FEWEST = 20  # rows (chosen)
MOVES = 20.0  # steps of its values that an axis must span, chosen: else it is quantised, not full
SHARE = 0.02  # of the rows, above which no estimate stands it (chosen)


def saturation_findings(rate: Samples | None) -> list[Finding]:
    """Return the axes of a gyro that stay at their greatest or least value."""
    if rate is None or len(rate) < FEWEST:
        return []
    axes = zip("xyz", rate.values.T, strict=True)
    return [finding for name, values in axes for finding in _axis(name, values)]


def _axis(name: str, values: Series1) -> list[Finding]:
    full = np.zeros(len(values), dtype=bool)
    for extreme in (values.max(), values.min()):
        at: Bools = values == extreme
        for first, last in runs(at):
            if last - first + 1 >= RUN and _moves(values, float(extreme)):
                full[first : last + 1] = True
    if not full.any():
        return []
    share, value = float(full.mean()), float(np.abs(values[full]).max())
    reason = one_reason(Why.SATURATED, name, rate=value, count=int(full.sum()))
    return [Finding("wrong" if share > SHARE else "problem", reason)]


def _moves(values: Series1, extreme: float) -> bool:
    """Say whether an axis spans many of its steps and turns, so that its end is an end."""
    levels = np.unique(values)
    if len(levels) < MOVES:
        return False
    step = float(np.median(np.diff(levels)))
    return bool(np.abs(extreme - np.median(values)) > MOVES * step)
