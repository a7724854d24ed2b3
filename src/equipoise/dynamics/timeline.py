"""The times at which a record is integrated, and what is known at each of them.

The grid holds every corner of the known inputs (mass displacements, stored momentum, torque), so
that inputs are straight lines within a step. Between these, steps are as long as the motion allows.
Sensors measure either at nodes of their own, or anywhere within a step (``at_nodes`` false). There
the fit reads the state by cubic interpolation: a fast sensor costs no more steps than a slow one.
"""

from typing import NamedTuple

import numpy as np

from equipoise.maths.straight_lines import bends, read_at
from equipoise.model.arrays import Floats, Ints, Series1
from equipoise.model.errors import InputError
from equipoise.model.recording import Samples

TURN_PER_STEP = 0.1  # rad; RK4 then errs by less than 1e-7 rad a step
MOST_STEPS = 4_000_000  # chosen: half an hour at 500 deg/s by the best sensors, twice as fine
SAME = 1e-9  # s, chosen: far beyond rounding; means over a shorter step would be rounding alone


class Timeline(NamedTuple):
    """Grid of n + 1 nodes; a step leads from each node to the next."""

    t: Floats  # (n+1,) s
    known: Floats  # (n+1, 7 + k + f): wheel momentum N m s, torque N m, temperature above that at
    # the start K, displacements m, and the masses' shares of the unknown errors
    owners: Ints  # (f, 2) the mass that each of these columns is of, and the unknown
    attitude_node: Ints  # (n_q,) where the attitude was measured: this node
    attitude_share: Floats  # (n_q,) and this share of the step that leaves it
    rate_node: Ints  # (n_w,) the same for the rate
    rate_share: Floats  # (n_w,)


def fill(times: Series1, longest: float) -> Series1:
    """Return ``times`` with steps longer than ``longest`` (s) cut into equal parts."""
    lengths = np.diff(times)
    counts = np.maximum(np.ceil(lengths / longest - 1e-9), 1)
    if not len(counts) or counts.max() == 1:
        return times
    check_steps(times, longest, float(counts.sum()))
    parts = counts.astype(int)
    starts = np.repeat(times[:-1], parts)
    lengths = np.repeat(lengths / parts, parts)
    within = np.arange(int(parts.sum())) - np.repeat(np.cumsum(parts) - parts, parts)
    return np.append(starts + within * lengths, times[-1])


def check_steps(times: Series1, longest: float, steps: float) -> None:
    """Raise InputError for times (s) between which integration would not end."""
    if steps > MOST_STEPS:
        found = (
            f"{times[-1] - times[0]:.4g} s from first to last, which takes {steps:.3g} steps of "
            f"{longest:.2g} s"
        )
        wanted = (
            f"at most {MOST_STEPS} steps: one clock, in seconds, without so long a gap; "
            "or a part of the record"
        )
        raise InputError("time", found, wanted)


def distinct(times: Series1) -> Series1:
    """Return times in order, without those that differ from the one before by rounding alone."""
    t = np.unique(times)
    return t[np.append(True, np.diff(t) > SAME)]


def straight_lines(channel: Samples | None, t: Series1, width: int) -> Floats:
    """Return a known input at times ``t``: straight between its rows, constant outside."""
    if channel is None or not len(channel):
        return np.zeros((len(t), width))
    return read_at(t, channel.t, channel.values) if width else np.zeros((len(t), 0))


def warmth(temperature: Samples | None, t: Series1) -> Floats:
    """Return by how much (K) it is warmer at times ``t`` (s) than at the first, (n, 1)."""
    found = straight_lines(temperature, t, 1)
    return found - found[0]


def corners(channel: Samples | None, start: float, end: float) -> Series1:
    """Return the times inside (start, end) at which a known input bends."""
    if channel is None or len(channel) < 2:
        return np.zeros(0)
    moves = np.any(channel.values[[1, -1]] != channel.values[[0, -2]], axis=1)
    keep = np.concatenate([moves[:1], bends(channel.t, channel.values), moves[1:]])
    inside = channel.t[keep]
    return inside[(inside > start) & (inside < end)]


def timeline(
    attitude_t: Series1,
    rate_t: Series1,
    masses: Samples | None,
    n_masses: int,
    longest: float,
    momentum: Samples | None = None,
    torque: Samples | None = None,
    errors: Samples | None = None,
    owners: Ints | None = None,
    at_nodes: bool = True,
    cut: Series1 | None = None,
    temperature: Samples | None = None,
) -> Timeline:
    """Return the grid for sensors that measured at these times (s), with nodes at every ``cut``.

    A temperature is so slow that it needs no nodes.
    """
    observed = np.concatenate([attitude_t, rate_t])
    start, end = float(observed.min()), float(observed.max())
    knots = [corners(c, start, end) for c in (masses, momentum, torque, errors)]
    firm = observed if at_nodes else np.array([start, end])
    inner = np.zeros(0) if cut is None else cut
    t = fill(distinct(np.concatenate([firm, inner, *knots])), longest)
    owners = np.zeros((0, 2), dtype=np.int64) if owners is None else owners
    outside = (straight_lines(channel, t, 3) for channel in (momentum, torque))
    inside = ((masses, n_masses), (errors, len(owners)))
    own = (straight_lines(channel, t, width) for channel, width in inside)
    return Timeline(
        t,
        np.hstack([*outside, warmth(temperature, t), *own]),
        owners,
        *place(t, attitude_t),
        *place(t, rate_t),
    )


def place(t: Series1, observed: Series1) -> tuple[Ints, Floats]:
    """Return the node at or before each time, and the share of the step behind it."""
    node = np.searchsorted(t, observed, side="right") - 1
    length = np.append(np.diff(t), 1.0)
    return node.astype(np.int64), (observed - t[node]) / length[node]
