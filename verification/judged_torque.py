"""A torque by cause against the truth of its platform: errors in units of their stated sd."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from equipoise.model.estimate import NORMAL_95
from equipoise.model.torque_by_cause import CAUSES, TOTAL, TorqueByCause

LEAST_SD = 5e-9  # N m, chosen: the integrals of the truth err by a tenth of it
Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Judged:
    """One record against its truth."""

    kind: str
    z: Array  # (n, causes, 3) error in sd; NaN where there is no such cause
    total: Array  # (n, 3) the same of the sum
    closure: float  # rms of what is left of the balance, in sd


def judged_by(kind: str, found: TorqueByCause, true: Mapping[str, Array]) -> Judged:
    """Return a ledger against the true mean torques of its first seconds, N m, by cause."""
    n = len(true[TOTAL])
    z = np.full((n, len(CAUSES), 3), np.nan)
    for k, name in enumerate(CAUSES):
        if name in found.causes and name in true and np.any(true[name]):
            torque, sd = (each[:n] for each in found.of(name))
            shown = sd > LEAST_SD
            z[:, k][shown] = ((torque - true[name]) / np.maximum(sd, LEAST_SD))[shown]
    total = (found.total[:n] - true[TOTAL]) / found.total_sd[:n]
    return Judged(kind, z, total, found.closure.normalised_rms)


def share(z: Array) -> float:
    """Return the share of errors within 95 % intervals."""
    known = z[np.isfinite(z)]
    return float(np.mean(np.abs(known) <= NORMAL_95)) if known.size else np.nan
