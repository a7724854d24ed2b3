"""The torque on a platform by cause: what each added, interval by interval, with its uncertainty.

    gravity   weight of the centre of mass, masses as they stand when the record begins
    sag       elastic sag of the structure under gravity
    drift     the centre of mass that moves at a constant rate
    warmth    the centre of mass that moves with temperature
    moves     masses that travel: the shift of com, of inertia, and the momentum of travel
    air       bearing and air: damping, constant torque, swirl, and what no other term explains
    contacts  touches and other impulses

Torques are means over each interval in body axes, N m. Devices of the experiment itself (wheels,
gyros, coils, jets) are commanded, no disturbance, and not among the causes.
"""

from dataclasses import dataclass

import numpy as np

from equipoise.model.arrays import Floats, Series1, Series3
from equipoise.model.estimate import NORMAL_95
from equipoise.model.outcome import Outcome
from equipoise.model.presentation import Plotted

GRAVITY, SAG, DRIFT, WARMTH, MOVES, AIR, CONTACTS = range(7)
CAUSES = ("gravity", "sag", "drift", "warmth", "moves", "air", "contacts")


@dataclass(frozen=True, slots=True, eq=False)
class MomentumClosure:
    """Measured change of angular momentum less the torque of all causes, interval by interval.

    Both are divided by the interval, so that they are torques. What is left has the noise of the
    measured rates: near 1 sd rms, or less, where the sum of the causes closes the balance.
    """

    left: Series3  # (n, 3) N m, body axes
    sd: Series3  # N m

    @property
    def normalised_rms(self) -> float:
        """Return the rms of what is left in sd, -."""
        return float(np.sqrt(np.mean((self.left / self.sd) ** 2)))

    @property
    def share_within(self) -> float:
        """Return the share of components within their 95 % band, -."""
        return float(np.mean(np.abs(self.left) <= NORMAL_95 * self.sd))


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class TorqueByCause(Plotted):
    """Mean torques over intervals of one length, body axes; causes in the order of ``causes``.

    Errors of causes are correlated, so that ``total_sd`` is not the root sum square of theirs.
    """

    t: Series1  # (n,) s, when each interval begins
    interval: float  # s
    causes: tuple[str, ...]  # (k,) among ``CAUSES``
    torque: Floats  # (n, k, 3) N m
    sd: Floats  # (n, k, 3) N m
    total: Series3  # (n, 3) N m
    total_sd: Series3  # N m
    unmodelled_sd: float  # N m per axis, of the torque that no term explains
    unmodelled_correlation: float  # s, of the same; NaN without any
    closure: MomentumClosure
    outcome: Outcome
    source: str = ""  # the recording
    sha256: str = ""

    def of(self, cause: str) -> tuple[Series3, Series3]:
        """Return torque and sd of a cause (n, 3), N m; KeyError if it is not among them."""
        k = {name: k for k, name in enumerate(self.causes)}[cause]
        return self.torque[:, k], self.sd[:, k]
