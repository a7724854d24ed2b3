"""Which drives a record does not separate.

Masses that always move together in one pattern show the sum of their first moments only. With P the
posterior covariance of gains or of rails (``actuators.drive_errors``), each unknown over its prior
sd, a record leaves the prior as it was along the eigenvectors of

    (E - s s^T) P (E - s s^T),     s: all gains alike, the common scale, which is reported elsewhere

whose eigenvalue is near 1. Masses with a large part in one of them are not separated by it.

Cannot see a pattern of errors of stops; these have a prior that is stated.
"""

import numpy as np

from equipoise.estimation.calibration.drive_calibration import SHOWN, Drive
from equipoise.model.arrays import Floats, Ints
from equipoise.model.reasons.data_reasons import Unexplained
from equipoise.model.reasons.reason import Reason

LARGE = 0.3  # of the greatest part of a mass, chosen: smaller ones come along by chance
KINDS = (("gains", (0,)), ("rails", (1, 2)))  # and which of a drive's columns they are
ALIKE = {"gains": Unexplained.GAINS_ALIKE, "rails": Unexplained.RAILS_ALIKE}


def together(drives: tuple[Drive, ...], covariance: Floats) -> dict[str, list[tuple[int, ...]]]:
    """Return, of gains and of rails, the groups of drives (their indices) not separated."""
    found: dict[str, list[tuple[int, ...]]] = {}
    for kind, places in KINDS:
        sought = [(i, int(drive.columns[k])) for i, drive in enumerate(drives) for k in places
                  if drive.columns[k] >= 0]  # fmt: skip
        if sought:
            owner, columns = np.array(sought).T
            prior = np.array([prior_of(drives[i], kind) for i, _ in sought])
            P = covariance[np.ix_(columns, columns)] / np.outer(prior, prior)
            found[kind] = groups(without_scale(P) if kind == "gains" else P, owner)
    return found


def prior_of(drive: Drive, kind: str) -> float:
    """Return one sd of the prior of an unknown."""
    assert drive.mass.doubt is not None
    return drive.mass.doubt.gain if kind == "gains" else drive.mass.doubt.across


def without_scale(P: Floats) -> Floats:
    """Return a covariance of gains without what they share."""
    n = len(P)
    separation = np.eye(n) - np.full((n, n), 1 / n)
    return separation @ P @ separation


def groups(P: Floats, owner: Ints) -> list[tuple[int, ...]]:
    """Return the masses, two at least, that have a part in a direction left open."""
    values, vectors = np.linalg.eigh(P)
    found: set[tuple[int, ...]] = set()
    for direction in vectors[:, values > SHOWN**2].T:
        part = {int(i): float(np.linalg.norm(direction[owner == i])) for i in owner}
        most = max(part.values())
        found.add(tuple(i for i, size in part.items() if size > LARGE * most))
    return sorted(group for group in found if len(group) > 1)


def reasons_of(drives: tuple[Drive, ...], found: dict[str, list[tuple[int, ...]]]) -> list[Reason]:
    """Name the masses that a record does not separate."""
    return [
        Reason(ALIKE[kind], tuple(drives[i].mass.name for i in group))
        for kind, each in found.items()
        for group in each
    ]
