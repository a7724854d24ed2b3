"""Simple metrics of a free swing: the centre of mass by each, with its own uncertainty.

    torque    balance of torques by a Savitzky-Golay filter as long as the swing allows
    energy    balance of energy
    period    h from the period of each swing; ``spectrum`` shows where they were sought

All take the inertia as given: its error is common to all of them. They use the record after the
last mass had stopped. They are an independent check of the trajectory fit (``cross_checks``): none
of them shares its model of the sensors. Torque and energy estimate damping beside the centre of
mass where the fit has it. Their limits are those that their own files state.
"""

from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from equipoise.actuators.sliding_masses import inertia_shift, mass_maps
from equipoise.assessment.metrics.period import swings
from equipoise.assessment.metrics.spectrum import Spectrum, spectrum
from equipoise.assessment.metrics.spin_lines import heading, spin_lines
from equipoise.assessment.metrics.swing_height import Hanging, Turning, hanging, spin_doubt
from equipoise.assessment.metrics.swing_modes import across
from equipoise.estimation.method_contract import Options
from equipoise.estimation.methods.registry import METHODS
from equipoise.estimation.regression.formulations.energy import energy
from equipoise.estimation.regression.formulations.rows import Formulation, Posed
from equipoise.estimation.regression.formulations.torque import DEGREE, savitzky_golay, torque
from equipoise.estimation.regression.inverse_dynamics_torque import Draws, residual_torque
from equipoise.estimation.regression.linear_method import Linear, estimate, posed_of
from equipoise.estimation.regression.monte_carlo_replicates import Drawn, pairs
from equipoise.estimation.regression.solvers.least_squares import least_squares
from equipoise.maths.attitude import to_matrix
from equipoise.maths.linalg import unpack_symmetric
from equipoise.maths.sampled.savitzky_golay import slope_weights
from equipoise.model.arrays import Vector3
from equipoise.model.estimate import INERTIA, Estimate
from equipoise.model.noise_corrected_series import NoiseCorrectedSeries
from equipoise.model.reasons.cross_check_reasons import CrossCheckReason as Why
from equipoise.model.reasons.reason import Reason, one_reason, sentence_of
from equipoise.model.recording import Recording, arranged, window
from equipoise.model.testbed import Testbed

SHARP = 0.99  # chosen: of a swing, what a filter must leave
LONGEST = 0.25  # of the record, the longest window
SHORTEST = 0.51  # s, the window of ``torque_savitzky_golay``
FOR_NOISE = 8  # pairs of draws, chosen: the sd of the residual torque is known to a fifth
STANDS = 5e-4  # m, chosen: a soft drive that gives way by less stands still
FEWEST = 12  # rows, as for every linear method
SWINGS = "swings"


@dataclass(frozen=True, slots=True, eq=False)
class SwingMetrics:
    """The metrics; None where the record has too little for one."""

    duration: float  # s, since masses stood still
    window: float  # s, of the filter
    torque: NoiseCorrectedSeries | None
    torque_fit: Estimate | None
    energy: NoiseCorrectedSeries | None
    energy_fit: Estimate | None
    spectrum: Spectrum | None
    hanging: tuple[Hanging, ...]
    without_period: tuple[Reason, ...]  # why there is no period; empty: there is one

    @property
    def quiet(self) -> str:
        """Return why there is no period, for a person; empty: there is one."""
        return sentence_of(self.without_period)


def standing_part(recording: Recording) -> Recording:
    """Return the record since the last mass stopped."""
    masses = recording.masses
    if masses is None or len(masses) < 2:
        return recording
    away = np.flatnonzero(np.any(np.abs(masses.values - masses.values[-1]) > STANDS, axis=1))
    if not len(away):
        return recording
    return window(recording, float(masses.t[away[-1] + 1]), recording.span[1])


def as_one_body(recording: Recording, testbed: Testbed) -> tuple[Recording, Testbed]:
    """Return the record and the testbed of a platform whose masses belong to it where they stand.

    The testbed's inertia is then that of the whole, and what is found its centre of mass.
    """
    body, masses = testbed.body, recording.masses
    if masses is not None and len(masses) and testbed.masses:
        moved = inertia_shift(mass_maps(testbed.masses), masses.values[-1])
        body = replace(body, inertia_P=body.inertia_P + unpack_symmetric(moved))
    whole = replace(testbed, body=body, masses=(), disturbances=())
    return replace(recording, masses=None, mass_names=()), whole


