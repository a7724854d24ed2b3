"""Numbers that are drawn as evenly as chance would draw them, and the offsets that they stand for.

Points of a scrambled Sobol sequence, turned into normal numbers: the same each time, and a mean
over them is nearer to the expected value than one over as many random numbers.
"""

import numpy as np
from scipy.special import ndtri
from scipy.stats import qmc

from equipoise.model.arrays import Bools, Matrix3, Series, Series3
from equipoise.planning.sizing.case import Case
from equipoise.planning.sizing.reachable_set import Reach, contains

EDGE = 1e-9  # chosen: normal numbers stay within six sd


def even_normals(power: int, columns: int) -> Series:
    """Return 2^power rows of standard normal numbers in so many independent columns."""
    points = qmc.Sobol(columns, scramble=True, seed=0).random_base2(power)
    return ndtri(np.clip(points, EDGE, 1 - EDGE))


def stated_offsets(case: Case, normals: Series) -> Series3:
    """Return where the centre of mass of platforms is, as stated, from the target (m)."""
    return case.testbed.body.com - case.target + case.testbed.com_sd * normals


def with_covariance(normals: Series, covariance: Matrix3) -> Series3:
    """Return vectors of this covariance (m^2)."""
    values, vectors = np.linalg.eigh(covariance)
    return normals * np.sqrt(np.maximum(values, 0.0)) @ vectors.T


def within_reach(reach: Reach, offsets: Series3) -> Bools:
    """Say of each offset (m) whether masses can undo all of it that lies along their span."""
    return contains(reach, -offsets @ reach.span @ reach.span.T)


def share_within(reach: Reach, offsets: Series3) -> float:
    """Return which share of offsets (m) can be undone."""
    return float(np.mean(contains(reach, -offsets)))
