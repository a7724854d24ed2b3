"""Devices that follow their inputs late, in closed form between one input and the next.

    y' = (input - y) / lag        y: slope of a wheel's speed, gimbal rate, dipole, jet torque
    Y' = y                        Y: wheel speed, gimbal angle; a wheel's stays within its limit

With x seconds since an input c was given, at y0 and Y0:

    y = c + (y0 - c) e^(-x / lag),    Y = Y0 + c x + (y0 - c) lag (1 - e^(-x / lag))

A pulse is an input that ends by itself. A wheel at its greatest speed stays there until it is
driven back: its drive has no more voltage.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from equipoise.model.arrays import Bools, Floats, Series1
from equipoise.simulation.clock import tick

SETTLES = 8.0  # lags after which what is left of a step no longer counts, chosen: e^-8 = 3e-4
PARTS = 4.0  # nodes in a lag, chosen: a straight line then errs by less than 1 % of the step


@dataclass(frozen=True, slots=True, eq=False)
class Followers:
    """n devices and their s inputs so far and to come; row i holds from t[i] on."""

    lag: Floats  # (n,) s
    limit: Floats  # (n,) greatest |Y|, infinite where there is none
    t: Series1  # (s,) s
    goal: Floats  # (s, n)
    y: Floats  # (s, n) at t
    Y: Floats  # (s, n) at t
    ends: Floats  # (n,) s, when the last pulse ends; before now: none is on


def at_rest(lag: Floats, limit: Floats, Y: Floats, y: Floats | None = None) -> Followers:
    """Return devices that stand at ``Y`` and are given what holds them at ``y``, else nothing."""
    held, n = np.zeros((1, len(lag))) if y is None else y[None], len(lag)
    return Followers(lag, limit, np.zeros(1), held, held, Y[None], np.full(n, -np.inf))


def followed(devices: Followers, t: Series1) -> tuple[Floats, Floats]:
    """Return y and Y at times (s), (m, n) each; before the first input they stood at rest."""
    row = np.maximum(np.searchsorted(devices.t, t, side="right") - 1, 0)
    x = np.maximum(t - devices.t[row], 0.0)[:, None]
    lag = np.maximum(devices.lag, 1e-12)
    goal, step = devices.goal[row], devices.y[row] - devices.goal[row]
    left = np.exp(-x / lag)
    Y = devices.Y[row] + goal * x + step * devices.lag * (1.0 - left)
    return goal + step * left, np.clip(Y, -devices.limit, devices.limit)


def driven(
    devices: Followers, now: float, goals: Mapping[int, float], lasting: Mapping[int, float]
) -> Followers:
    """Return the devices given new inputs now (s), by index; pulses end after ``lasting`` seconds.

    What is not named goes on as it was, pulses to their end.
    """
    past, latest = _rows(devices, devices.t < now), int(np.searchsorted(devices.t, now, "right"))
    goal, ends = devices.goal[max(latest - 1, 0)].copy(), devices.ends.copy()
    for i, value in goals.items():
        goal[i] = value
        ends[i] = now + lasting[i] if i in lasting else -np.inf
    found = _with_row(past if len(past.t) else devices, past, now, goal)
    for end in np.unique(tick(ends[ends > now])):
        goal = np.where(tick(ends) == end, 0.0, found.goal[-1])
        found = _with_row(found, found, float(end), goal)
    return replace(found, ends=ends)


def _rows(devices: Followers, keep: Bools | slice) -> Followers:
    """Return the devices with some of their inputs."""
    return replace(devices, t=devices.t[keep], goal=devices.goal[keep], y=devices.y[keep],
                   Y=devices.Y[keep])  # fmt: skip


def _with_row(devices: Followers, past: Followers, t: float, goal: Floats) -> Followers:
    """Return the devices given an input at ``t`` (s), after the inputs of ``past``."""
    y, Y = followed(devices, np.array([t]))
    return replace(
        past,
        t=np.append(past.t, t),
        goal=np.vstack([past.goal, goal]),
        y=np.vstack([past.y, y]),
        Y=np.vstack([past.Y, Y]),
    )


def without_past(devices: Followers, before: float) -> Followers:
    """Return the devices without what only matters before a time (s)."""
    first = max(int(np.searchsorted(devices.t, before, side="right")) - 1, 0)
    return _rows(devices, slice(first, None))


def bends(devices: Followers, start: float, end: float) -> Series1:
    """Return the times within (start, end] at which straight lines should break, s."""
    found = [devices.t]
    slow = float(devices.lag.max(initial=0.0))
    if slow > 0:
        fast = float(devices.lag[devices.lag > 0].min())
        after = np.arange(1.0, np.ceil(SETTLES * slow / fast * PARTS) + 1) * fast / PARTS
        found.append((devices.t[:, None] + after).ravel())
    t = tick(np.unique(np.concatenate(found)))
    return t[(t > start) & (t <= end)]