def is_driven(recording: Recording) -> bool:
    """Say whether wheels or known torques act, so that no swing is a free one."""
    inputs = (recording.momentum, recording.torque)
    return any(c is not None and bool(np.any(np.ptp(c.values, axis=0) > 0)) for c in inputs)


def swing_metrics(
    recording: Recording, testbed: Testbed, damping: tuple[str, ...] = ()
) -> SwingMetrics:
    """Return the metrics; the testbed's inertia counts as known, terms of ``damping`` do not."""
    part = standing_part(arranged(recording, testbed.mass_names))
    start, end = part.span
    posed = posed_of(*as_one_body(part, testbed), Options(damping))
    if len(posed.motion.t) < FEWEST:
        few = one_reason(Why.FEW_ROWS, SWINGS, rows=len(posed.motion.t))
        return SwingMetrics(end - start, 0.0, None, None, None, None, None, (), few)
    found, observed, without = periods(posed)
    seconds = window_for(found, end - start, posed)
    draws = tuple(pairs(posed, Drawn()))
    slopes, some = torque(partial(savitzky_golay, seconds=seconds)), draws[:FOR_NOISE]
    return SwingMetrics(
        end - start,
        seconds,
        blunted(residual_torque(slopes, posed, some)),
        fit("torque_savitzky_golay", slopes, posed, draws),
        residual_torque(energy, posed, some, about_mean=True),
        fit("energy", energy, posed, draws),
        observed,
        found,
        without,
    )


def blunted(observed: NoiseCorrectedSeries) -> NoiseCorrectedSeries:
    """Return a torque with the filter's possible loss in its sd."""
    return replace(observed, rms_sd=float(np.hypot(observed.rms_sd, (1 - SHARP) * observed.rms)))


def fit(name: str, formulation: Formulation, posed: Posed, draws: Draws) -> Estimate:
    """Return the centre of mass by a linear formulation, J held."""
    return estimate(METHODS[name].card, Linear(formulation, least_squares), posed, INERTIA, draws)


def periods(posed: Posed) -> tuple[tuple[Hanging, ...], Spectrum, tuple[Reason, ...]]:
    """Return the heights by the swings, their spectrum, and why there are none."""
    motion = posed.motion
    n = -to_matrix(motion.q)[:, 2, :]
    down = direction(n.mean(axis=0))
    tilts = n @ across(down).T
    observed = spectrum(motion.t, tilts)
    if is_driven(posed.recording):
        return (), observed, one_reason(Why.DRIVEN, SWINGS)
    duration, spin = float(motion.t[-1] - motion.t[0]), -float(motion.w.mean(axis=0) @ down)
    lines = spin_lines(motion.t, heading(motion.t, motion.q, across(down)[0], spin))
    found = swings(motion.t, tilts, lines)
    if found:
        down = direction(down + across(down).T @ found[0].centre)
    doubt = spin_doubt(found, spin)
    turning = Turning(duration, posed.testbed.body.inertia_P, down, spin, doubt, lines)
    heights = hanging(found, turning)
    return heights, observed, () if heights else no_period(turning)


def no_period(turning: Turning) -> tuple[Reason, ...]:
    """Return why a record of free motion shows no period."""
    if not turning.lines.turns:
        return one_reason(Why.NO_SWING, SWINGS, duration=turning.duration)
    period = 2 * np.pi / abs(turning.spin)
    return one_reason(Why.NO_SWING_BESIDE_SPIN, SWINGS, duration=turning.duration, period=period)


def direction(vector: Vector3) -> Vector3:
    """Return the unit vector."""
    return vector / np.linalg.norm(vector)


def window_for(found: tuple[Hanging, ...], duration: float, posed: Posed) -> float:
    """Return the longest window (s) whose cubic leaves the quickest swing as it is."""
    period = float(np.median(np.diff(posed.motion.t)))
    covered = min(duration, period * len(posed.motion.t))  # by rows: a gap holds none
    longest = max(LONGEST * covered, SHORTEST)
    if not found:
        return longest
    quickest = max(each.swing.frequency for each in found)
    seconds = longest
    while seconds > SHORTEST and gain(seconds, period, quickest) < SHARP:
        seconds *= 0.9
    return max(seconds, SHORTEST)


def gain(seconds: float, period: float, frequency: float) -> float:
    """Return the share of a sine's slope that a cubic through a window gives."""
    rows = max(round(seconds / period) // 2 * 2 + 1, 2 * DEGREE - 1)
    weights = slope_weights(rows, DEGREE, period)
    at = period * (np.arange(rows) - rows // 2)
    omega = 2 * np.pi * frequency
    return float(weights @ np.sin(omega * at)) / omega
