"""Han's tracking differentiator: a signal filtered, its slope and its integral, all equally late.

With x1 = v1 - v for a signal v and a step h (Han 2009; used by Xu 2015):

    v1+ = v1 + h v2,      v2+ = v2 + h fhan(v1 - v, v2, r0, h0)

    fhan:  d = r0 h0,  d0 = h0 d,  y = x1 + h0 x2,  a0 = sqrt(d^2 + 8 r0 |y|)
           a = x2 + sgn(y) (a0 - d) / 2  where |y| > d0,    x2 + y / h0  elsewhere
           fhan = -r0 sgn(a)             where |a| > d,     -r0 a / d    elsewhere

Where neither bound is met, v1 is v through 1 / (1 + h0 s)^2: critically damped, 2 h0 late. r0 is
the greatest slope of v2; ``pace_for`` takes it from the signal so large that no bound is ever met,
for only a filter that is linear, and the same for all, keeps a linear equation true.

    v0+ = v0 + h (v1 + v1+) / 2

is the extended differentiator: the integral of v1, hence as late as v1. The slope given is the mean
of v2 before and after a row: v2 alone is v1's slope half a step later. The trapezoid is there for
the same reason; Xu's forward step is half a row off.

Channels are columns and know nothing of one another. Steps may be uneven, but shorter than h0. The
first rows, some 10 h0, still remember that every channel is taken to begin at rest.
"""

from typing import NamedTuple

import numpy as np

from equipoise.maths.kernels.compiled import kernel, part
from equipoise.model.arrays import Floats, Series, Series1

MARGIN = 4.0  # chosen: a jump as large as the whole range asks for 1.74 range / h0^2
SAMPLE, VALUE, SLOPE, BEFORE, INTEGRAL = range(5)  # rows of the state


class Pace(NamedTuple):
    """How fast each channel may be, and how much it is filtered."""

    r0: Floats  # (k,) greatest slope of v2, units of the channel / s^2
    h0: float  # s


class State(NamedTuple):
    """What is remembered from one row to the next."""

    t: float  # s
    v: Floats  # (5, k) the sample, v1, v2, the v2 before, v0


class Tracked(NamedTuple):
    """A filtered signal at its rows."""

    value: Series  # (n, k)
    slope: Series  # (n, k), per s
    integral: Series  # (n, k), times s


@part
def fhan(x1: float, x2: float, r0: float, h0: float) -> float:
    """Return the slope of v2 that brings (x1, x2) to rest soonest, without chatter."""
    d = r0 * h0
    y = x1 + h0 * x2
    if abs(y) > h0 * d:
        half = 0.5 * ((d * d + 8.0 * r0 * abs(y)) ** 0.5 - d)
        a = x2 + (half if y > 0.0 else -half)
    else:
        a = x2 + y / h0
    if abs(a) > d:
        return -r0 if a > 0.0 else r0
    return -r0 * a / d


@kernel
def _track(pace: Pace, state: tuple[float, Floats], t: Floats, signal: Floats, out: Floats) -> None:
    """Write value, slope and integral of every row, shape (n, 3, k); the state's array goes on."""
    before, v = state
    for i in range(t.shape[0]):
        h = t[i] - before
        before = t[i]
        for j in range(signal.shape[1]):
            old, slope = v[VALUE, j], v[SLOPE, j]
            pull = fhan(old - v[SAMPLE, j], slope, pace.r0[j], pace.h0)
            v[VALUE, j] = old + h * slope
            v[SLOPE, j] = slope + h * pull
            v[BEFORE, j] = slope
            v[INTEGRAL, j] += 0.5 * h * (old + v[VALUE, j])
            v[SAMPLE, j] = signal[i, j]
            out[i, 0, j] = v[VALUE, j]
            out[i, 1, j] = 0.5 * (v[SLOPE, j] + slope)
            out[i, 2, j] = v[INTEGRAL, j]


def pace_for(signal: Series, h0: float) -> Pace:
    """Return the pace at which a signal (n, k) never leaves the linear zone; h0 in s."""
    return Pace(MARGIN * np.maximum(np.ptp(signal, axis=0), 1e-30) / h0**2, h0)


def begin(t: float, sample: Floats) -> State:
    """Return the state before the row at ``t`` (s): every channel at its first sample (k,)."""
    v = np.zeros((5, len(sample)))
    v[SAMPLE] = v[VALUE] = sample
    return State(t, v)


def advance(pace: Pace, state: State, t: Series1, signal: Series) -> tuple[State, Tracked]:
    """Return the state after some rows (n, k), and what they are filtered to.

    Row by row or all at once comes to the same.
    """
    v, out = state.v.copy(), np.empty((len(t), 3, signal.shape[1]))
    _track(pace, (float(state.t), v), t, np.ascontiguousarray(signal), out)
    return State(float(t[-1]), v), Tracked(out[:, 0], out[:, 1], out[:, 2])


def track(pace: Pace, t: Series1, signal: Series) -> Tracked:
    """Return a signal filtered, from its first row on."""
    return advance(pace, begin(float(t[0]), signal[0]), t, signal)[1]


def track_twice(pace: Pace, t: Series1, signal: Series) -> Tracked:
    """Return a signal filtered by two differentiators in series: 4 h0 late."""
    return track(pace, t, track(pace, t, signal).value)
