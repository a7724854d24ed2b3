"""Rows of the sensors that stand out: outlying or frozen, as masks and as findings."""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from equipoise.assessment.record_checks.frozen_rows import frozen_attitudes, frozen_rates
from equipoise.assessment.record_checks.outliers import (
    OutlyingRows,
    outlying_attitudes,
    outlying_rates,
)
from equipoise.model.arrays import Bools
from equipoise.model.finding import Finding
from equipoise.model.reasons.finding_reasons import FindingReason as Why
from equipoise.model.reasons.reason import one_reason
from equipoise.model.recording import Recording, Samples, runs
from equipoise.sensors.vector_sensors import CHANNELS

NAMED = 5  # rows and runs that are named one by one; chosen: a screen


@dataclass(frozen=True, slots=True, eq=False)
class OddRows:
    """What stands out in one channel."""

    outlying: OutlyingRows
    frozen: NDArray[np.bool_]  # (n,)

    @property
    def mask(self) -> NDArray[np.bool_]:
        """Return the rows that an estimator should leave out."""
        return self.outlying.mask | self.frozen


@lru_cache(maxsize=1)  # found, then left out: by identity
def odd_attitudes(attitude: Samples) -> OddRows:
    """Return what stands out among the rows of an attitude sensor."""
    return OddRows(outlying_attitudes(attitude), frozen_attitudes(attitude))


@lru_cache(maxsize=1)  # as ``odd_attitudes``
def odd_rates(rate: Samples) -> OddRows:
    """Return what stands out among the rows of a gyro."""
    return OddRows(outlying_rates(rate), frozen_rates(rate))


def odd_vectors(channel: Samples) -> Bools:
    """Return which rows of a sensor of a vector lie off the motion of their neighbours."""
    about = channel.values - np.median(channel.values, axis=0)
    return outlying_rates(Samples(channel.t, about)).mask


def odd_row_findings(recording: Recording) -> list[Finding]:
    """Return the outlying and frozen rows of camera and gyro, with their times.

    Of sensors of vectors how many are outlying.
    """
    found: list[Finding] = []
    if recording.attitude is not None and len(recording.attitude) > 1:
        odd = odd_attitudes(recording.attitude)
        found += _reported("attitude", "deg", recording.attitude, odd)
    if recording.rate is not None and len(recording.rate) > 1:
        found += _reported("gyro", "deg/s", recording.rate, odd_rates(recording.rate))
    for name in CHANNELS:
        channel: Samples | None = getattr(recording, name)
        count = 0 if channel is None or len(channel) < 2 else int(odd_vectors(channel).sum())
        if count:
            found.append(Finding("problem", one_reason(Why.OUTLYING_VECTORS, name, count=count)))
    return found


def _reported(name: str, unit: str, channel: Samples, odd: OddRows) -> list[Finding]:
    return [
        *_outlying(name, unit, channel, odd.outlying, odd.outlying.mask & ~odd.frozen),
        *_frozen(name, channel, odd.frozen),
    ]


def _outlying(
    name: str, unit: str, channel: Samples, odd: OutlyingRows, mask: NDArray[np.bool_]
) -> list[Finding]:
    off = np.linalg.norm(odd.away, axis=1)
    rows = np.flatnonzero(mask)
    named = np.sort(rows[np.argsort(-off[rows], kind="stable")][:NAMED])
    found: list[Finding] = []
    for k in named.tolist():
        t = float(channel.t[k])
        numbers = {"row": k + 1, "t": t, "off": float(off[k]), "scatter": odd.scale}
        about = one_reason(Why.OUTLYING_ROW, name, unit, **numbers)
        found.append(Finding("problem", about, (t, t), "off"))
    if len(rows) > NAMED:
        more = one_reason(Why.MORE_OUTLYING_ROWS, name, count=len(rows) - NAMED)
        found.append(Finding("problem", more))
    return found


def _frozen(name: str, channel: Samples, mask: NDArray[np.bool_]) -> list[Finding]:
    pieces = runs(mask)
    longest = sorted(sorted(pieces, key=lambda piece: piece[0] - piece[1])[:NAMED])
    found: list[Finding] = []
    for first, last in longest:
        code = Why.REPEATED_ROW if first == last else Why.REPEATED_ROWS
        span = (float(channel.t[first - 1]), float(channel.t[last]))
        numbers = {"first": first + 1, "last": last + 1, "start": span[0], "end": span[1]}
        found.append(Finding("problem", one_reason(code, name, **numbers), span, "frozen"))
    if len(pieces) > NAMED:
        more = one_reason(Why.MORE_REPEATED_ROWS, name, count=len(pieces) - NAMED)
        found.append(Finding("problem", more))
    return found
