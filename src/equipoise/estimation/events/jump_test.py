"""The score test of each cut of a record for a jump there: the test behind every event.

With P, p the information and score of the rows behind a cut and C the covariance there given all
rows, a jump u of coordinates B has, other unknowns free,

    D = B^T (P - P C P) B,      u = D^-1 B^T p,      surprise = p_B^T D^-1 p_B

u is its estimate, D^-1 its covariance, and the surprise is chi-square of dim B degrees of freedom
when nothing jumped (Rao's score test; the generalised likelihood ratio of Willsky and Jones 1976;
for a cut whose jump has a prior, the standardised smoothed disturbance of de Jong and Penzer 1998).

A surprise counts as an event beyond a threshold of one false alarm in ``FALSE_ALARM`` seconds. Were
the tests at all cuts independent, as many would by chance exceed it; they are not, so that the rate
is lower.

A cut whose numbers are not finite, after a fit that went astray, says nothing.

Cannot see jumps at the very ends, where one side has too few rows.
"""

from typing import NamedTuple

import numpy as np

from equipoise.estimation.output_error.kernels.interval_smoother import Smoothed
from equipoise.estimation.parameters.fit_parameters import RATE, R
from equipoise.maths.chi_square import chi_square_limit
from equipoise.model.arrays import Floats, Series1
from equipoise.model.estimate import COM
from equipoise.model.estimate import RATE as RATES


class EventKind(NamedTuple):
    """What jumps in an event of one kind."""

    coordinates: slice
    names: tuple[str, ...]
    sd: float  # rad/s, m, chosen: any


KINDS = {"impulse": EventKind(RATE, RATES, 1.0), "com_step": EventKind(R, COM, 1e-3)}
FALSE_ALARM = 3600.0  # s between false alarms, at least
INFORMATIVE = 1e-6  # chosen: a smaller share of the information behind a cut is rounding


class Disturbances(NamedTuple):
    """One row a cut."""

    surprise: Series1  # chi-square
    jump: Floats  # (K - 1, b)
    information: Floats  # (K - 1, b, b) D
    score: Floats  # (K - 1, b)


def disturbances(smoothed: Smoothed, coordinates: slice) -> Disturbances:
    """Return the test of every inner cut for a jump of these coordinates."""
    P, C, B = smoothed.information[1:], smoothed.covariance[1:], coordinates
    p, PB = smoothed.score[1:, B], smoothed.information[1:, :, B]
    behind = P[:, B, B]
    all_rows = behind - np.einsum("kia,kij,kjb->kab", PB, C, PB, optimize=True)
    finite = np.isfinite(all_rows).all(axis=(1, 2)) & np.isfinite(p).all(axis=1)
    all_rows = np.where(finite[:, None, None], all_rows, 0.0)
    p = np.where(finite[:, None], p, 0.0)
    reported = finite & (
        np.linalg.eigvalsh(all_rows)[:, 0] > INFORMATIVE * np.einsum("kaa->k", behind)
    )
    D = np.where(reported[:, None, None], all_rows, np.eye(all_rows.shape[1]))
    jump = np.where(reported[:, None], np.linalg.solve(D, p[..., None])[..., 0], 0.0)
    return Disturbances(np.einsum("ka,ka->k", jump, p), jump, D, p)


def threshold(spacing: float) -> float:
    """Return the surprise (chi-square of 3) beyond which a cut is an event; ``spacing`` in s."""
    return chi_square_limit(3, spacing / FALSE_ALARM / len(KINDS))
