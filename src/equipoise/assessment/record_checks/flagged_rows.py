"""Rows of the sensors that stand out: outlying or frozen, as masks and as findings."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from equipoise.assessment.record_checks.frozen_rows import frozen_attitudes, frozen_rates, runs
from equipoise.assessment.record_checks.outliers import (
    OutlyingRows,
    outlying_attitudes,
    outlying_rates,
)
from equipoise.model.finding import Finding
from equipoise.model.recording import Recording, Samples

NAMED = 5  # rows and runs that are told one by one; chosen: a screen


@dataclass(frozen=True, slots=True, eq=False)
class OddRows:
    """What stands out in one channel."""

    outlying: OutlyingRows
    frozen: NDArray[np.bool_]  # (n,)

    @property
    def mask(self) -> NDArray[np.bool_]:
        """Return the rows that an estimator should leave out."""
        return self.outlying.mask | self.frozen


def odd_attitudes(attitude: Samples) -> OddRows:
    """Return what stands out among the rows of an attitude sensor."""
    return OddRows(outlying_attitudes(attitude), frozen_attitudes(attitude))


def odd_rates(rate: Samples) -> OddRows:
    """Return what stands out among the rows of a gyro."""
    return OddRows(outlying_rates(rate), frozen_rates(rate))


def odd_row_findings(recording: Recording) -> list[Finding]:
    """Return the outlying and frozen rows of both sensors, with their times."""
    found: list[Finding] = []
    if recording.attitude is not None and len(recording.attitude) > 1:
        odd = odd_attitudes(recording.attitude)
        found += _reported("attitude", "deg", recording.attitude, odd)
    if recording.rate is not None and len(recording.rate) > 1:
        found += _reported("gyro", "deg/s", recording.rate, odd_rates(recording.rate))
    return found


def _reported(name: str, unit: str, channel: Samples, odd: OddRows) -> list[Finding]:
    return [
        *_outlying(name, unit, channel, odd.outlying, odd.outlying.mask & ~odd.frozen),
        *_frozen(name, channel, odd.frozen),
    ]


def _outlying(
    name: str, unit: str, channel: Samples, odd: OutlyingRows, mask: NDArray[np.bool_]
) -> list[Finding]:
    outlying = np.degrees(np.linalg.norm(odd.away, axis=1))
    rows = np.flatnonzero(mask)
    named = np.sort(rows[np.argsort(-outlying[rows], kind="stable")][:NAMED])
    found = [
        Finding(
            "problem",
            f"{name}: row {k + 1} at {channel.t[k]:.6g} s is {outlying[k]:.2g} {unit} off the "
            "motion of "
            f"its neighbours (they scatter by {math.degrees(odd.scale):.2g} {unit} per axis).",
            (float(channel.t[k]), float(channel.t[k])),
            "off",
        )
        for k in named.tolist()
    ]
    if len(rows) > NAMED:
        found.append(Finding("problem", f"{name}: {len(rows) - NAMED} further rows are outlying."))
    return found


def _frozen(name: str, channel: Samples, mask: NDArray[np.bool_]) -> list[Finding]:
    pieces = runs(mask)
    longest = sorted(sorted(pieces, key=lambda piece: piece[0] - piece[1])[:NAMED])
    found = [
        Finding(
            "problem",
            f"{name}: {_rows(first, last)} the one before, from {channel.t[first - 1]:.6g} to "
            f"{channel.t[last]:.6g} s.",
            (float(channel.t[first - 1]), float(channel.t[last])),
            "frozen",
        )
        for first, last in longest
    ]
    if len(pieces) > NAMED:
        found.append(Finding("problem", f"{name}: {len(pieces) - NAMED} further repeats of rows."))
    return found


def _rows(first: int, last: int) -> str:
    if first == last:
        return f"row {first + 1} repeats"
    return f"rows {first + 1} to {last + 1} repeat"
