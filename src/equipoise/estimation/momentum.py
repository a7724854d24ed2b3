"""The momentum integral as an estimator: least squares on the rows of ``momentum_integral``.

One factory for both axes. The noise is taken from the residual, widened for the correlation of
neighbouring rows; errors of the masses are carried over by solving again with each of them one sd
off.

Cannot see the common scale of J and mu without a known move or stored momentum; and its sd does
not know that noise in the rates biases J towards zero, which the outcome says.
"""

from dataclasses import replace

import numpy as np

from equipoise import __version__
from equipoise.actuators.mass_errors import mass_errors
from equipoise.dynamics.timeline import straight_lines
from equipoise.estimation.momentum_integral import Axes, Balance, balance
from equipoise.estimation.observability import OPEN
from equipoise.estimation.ratios import ratios_of
from equipoise.estimation.sampled_motion import SampledMotion, common_rows, sampled_motion
from equipoise.estimation.unknowns import Layout
from equipoise.maths.linalg import inverse_spd, lag_one, unpack_symmetric
from equipoise.maths.scaled_solve import scaled_solve
from equipoise.model.arrays import Floats, Square
from equipoise.model.estimate import COM, INERTIA, Estimate, Parameter, Residual
from equipoise.model.mass_properties import MassProperties, is_possible
from equipoise.model.outcome import Outcome
from equipoise.model.recording import Recording, Samples, arranged
from equipoise.model.testbed import Testbed
from equipoise.model.torque_terms import unit_of

FEWEST = 12  # rows
NOTE = (
    " Noise in the rates biases a linear estimate of the inertia towards zero, and the intervals "
    "do not know it: use the trajectory method for numbers to rely on."
)


def solve(rows: Balance, trace: float | None) -> tuple[Floats, Square, Floats]:
    """Return solution, normal matrix and residual; ``trace`` (kg m^2) fixes an open scale."""
    normal, right = rows.regressor.T @ rows.regressor, rows.regressor.T @ rows.known
    fixed = normal.copy()
    if trace is not None:
        row = np.zeros(len(right))
        row[:3] = np.sqrt(np.trace(normal[:3, :3])) / trace  # as large as the rows of J
        fixed += 1e6 * np.outer(row, row)
        right = right + 1e6 * row * row[0] * trace
    found = scaled_solve(fixed, right, 1e-14)
    return found, fixed, rows.known - rows.regressor @ found


def error_spread(
    recording: Recording,
    testbed: Testbed,
    layout: Layout,
    motion: SampledMotion,
    axes: Axes,
    best: Floats,
) -> Square:
    """Return the covariance that the accuracy of the stops and the lag of the masses add."""
    added = np.zeros((len(best), len(best)))
    errors = mass_errors(recording.masses, testbed.masses)
    for k, sd in enumerate(errors.sd):
        assert errors.felt is not None
        t, felt = errors.felt.t, errors.felt.values
        moved = straight_lines(recording.masses, t, len(testbed.masses))
        for j in np.flatnonzero(errors.owner[:, 1] == k):
            moved[:, errors.owner[j, 0]] += sd * felt[:, j]
        off = replace(recording, masses=Samples(t, moved))
        change = solve(balance(off, testbed, layout, *motion, axes), None)[0] - best
        added += np.outer(change, change)
    return added


def named(
    values: Floats, covariance: Square, terms: tuple[str, ...], seen: bool
) -> tuple[Parameter, ...]:
    """Return the parameters in the order com, inertia, torques."""
    names = [*INERTIA, *COM, *terms]
    units = ["kg m2"] * 6 + ["m"] * 3 + [unit_of(term) for term in terms]
    sd = np.sqrt(np.diag(covariance)) if seen else np.full(len(values), np.inf)
    return tuple(
        Parameter(names[k], units[k], float(values[k]), float(sd[k]), seen)
        for k in order_of(len(values))
    )


def order_of(n: int) -> list[int]:
    """Return the order of report: centre of mass first."""
    return [6, 7, 8, 0, 1, 2, 3, 4, 5, *range(9, n)]


def outcome_of(values: Floats, mass: float, scale_open: bool) -> Outcome:
    """Return whether the solution is a body that can exist, and what to think of it."""
    body = MassProperties(mass, values[6:9], unpack_symmetric(values[:6]))
    text = "The scale is open: only ratios are known." if scale_open else "A linear estimate."
    if not is_possible(body):
        return Outcome(False, "No body can have the inertia found. " + text + NOTE)
    return Outcome(True, text + NOTE)


def estimate(
    recording: Recording, testbed: Testbed, axes: Axes, terms: tuple[str, ...] = ()
) -> Estimate:
    """Return the estimate; needs attitude or rates, and tilt in two directions."""
    recording = arranged(recording, testbed.mass_names)
    method, mass = f"momentum_{axes}", testbed.body.mass
    seen = common_rows(recording)
    if seen < FEWEST:
        outcome = Outcome(False, f"Only {seen} rows: the integral has nothing to fit.")
        return Estimate(method, outcome, (), np.zeros((0, 0)))
    motion = sampled_motion(recording, testbed)
    layout = Layout(terms)
    rows = balance(recording, testbed, layout, *motion, axes)
    scale_open = not np.any(rows.known)
    trace = float(np.trace(testbed.body.inertia_P)) if scale_open else None
    best, normal, left = solve(rows, trace)
    correlation = min(max(lag_one(left.reshape(-1, 3)), 0.0), 0.99)
    noise = float(left @ left) / (len(left) - len(best)) * (1 + correlation) / (1 - correlation)
    covariance = noise * inverse_spd(normal)
    if not scale_open:
        covariance = covariance + error_spread(recording, testbed, layout, motion, axes, best)
    n = 9 + len(terms)
    per = np.append(np.ones(6), [1 / mass] * 3 + [1.0] * len(terms))
    values, covariance = best[:n] * per, covariance[:n, :n] * per[:, None] * per
    outcome = outcome_of(values, mass, scale_open)
    return Estimate(
        method,
        outcome,
        named(values, covariance, terms, not scale_open),
        covariance[np.ix_(order_of(n), order_of(n))],
        Residual(None, None, float(len(left)), len(left) - len(best), correlation),
        (OPEN,) if scale_open else (),
        ratios_of(values[:9], covariance[:9, :9], np.zeros((9, 0))) if scale_open else (),
        outcome.usable,
        {"version": __version__, "source": recording.source, "sha256": recording.sha256},
    )
