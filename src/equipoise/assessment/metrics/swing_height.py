"""How far below the centre of rotation the centre of mass hangs, by the periods of its swings.

    m g h = the moment at which ``swing_modes`` has the measured frequency

for each swing of roll and pitch (``period``), which is named by the ratio of both frequencies that
the inertia leads to: that ratio needs no h. Two swings that the record is too short to separate
appear as one between them, and h is known no better than that. A single swing is the one whose
shape the platform's motion has. Where the other one would not show, too slow for the record or
too near to a line of the spin, it may be there, and move the frequency by a part of 1/T.

The sd is that of the frequency, and that of the spin: at a tilt of a the platform turns about the
vertical, and not about its own axis, which is W (1 - a^2/2) or W. Where gyroscopic torques are
larger than gravity's, as they are where W^2 J > m g h, that error of second order comes back
enlarged by as much.

h is proportional to the inertia, whose sd is stated separately, as all metrics share it.

(da Silva 2021 section 5, where the period is said to fall as balance improves: it grows.)

Cannot determine a height from less than one swing, nor one above P.
"""

import math
from dataclasses import dataclass, replace

import numpy as np

from equipoise.assessment.metrics.period import LEAST_TURNS, Swing
from equipoise.assessment.metrics.spin_lines import SpinLines, is_separate
from equipoise.assessment.metrics.swing_modes import moment_for, swing_rates, swing_shapes
from equipoise.model.arrays import Floats, Matrix3, Vector3

RESOLVED = 1.0  # resolution widths, chosen: swings nearer than that are one
HIDDEN = 0.25  # resolution widths, chosen: what a swing that does not show moves another by
ALIKE = 0.8  # chosen: of a swing that is like its mode, to be named by it
AGREE = 4.0  # sd, chosen: beyond, two peaks are not the two swings


@dataclass(frozen=True, slots=True, eq=False)
class Hanging:
    """What one swing says of m g h."""

    swing: Swing
    mode: int | None  # 0: the slow one, 1: the quick one, None: both in one
    moment: float  # m g h, N m
    sd: float  # N m, but for the inertia
    down: Vector3  # of gravity in body axes, on average, along which h is


@dataclass(frozen=True, slots=True, eq=False)
class Turning:
    """A platform that turns about the vertical while it swings, of known inertia."""

    duration: float  # s, of the record
    inertia_P: Matrix3  # kg m^2
    down: Vector3  # of gravity in body axes, on average
    spin: float  # rad/s about the vertical
    spin_sd: float  # rad/s
    lines: SpinLines

    def shows(self, frequency: float) -> bool:
        """Say whether a swing of this frequency (Hz) would show."""
        turns = frequency * self.duration >= LEAST_TURNS
        return turns and is_separate(frequency, self.lines, self.duration)


def hanging(swings: tuple[Swing, ...], turning: Turning) -> tuple[Hanging, ...]:
    """Return what each swing says."""
    found = named(swings, turning)
    return tuple(each for each in found if np.isfinite(each.moment) and np.isfinite(each.sd))


def spin_doubt(swings: tuple[Swing, ...], spin: float) -> float:
    """Return the sd (rad/s) of a spin about the vertical during swings: W a^2 / 2."""
    return 0.5 * abs(spin) * sum(swing.amplitude**2 for swing in swings)


def named(swings: tuple[Swing, ...], turning: Turning) -> tuple[Hanging, ...]:
    """Return swings with their modes: two that belong together, or the stronger one."""
    if len(swings) == 2:
        pair = tuple(by_mode(swing, mode, turning) for mode, swing in enumerate(swings))
        separation = abs(pair[0].moment - pair[1].moment)
        doubt = 1 / (turning.duration * swings[0].frequency) * pair[0].moment
        if separation < AGREE * np.hypot(pair[0].sd, pair[1].sd) or separation < doubt:
            return pair
    if not swings:
        return ()
    return (alone(max(swings, key=lambda swing: swing.amplitude), turning),)


def by_mode(swing: Swing, mode: int, turning: Turning) -> Hanging:
    """Return m g h of a swing whose mode is known."""
    f, W = swing.frequency, turning.spin
    moment, later, quicker = (
        moment_for(2 * np.pi * frequency, mode, turning.inertia_P, turning.down, spin)
        for frequency, spin in ((f, W), (f + swing.sd, W), (f, W + turning.spin_sd))
    )
    sd = float(np.hypot(later - moment, quicker - moment))
    return Hanging(swing, mode, moment, sd, turning.down)


def alone(swing: Swing, turning: Turning) -> Hanging:
    """Return m g h of a swing that stands alone: one of both, or both in one."""
    pair = tuple(without_other(swing, mode, turning) for mode in (0, 1))
    middle = 0.5 * (pair[0].moment + pair[1].moment)
    if not np.isfinite(middle):  # faster, or slower, than the spin lets one of them be
        return pair[0] if np.isfinite(pair[0].moment) else pair[1]
    rates = swing_rates(middle, turning.inertia_P, turning.down, turning.spin)
    share = shares(pair, turning)
    resolved = (rates[1] - rates[0]) / (2 * np.pi) * turning.duration > RESOLVED
    if resolved and share.max() > ALIKE:
        return pair[int(np.argmax(share))]
    return as_one(pair, share)


def without_other(swing: Swing, mode: int, turning: Turning) -> Hanging:
    """Return m g h of a swing whose mode is known, and whose other one was not found."""
    found = by_mode(swing, mode, turning)
    if not np.isfinite(found.moment):
        return found
    rates = swing_rates(found.moment, turning.inertia_P, turning.down, turning.spin)
    other = float(rates[1 - mode]) / (2 * np.pi)
    one_peak = abs(other - swing.frequency) * turning.duration < RESOLVED
    if one_peak or turning.shows(other):
        return found
    doubt = math.hypot(swing.sd, HIDDEN / turning.duration)
    return replace(by_mode(replace(swing, sd=doubt), mode, turning), swing=swing)


def as_one(pair: tuple[Hanging, ...], share: Floats) -> Hanging:
    """Return m g h of two swings that appear as one."""
    slow, quick = pair
    moment = float(share @ [slow.moment, quick.moment])
    sd = math.hypot(max(slow.sd, quick.sd), 0.5 * abs(slow.moment - quick.moment))
    return Hanging(slow.swing, None, moment, sd, slow.down)


def shares(pair: tuple[Hanging, ...], turning: Turning) -> Floats:
    """Return how much a swing is like each mode (2,), in sum 1, were the height as that has it."""
    like = np.empty(2)
    for mode, each in enumerate(pair):
        shape = swing_shapes(each.moment, turning.inertia_P, turning.down, turning.spin)[mode]
        like[mode] = abs(np.vdot(shape, each.swing.shape)) ** 2
    return like / like.sum()
