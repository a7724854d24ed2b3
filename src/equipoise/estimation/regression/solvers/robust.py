"""Robust least squares: outliers count with their distance, not its square.

    minimise sum_k rho(|e_k| / s),    weight 1 up to 1.5 s, then 1.5 s / |e_k|        (Huber 1964)

by reweighting until it settles; s by the median of |e_k|. The free constants of each piece are
weighted as their rows are.
"""

from dataclasses import replace

import numpy as np

from equipoise.estimation.regression.formulations.rows import Rows, centred
from equipoise.estimation.regression.solvers.least_squares import Aid, normal_of, solved
from equipoise.model.arrays import Floats, Series1

LIMIT = 1.5  # s, chosen: of white noise in three axes nearly all rows are within 3 s
ROUNDS, SETTLED = 30, 1e-9
MEDIAN = {1: 0.6745, 3: 1.5382}  # of |e| / s for so many equations of unit normal noise


def weights_of(left: Floats) -> Series1:
    """Return the weight of every time."""
    size = np.linalg.norm(left, axis=1)
    scale = max(float(np.median(size)) / MEDIAN[left.shape[1]], 1e-300)
    limit = LIMIT * MEDIAN[left.shape[1]] * scale
    return np.minimum(1.0, limit / np.maximum(size, 1e-300))


def robust(rows: Rows, aid: Aid) -> Floats:
    """Return the solution."""
    weight, found = np.ones(len(rows.t)), np.zeros(len(rows.names))
    for _ in range(ROUNDS):
        part, root = centred(rows, weight), np.sqrt(weight)
        before = found
        found = solved(*normal_of(replace(part, A=part.A * root[:, None, None],
                                          b=part.b * root[:, None])))  # fmt: skip
        if np.all(np.abs(found - before) <= SETTLED * np.abs(found)):
            break
        weight = weights_of(part.b - part.A @ found)
    return found
