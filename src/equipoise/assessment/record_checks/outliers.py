"""Rows of a sensor that are outliers from the smooth motion of their neighbours.

A row is suspect when what a local polynomial leaves of it (``local_fit``), in units of what it
leaves of most rows, is more than chance would show once in ten records. A suspect is outlying when
the few rows to be left out explain the misfit of the window, and a touch does not: a contact or a
push bends an attitude (its rate jumps) and breaks a rate, on one side of a row for good, while an
outlying row leaves both sides as they were. At an edge of the record nothing distinguishes the two;
there a jump of the rate by less than a tenth is taken for a touch.

The scale is what is left of most rows, near by and in the whole record, whichever is more. It holds
the noise and what the polynomial cannot follow of fast motion, so that smooth motion, however fast,
is nothing unusual. Runs of more than three odd rows are not recognised.
"""

import math
from dataclasses import dataclass
from functools import cache
from typing import NamedTuple

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray

from equipoise.assessment.record_checks.attitude_steps import steps
from equipoise.assessment.record_checks.local_fit import (
    LocalFit,
    Span,
    Vectors,
    attitude_vectors,
    local_fit,
    rate_vectors,
)
from equipoise.assessment.record_checks.rate_quality import step_of
from equipoise.assessment.record_checks.robust_scatter import robust_sd
from equipoise.assessment.record_checks.window_misfit import (
    ASIDE,
    Window,
    away,
    misfit,
    odd_rows,
    out,
    touch_misfit,
)
from equipoise.maths.chi_square import chi_square_limit
from equipoise.model.arrays import Floats, Ints, Series1, Series3, Vector3
from equipoise.model.recording import Samples

ALARMS = 0.1  # records without an odd row in which one is named; chosen: one in ten
SPANS = tuple(
    Span(*s) for s in ((4, 3), (6, 3), (10, 3), (6, 5), (8, 5), (8, 7), (10, 7))
)  # chosen
SAMPLE = 3000  # rows that the span is chosen by (chosen: a tenth of a second)
NEAR = 51  # rows over which the scale is taken near by (chosen: a scatter to 10 %)
TOUCH = 0.1  # of the platform's rate: at an edge no touch makes a greater jump (0.05 was measured)
PUSH = 0.5  # of the platform's rate: inside the record no touch makes a greater jump (chosen), ...
HAND = math.radians(10)  # rad/s: ... but a hand may push a platform that hardly turns (chosen)
PIECE, BESIDE = 20_000, 200  # rows fitted together, and rows beside them (chosen)
PASSES = 20  # chosen: each finds one odd row in every stretch
UNSURE = 2.0  # times the scale by which a jump between two rows may come out too large (chosen)
HALF = 0.5  # of the step of coarse values: the least scale, so that a flip by one step is nothing
REPEATS = 0.1  # share of rows as the one before, from which an attitude is coarse (chosen)
EXACT = 1e-9  # rad, rad/s: below this rows are computed, not measured


class Platform(NamedTuple):
    """Limits of a touch of the platform."""

    speed: float  # rad/s, at which it mostly turns
    attitude: bool  # its rows are attitudes, not rates


class _Sensor(NamedTuple):
    """Rows of a sensor, and how they are fitted."""

    t: Series1  # s
    vectors: Vectors
    span: Span
    least: Vector3  # rad or rad/s, of the scale
    platform: Platform


@dataclass(frozen=True, slots=True, eq=False)
class OutlyingRows:
    """Which rows are outlying, and by how much."""

    mask: NDArray[np.bool_]  # (n,) the rows to leave out
    away: Series3  # (n, 3) rad or rad/s in body axes, how far they are off; 0 elsewhere
    scale: float  # rad or rad/s, what a local polynomial leaves of most rows, per axis
    rough: Series3  # (n, 3) rad or rad/s, what it leaves of each row, as noise of that row alone


def outlying_attitudes(attitude: Samples) -> OutlyingRows:
    """Return the outlying rows of an attitude sensor."""
    duration, turn = steps(attitude)
    size = np.linalg.norm(turn, axis=1)
    coarse = bool(size.any()) and np.count_nonzero(size == 0) > REPEATS * len(size)
    least = HALF * float(size[size > 0].min()) if coarse else 0.0
    vectors = attitude_vectors(attitude.t, attitude.values)
    platform = Platform(_median(size / duration), attitude=True)
    return _outlying(attitude.t, vectors, np.full(3, least), platform)


def outlying_rates(rate: Samples) -> OutlyingRows:
    """Return the outlying rows of a gyro."""
    speed = np.linalg.norm(rate.values, axis=1)
    least = HALF * np.array([step_of(axis) or 0.0 for axis in rate.values.T])
    platform = Platform(_median(speed), attitude=False)
    return _outlying(rate.t, rate_vectors(rate.values), least, platform)


def _median(speed: Series1) -> float:
    return float(np.median(speed)) if len(speed) else 0.0


