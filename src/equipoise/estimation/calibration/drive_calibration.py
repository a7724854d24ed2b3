"""What a fit with drives in doubt says of each drive, and which drives a record does not separate.

With x_g, x_v, x_w, x_b as in ``actuators.drive_errors``, and k = (1 + x_g) u + x_v v + x_w w,

    gain     = gain0 |k|
    axis     = k / |k|
    across   = atan2(k.v0, k.u0), atan2(k.w0, k.u0)        off the rail as it is stated, u0
    product  = m gain                                      first moment per metre of command
    backlash = x_b / |k|                                   in command
    scatter  = sqrt( sum error^2 / n ) / |k|               n = sum (1 - posterior / prior variance)

The fit is about a rail u near the true one: errors of stops act along u, and a rail that is
3 deg off would throw 1/20 of them aside, unexplained (0.05 um of com for 20 um of 0.7 kg in 14).

Masses that always move together in one pattern show the sum of their first moments only. With P the
posterior covariance of gains or of rails, each unknown over its prior sd, a record leaves the prior
as it was along the eigenvectors of

    (E - s s^T) P (E - s s^T),     s: all gains alike, the common scale, which is reported elsewhere

whose eigenvalue is near 1. Masses with a large part in one of them are not separated by it.

Cannot see weight and steps apart; nor a scatter of the first stop at home, which defines home; nor
a pattern of errors of stops, which have a prior that is stated.
"""

from dataclasses import dataclass

import numpy as np

from equipoise.actuators.drive_errors import drive_names
from equipoise.actuators.lost_motion import directions
from equipoise.maths.axes_across import axes_across
from equipoise.model.arrays import Floats, Ints, Series1, Vector3
from equipoise.model.estimate import Estimate, Parameter
from equipoise.model.reasons.data_reasons import Unexplained
from equipoise.model.reasons.reason import Reason
from equipoise.model.recording import Recording
from equipoise.model.testbed import SlidingMass

NUMBERS = 8  # that a drive has
SHOWN = 0.9  # of its prior's sd, chosen: what the record leaves wider it did not show
FEWEST = 1.0  # stops' worth of freedom, chosen, from which a scatter is reported
LARGE = 0.3  # of the greatest part of a mass, chosen: smaller ones come along by chance
KINDS = (("gains", (0,)), ("rails", (1, 2)))  # and which of a drive's columns they are
ALIKE = {"gains": Unexplained.GAINS_ALIKE, "rails": Unexplained.RAILS_ALIKE}


@dataclass(frozen=True, slots=True, eq=False)
class Drive:
    """A drive in doubt that travelled, and where the fit has its unknowns."""

    mass: SlidingMass  # as stated
    rail: Vector3  # unit vector u, about which it was fitted
    columns: Ints  # (4,) gain, across, across, backlash among the parameters; -1: not sought
    reverses: bool  # it came to stops from both sides

    @property
    def trusted(self) -> bool:
        """Say whether its weight and steps are trusted."""
        return self.columns[0] < 0


def drives_of(
    stated: tuple[SlidingMass, ...],
    about: tuple[SlidingMass, ...],
    recording: Recording,
    estimate: Estimate,
) -> tuple[Drive, ...]:
    """Return the drives in doubt of which a fit ``about`` masses with such rails says something.

    The recording's columns are the masses'.
    """
    index = {p.name: i for i, p in enumerate(estimate.parameters)}
    found: list[Drive] = []
    for i, (mass, guess) in enumerate(zip(stated, about, strict=True)):
        names = drive_names(mass.name)
        if names.across[0] in index:
            assert recording.masses is not None
            ways = directions(recording.masses.t, recording.masses.values[:, i], mass.speed)
            columns = [index.get(n, -1) for n in (names.gain, *names.across, names.backlash)]
            both = len({way.sign for way in ways}) > 1
            found.append(Drive(mass, guess.axis, np.array(columns), both))
    return tuple(found)


def pull(drive: Drive, x: Floats) -> Vector3:
    """Return k, body axes."""
    g, v, w = (x[c] if c >= 0 else 0.0 for c in drive.columns[:3])
    across_1, across_2 = axes_across(drive.rail)
    k: Vector3 = (1.0 + g) * drive.rail + v * across_1 + w * across_2
    return k


def of_drive(drive: Drive, x: Floats) -> Floats:
    """Return gain, product, axis (3), across (2), backlash, (8,), SI, by the fit's parameters."""
    k, u, (v, w) = pull(drive, x), drive.mass.axis, axes_across(drive.mass.axis)
    size, b = np.sqrt(k @ k), drive.columns[3]
    gain = drive.mass.gain * (1.0 if drive.trusted else size)
    off = np.arctan2([k @ v, k @ w], k @ u)
    backlash = x[b] / size if b >= 0 else 0.0
    return np.array([gain, drive.mass.mass * gain, *k / size, *off, backlash])


def labels_of(drive: Drive) -> list[tuple[str, str]]:
    """Return name and unit of each of these."""
    mass, names = drive.mass.name, drive_names(drive.mass.name)
    axis = [(f"axis_{mass}_{letter}", "1") for letter in "xyz"]
    angles = [(name, "rad") for name in names.across]
    return [(names.gain, "1"), (f"product_{mass}", "kg"), *axis, *angles, (names.backlash, "m")]


def shown(drive: Drive, sd: Series1, mixed: list[str]) -> list[bool]:
    """Say of each of these whether the record shows it, given the sd of all eight.

    ``mixed``: which of "gains" and "rails" it does not separate from other masses'.
    """
    doubt = drive.mass.doubt
    assert doubt is not None
    sure = bool(sd[0] < SHOWN * doubt.gain * drive.mass.gain) and "gains" not in mixed
    gain = drive.trusted or sure
    rail = "rails" not in mixed and bool(np.all(sd[5:7] < SHOWN * doubt.across))
    backlash = drive.reverses and bool(sd[7] < SHOWN * doubt.backlash)
    return [gain, gain, rail, rail, rail, rail, rail, backlash]


def scatter_of(drive: Drive, estimate: Estimate, size: float) -> Parameter:
    """Return how far the stops of a mass scatter, in command, with an sd for so few."""
    mass, name = drive.mass, f"scatter_{drive.mass.name}"
    stem = f"error_{mass.name}_"
    stops = [p for p in estimate.parameters if p.name.rpartition("_")[0] + "_" == stem]
    left = np.array([1.0 - (p.sd / mass.accuracy) ** 2 for p in stops])
    freedom = float(np.maximum(left, 0.0).sum())
    if freedom < FEWEST:
        return Parameter(name, "m", mass.accuracy, float("inf"), False)
    value = float(np.sqrt(sum(p.value**2 for p in stops) / freedom)) / size
    return Parameter(name, "m", value, max(value, mass.accuracy) / np.sqrt(2 * freedom))


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


def alike_reasons(
    drives: tuple[Drive, ...], found: dict[str, list[tuple[int, ...]]]
) -> list[Reason]:
    """Name the masses that a record does not separate."""
    return [
        Reason(ALIKE[kind], tuple(drives[i].mass.name for i in group))
        for kind, each in found.items()
        for group in each
    ]
