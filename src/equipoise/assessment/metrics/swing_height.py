"""How far below the centre of rotation the centre of mass hangs, by the periods of its swings.

    m g h = the moment at which ``swing_modes`` has the measured frequency

for each swing of roll and pitch (``period``), which is named by the ratio of both frequencies that
the inertia leads to: that ratio needs no h. Two swings that the record is too short to separate
appear as one between them, and h is known no better than that. A single swing is the one about
whose axis the platform swung.

h is proportional to the inertia, whose sd is stated separately, as all metrics share it.

(da Silva 2021 section 5, where the period is said to fall as balance improves: it grows.)

Cannot determine a height from less than one swing, nor one above P.
"""

from dataclasses import dataclass

import numpy as np

from equipoise.assessment.metrics.period import Swing
from equipoise.assessment.metrics.swing_modes import moment_for, swing_axes, swing_rates
from equipoise.model.arrays import Floats, Matrix3, Vector3

RESOLVED = 1.0  # resolution widths, chosen: swings nearer than that are one
ALIKE = 0.8  # chosen: of a swing's direction along its axis, to be named by it
AGREE = 4.0  # sd, chosen: beyond, two peaks are not the two swings


@dataclass(frozen=True, slots=True)
class Hanging:
    """What one swing says of m g h."""

    swing: Swing
    mode: int | None  # 0: the slow one, 1: the quick one, None: both in one
    moment: float  # m g h, N m
    sd: float  # N m, of the frequency alone


def hanging(
    swings: tuple[Swing, ...], duration: float, inertia_P: Matrix3, down: Vector3, spin: float
) -> tuple[Hanging, ...]:
    """Return what each swing says; ``down`` and ``spin`` as in ``swing_modes``."""
    found = named(swings, duration, inertia_P, down, spin)
    return tuple(each for each in found if np.isfinite(each.moment) and np.isfinite(each.sd))


def named(
    swings: tuple[Swing, ...], duration: float, inertia_P: Matrix3, down: Vector3, spin: float
) -> tuple[Hanging, ...]:
    """Return swings with their modes: two that belong together, or the stronger one."""
    if len(swings) == 2:
        pair = tuple(
            by_mode(swing, mode, inertia_P, down, spin) for mode, swing in enumerate(swings)
        )
        separation = abs(pair[0].moment - pair[1].moment)
        doubt = 1 / (duration * swings[0].frequency) * pair[0].moment
        if separation < AGREE * np.hypot(pair[0].sd, pair[1].sd) or separation < doubt:
            return pair
    if not swings:
        return ()
    strongest = max(swings, key=lambda swing: swing.amplitude)
    return (alone(strongest, duration, inertia_P, down, spin),)


def by_mode(swing: Swing, mode: int, inertia_P: Matrix3, down: Vector3, spin: float) -> Hanging:
    """Return m g h of a swing whose mode is known."""
    at = [
        moment_for(2 * np.pi * f, mode, inertia_P, down, spin)
        for f in (swing.frequency, swing.frequency + swing.sd)
    ]
    return Hanging(swing, mode, at[0], abs(at[1] - at[0]))


def alone(swing: Swing, duration: float, inertia_P: Matrix3, down: Vector3, spin: float) -> Hanging:
    """Return m g h of a swing that stands alone: one of both, or both in one."""
    slow, quick = (by_mode(swing, mode, inertia_P, down, spin) for mode in (0, 1))
    middle = 0.5 * (slow.moment + quick.moment)
    if not np.isfinite(middle):  # faster, or slower, than the spin lets one of them be
        return slow if np.isfinite(slow.moment) else quick
    rates = swing_rates(middle, inertia_P, down, spin)
    share = shares(swing, middle, inertia_P, down)
    if (rates[1] - rates[0]) / (2 * np.pi) * duration > RESOLVED and share.max() > ALIKE:
        return (slow, quick)[int(np.argmax(share))]
    moment = float(share @ [slow.moment, quick.moment])
    sd = float(np.hypot(max(slow.sd, quick.sd), 0.5 * abs(slow.moment - quick.moment)))
    return Hanging(swing, None, moment, sd)


def shares(swing: Swing, moment: float, inertia_P: Matrix3, down: Vector3) -> Floats:
    """Return how much of a swing goes along each mode (2,), in sum 1."""
    along = (swing_axes(moment, inertia_P, down) @ np.array(swing.direction)) ** 2
    return along / along.sum()
