"""Where masses were between two answers of their board.

A mass goes at its own speed or stands. So one that went less far between two answers than it could
stood for the rest: first, if it stood before, else afterwards. Straight lines from answer to answer
would show it creeping, and what looks for moves in a recording would not see it go.
"""

from dataclasses import dataclass

import numpy as np

from equipoise.model.arrays import Bools, Series1

WHOLE = 0.98  # of the time between answers, chosen: a mass that moved for longer moved all along


@dataclass(frozen=True, slots=True, eq=False)
class Answer:
    """Where masses were (m) at a time (s), and which were on their way."""

    t: float
    at: Series1
    going: Bools


def rows_to(before: Answer, t: float, at: Series1, speed: Series1) -> tuple[list[Answer], Answer]:
    """Return the rows between two answers where a mass starts or stops, and the new answer."""
    gap = t - before.t
    taken = np.minimum(np.abs(at - before.at) / speed, gap)
    gone = taken > 0
    first = before.going & gone
    start = np.where(first, before.t, t - taken)
    end = np.where(first, before.t + taken, t)
    going = gone & (~first | (taken > WHOLE * gap))
    corners = np.unique(np.where(first, end, start)[gone])
    corners = corners[(corners > before.t) & (corners < t)]
    length = np.where(gone, taken, 1.0)
    rows = [
        Answer(float(c), before.at + np.clip((c - start) / length, 0, 1) * (at - before.at), going)
        for c in corners
    ]
    return rows, Answer(t, at, going)
