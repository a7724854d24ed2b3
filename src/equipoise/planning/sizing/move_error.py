"""The effect of one move on platforms, and the offset that it leaves of each, by cause.

A measurement found a platform's centre of mass off by f where it is off by e. Whole steps are
allocated to the masses as in a feedback loop (``actuators.mass_allocation``), which changes their
commands by D; with g_i = (m_i / M) u_i, the remaining offset is

    e + sum g_i (D_i + dp_i + ds_i) + rails  =  (e - f)      measurement
                                              + (f + sum g_i D_i)      steps
                                              + sum g_i ds_i           stops
                                              + sum g_i dp_i           backlash
                                              + rails

    p     where a carriage stands in its play: p -> clip(p - D, -b/2, b/2); b backlash
    s     the error of a stop: drawn anew, with the accuracy, for each mass that was taken along.
          Its last error goes with it, although f may include it.
    rails sum D_i m_i / M times the lean of rail i, a small vector across it, the same for all moves

A move that is expected to leave more than the present offset is not made; the offset that it would
have undone counts with the stops. A mass that has stopped before is expected to change by the
errors of two stops.

On rails at right angles whose finest steps shift by q, steps leave q / sqrt(12) along each. Several
equal masses on one rail are no finer than one; a fine one beside a coarse one is, as far as it
goes. ``balance`` moves fewer masses, and none whose stop adds more than it mends, and finds better
combinations of steps on skew rails: it leaves somewhat less.

Lag, sag and mass errors are not modelled: they show in the next measurement.
"""

from typing import NamedTuple

import numpy as np
import scipy

from equipoise.actuators.mass_allocation import allocate, rails_of
from equipoise.actuators.sliding_masses import shift_by_travel
from equipoise.model.arrays import Bools, Floats, Series, Series1, Series3
from equipoise.model.testbed import Testbed


class Standing(NamedTuple):
    """Platforms and their masses as they stand, one row each."""

    error: Series3  # m, centre of mass from where it is wanted
    commanded: Series  # (n, k) m, where masses were commanded to go
    play: Series  # (n, k) m, where they stand in their play
    slip: Series  # (n, k) m, the errors of their stops
    lean: Floats  # (n, k, 3) -, shift of the centre of mass across each rail, by travel


class Left(NamedTuple):
    """The offset that a move left of each platform, m, by cause; without the measurement."""

    steps: Series3
    stops: Series3
    backlash: Series3
    rails: Series3
    moved: Bools  # (n, k)


def at_home(testbed: Testbed, error: Series3, normals: Series, rail_lean: float) -> Standing:
    """Return platforms whose masses stand at home; ``normals`` (n, 2 k) draw their rails' lean."""
    n, k = len(error), len(testbed.masses)
    across = [
        scipy.linalg.null_space(mass.axis[None]).T * mass.mass for mass in testbed.masses
    ]  # (2, 3) each
    ways = rail_lean / testbed.body.mass * np.array(across)
    lean = np.einsum("nkj,kjc->nkc", normals.reshape(n, k, 2), ways)
    still = np.zeros((n, k))
    return Standing(error, still, still, still, lean)


def move(
    testbed: Testbed, now: Standing, found: Series3, normals: Series, rail_lean: float
) -> tuple[Standing, Left]:
    """Return platforms after a move that should undo offsets ``found`` (m), and what it left."""
    gain = shift_by_travel(testbed)
    best = allocated(testbed, now.commanded, found)
    change = best * is_worth_it(testbed, now, found, best, rail_lean)[:, None]
    half = 0.5 * np.array([mass.backlash for mass in testbed.masses])
    play = np.clip(now.play - change, -half, half)
    taken: Bools = np.abs(now.play - change) > half
    accuracy = np.array([mass.accuracy for mass in testbed.masses])
    slip = np.where(taken, accuracy * normals, now.slip)
    left = Left(
        found + best @ gain,
        (slip - now.slip + change - best) @ gain,
        (play - now.play) @ gain,
        np.einsum("nk,nkc->nc", change, now.lean),
        change != 0,
    )
    error = now.error - found + left.steps + left.stops + left.backlash + left.rails
    return Standing(error, now.commanded + change, play, slip, now.lean), left


def allocated(testbed: Testbed, reported: Series, found: Series3) -> Series:
    """Return the changes (m) of the commands that best undo the offsets found."""
    rails = rails_of(testbed.masses, testbed.body.mass)
    wanted = reported @ shift_by_travel(testbed) - found
    goals = [allocate(rails, here, shift) for here, shift in zip(reported, wanted, strict=True)]
    return np.array(goals) - reported


def is_worth_it(
    testbed: Testbed, now: Standing, found: Series3, change: Series, rail_lean: float
) -> Bools:
    """Say of each platform whether a change (m) is expected to leave less than was found."""
    gain = shift_by_travel(testbed)
    size: Series1 = np.sum(gain**2, axis=1)
    accuracy = np.array([mass.accuracy for mass in testbed.masses])
    draws = (change != 0) * (1.0 + (now.slip != 0))
    rails: Series1 = 2 * rail_lean**2 * change**2 @ size
    missed = np.sum((found + change @ gain) ** 2, axis=1)
    return missed + draws @ (size * accuracy**2) + rails < np.sum(found**2, axis=1)
