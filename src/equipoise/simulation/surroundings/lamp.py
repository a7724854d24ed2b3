"""A lamp at the simulated bench: how warm it makes the platform, and what is recorded of that.

    tau W' = warms u - W      u: 1 on, 0 off;  W: K above the platform that no lamp shines on

in closed form between one switch and the next (``simulation.followers``). The nodes hold every
switch, and lie so close that straight lines between them err by less than 2e-6 of ``warms``.

Temperature and switch are recorded as on a bench: T at its own times with its noise, u wherever
the lamp is switched and at both ends of each read.
"""

import numpy as np

from equipoise.model.arrays import Bools, Floats, Series1
from equipoise.model.defects import TrueLamp
from equipoise.model.devices import Lamp, Thermometer
from equipoise.model.recording import Samples
from equipoise.simulation.clock import multiples, samples, tick
from equipoise.simulation.followers import Followers, at_rest, driven, followed

FINE = 250  # nodes in a time constant, chosen: a straight line errs by 1 / (8 FINE^2) of the step
AIR = 20.0  # degC, chosen: of the room


def lamp_of(stated: Lamp | None, true: TrueLamp | None) -> Followers:
    """Return the warmth (K) that follows a lamp's switches; of no lamp where there is none."""
    if true is None:
        return at_rest(np.zeros(0), np.zeros(0), np.zeros(0))
    warms, slow = true.warms, true.time_constant
    if stated is not None:
        warms, slow = warms or stated.warms, slow or stated.time_constant
    assert warms is not None
    assert slow is not None
    start = warms * power_at(true, np.zeros(1))[0]
    found = at_rest(np.array([slow]), np.array([np.inf]), np.zeros(1), start)
    for t in switches(true):
        found = driven(found, float(t), {0: warms * float(power_at(true, t[None])[0, 0])}, {})
    return found


def switches(true: TrueLamp | None) -> Series1:
    """Return when a lamp is switched, s."""
    if true is None:
        return np.zeros(0)
    t = tick(true.on.ravel())
    return t[t > 0]


def power_at(true: TrueLamp, t: Series1) -> Floats:
    """Return the share of its power that a lamp has at times (s), (n, 1)."""
    changes = np.searchsorted(tick(true.on.ravel()), t, side="right")
    return (changes % 2)[:, None].astype(np.float64)


def warmth_at(lamp: Followers, t: Series1) -> Floats:
    """Return by how much (K) a lamp has warmed the platform at times (s), (n, 1)."""
    y, _ = followed(lamp, t)
    return y.sum(axis=1, keepdims=True)


def warmth_since_start(lamp: Followers, t: Series1) -> Floats:
    """Return by how much (K) it is warmer at times (s) than at time zero, (n, 1)."""
    return warmth_at(lamp, t) - warmth_at(lamp, np.zeros(1))


def lamp_nodes(lamp: Followers, start: float, end: float) -> Series1:
    """Return the times in (start, end] between which warmth is a straight line, s."""
    grids = [multiples(float(slow) / FINE, start, end) for slow in lamp.lag]
    return np.concatenate([lamp.t, *grids])


def power_rows(true: TrueLamp | None, start: float, end: float) -> Samples | None:
    """Return the recorded switch from ``start`` to ``end`` (s); None where there is no lamp."""
    if true is None:
        return None
    t = switches(true)
    t = np.unique(np.concatenate([[start], t[(t > start) & (t < end)], [end]]))
    return Samples(t, power_at(true, t))


def is_lit(stated: Lamp | None, true: TrueLamp | None, t: Series1) -> Bools:
    """Say at which times (s) the lamp that a sun sensor sees is on; always where it has no switch.

    A lamp without a direction is a heater, and has nothing to do with it.
    """
    if stated is None or stated.direction_N is None or true is None:
        return np.ones(len(t), dtype=np.bool_)
    return power_at(true, t)[:, 0] > 0


def temperature_rows(
    lamp: Followers, sensor: Thermometer | None, after: float, until: float,
    rng: np.random.Generator,
) -> Samples | None:  # fmt: skip
    """Return what a thermometer gave in (after, until] s, degC; None where there is none."""
    if sensor is None:
        return None
    t = samples(sensor.rate, after, until)
    noise = sensor.noise * rng.standard_normal((len(t), 1))
    return Samples(t, AIR + warmth_at(lamp, t) + noise)