def _outlying(t: Series1, vectors: Vectors, least: Vector3, platform: Platform) -> OutlyingRows:
    """Return the outlying rows; the scale is ``least`` or more.

    A long record is fitted piece by piece, so that memory does not grow with it.
    """
    n = len(t)
    off, rough, scales = np.zeros((n, 3)), np.full((n, 3), np.nan), list[float]()
    every = np.arange(n)
    some = every[max(0, (n - SAMPLE) // 2) :][:SAMPLE]
    span = min(SPANS, key=lambda span: _reach(local_fit(t, some, vectors, span), span))
    sensor = _Sensor(t, vectors, span, least, platform)
    for first in range(0, max(n, 1), PIECE):
        keep = every[max(0, first - BESIDE) : first + PIECE + BESIDE]
        inside = (every >= first) & (every < first + PIECE)
        scales.append(_piece_scale(sensor, keep, inside, off, rough))
    return OutlyingRows(np.any(off != 0, axis=1).reshape(n), off, float(np.median(scales)), rough)


def _piece_scale(
    sensor: _Sensor, keep: Ints, inside: NDArray[np.bool_], off: Series3, rough: Series3
) -> float:
    """Write how far off the odd rows inside a piece are and what is left of all; return the scale.

    ``keep``: the piece and the rows beside it. Each pass goes without the rows found before.
    """
    t, vectors, span, least, platform = sensor
    scale = 0.0
    for _ in range(PASSES):
        fit = local_fit(t, keep, vectors, span)
        if not len(fit.rows):
            break
        mine = inside[fit.own]
        rough[fit.own[mine]] = fit.left_own[mine]
        sd = np.maximum(_scale(fit), least)
        scale = scale or float(np.sqrt(np.mean(np.median(sd, axis=0) ** 2)))
        odd = _odd_rows(t, fit, sd, platform, len(keep) / len(t))
        if not odd:
            break
        for row, vector in odd.items():
            if inside[row]:
                off[row] = rough[row] = vector
        keep = np.setdiff1d(keep, np.array(list(odd), np.int64))
    return scale


def _reach(fit: LocalFit, span: Span) -> float:
    """Return the least deviation of a row that is detected, middle and edge added up.

    At an edge it stands against the polynomial alone, in the middle against a touch besides.
    """
    if not len(fit.rows):
        return np.inf
    reported = {span.half: _free_of_bends(span), 0: float(np.median(fit.free[:, 0]))}
    return sum(
        float(np.linalg.norm(_spread(fit, at))) / share**0.5 for at, share in reported.items()
    )


@cache
def _free_of_bends(span: Span) -> float:
    """Return the share of a middle row's square that polynomial and bends leave, rows even."""
    t = np.linspace(-1.0, 1.0, span.rows)
    basis = np.linalg.qr(t[:, None] ** np.arange(span.degree + 1)).Q
    middle = np.zeros((span.rows, 3))
    middle[span.half, 0] = 1.0
    return touch_misfit(Window(t, basis, middle, np.ones(3)), np.inf, attitude=True)


def _standard(fit: LocalFit, at: int) -> Floats:
    """Return what is left at a place of every full window, as if it were noise of one row."""
    inner = fit.place == fit.rows.shape[1] // 2
    return fit.left[inner, at] / np.sqrt(fit.free[inner, at])[:, None]


def _spread(fit: LocalFit, at: int) -> Vector3:
    return robust_sd(_standard(fit, at))


def _scale(fit: LocalFit) -> Floats:
    """Return the scale (n, 3) that counts in each window."""
    middle = fit.rows.shape[1] // 2
    left = _standard(fit, middle)
    near = min(NEAR, len(left))
    local = robust_sd(sliding_window_view(left, near, axis=0), axis=2)
    inner = np.flatnonzero(fit.place == middle)
    at = np.clip(np.searchsorted(inner, np.arange(len(fit.rows))) - near // 2, 0, len(local) - 1)
    whole = np.where((fit.place == middle)[:, None], _spread(fit, middle), _spread(fit, 0))
    return np.maximum(np.maximum(local[at], whole), EXACT)


def _odd_rows(
    t: Series1, fit: LocalFit, sd: Floats, platform: Platform, share: float
) -> dict[int, Vector3]:
    """Return outlying rows with how far they are off, at most one window of each stretch.

    The windows are those of a ``share`` of the record.
    """
    unlikely = np.sum((fit.left_own / sd) ** 2, axis=1)
    limit = chi_square_limit(3, ALARMS * share / len(fit.rows))
    suspects = np.flatnonzero(unlikely > limit)
    found: dict[int, Vector3] = {}
    taken = np.zeros(len(t), bool)
    for k in suspects[np.argsort(-unlikely[suspects])].tolist():
        if taken[fit.rows[k]].any():
            continue
        window = Window(t[fit.rows[k]], fit.basis[k], fit.y[k], sd[k])
        odd = odd_rows(window, _judged(fit, k), limit)
        if odd and _no_touch(window, odd, limit, platform):
            found |= dict(zip(fit.rows[k][list(odd)].tolist(), away(window, odd), strict=True))
            taken[fit.rows[k]] = True
    return found


def _judged(fit: LocalFit, k: int) -> tuple[int, ...]:
    """Return the places of a window that it can judge: not its ends, but those at an edge."""
    rows, middle = fit.rows.shape[1], fit.rows.shape[1] // 2
    first = 0 if fit.place[k] < middle or _alone(fit, k, -1) else ASIDE
    last = rows if fit.place[k] > middle or _alone(fit, k, 1) else rows - ASIDE
    return tuple(range(first, last))


def _alone(fit: LocalFit, k: int, side: int) -> bool:
    """Say whether no window about a neighbour reaches further than this one."""
    other = k + side
    if not 0 <= other < len(fit.rows):
        return True
    end = 0 if side < 0 else -1
    return bool(fit.rows[other, end] == fit.rows[k, end])


def _no_touch(window: Window, odd: tuple[int, ...], limit: float, platform: Platform) -> bool:
    """Say that no touch explains the window; each leaves much more than the odd rows do."""
    left = misfit(window, out(window, odd))
    inside = min(odd) >= ASIDE and max(odd) < len(window.t) - ASIDE
    interval = float(np.min(np.diff(window.t))) if platform.attitude else 1.0
    vague = UNSURE * float(np.linalg.norm(window.sd)) / interval
    most = max(PUSH * platform.speed, HAND) + vague if inside else TOUCH * platform.speed
    return touch_misfit(window, most, platform.attitude) - left > limit
