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

from equipoise.model.arrays import Floats, Series1
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


def at_rest(lag: Floats, limit: Floats, Y: Floats) -> Followers:
    """Return devices that stand at ``Y`` and are given nothing."""
    none, n = np.zeros((1, len(lag))), len(lag)
    return Followers(lag, limit, np.zeros(1), none, none, Y[None], np.full(n, -np.inf))


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
    past = devices.t < now
    kept = replace(devices, t=devices.t[past], goal=devices.goal[past], y=devices.y[past],
                   Y=devices.Y[past])  # fmt: skip
    goal, ends = _goal_at(devices, now).copy(), devices.ends.copy()
    for i, value in goals.items():
        goal[i] = value
        ends[i] = now + lasting[i] if i in lasting else -np.inf
    found = _with_row(kept if past.any() else devices, now, goal, bool(past.any()))
    for end in np.unique(tick(ends[ends > now])):
        goal = np.where(tick(ends) == end, 0.0, found.goal[-1])
        found = _with_row(found, float(end), goal, True)
    return replace(found, ends=ends)


def _goal_at(devices: Followers, t: float) -> Floats:
    return devices.goal[max(int(np.searchsorted(devices.t, t, side="right")) - 1, 0)]


def _with_row(devices: Followers, t: float, goal: Floats, keep: bool) -> Followers:
    """Return the devices with one more input, after those they have or (not ``keep``) alone."""
    y, Y = followed(devices, np.array([t]))
    if not keep:
        return replace(devices, t=np.array([t]), goal=goal[None], y=y, Y=Y)
    return replace(
        devices,
        t=np.append(devices.t, t),
        goal=np.vstack([devices.goal, goal]),
        y=np.vstack([devices.y, y]),
        Y=np.vstack([devices.Y, Y]),
    )


def without_past(devices: Followers, before: float) -> Followers:
    """Return the devices without what only matters before a time (s)."""
    first = max(int(np.searchsorted(devices.t, before, side="right")) - 1, 0)
    if first == 0:
        return devices
    return replace(devices, t=devices.t[first:], goal=devices.goal[first:], y=devices.y[first:],
                   Y=devices.Y[first:])  # fmt: skip


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
