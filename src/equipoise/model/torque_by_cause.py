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

from dataclasses import dataclass, replace

import numpy as np

from equipoise.model.arrays import Floats, Series1, Series3, Vector3
from equipoise.model.estimate import NORMAL_95
from equipoise.model.presentation import Plotted
from equipoise.model.reasons.reason import Reason
from equipoise.model.reasons.torque_reasons import TorqueReason
from equipoise.model.recording import Recording, Samples

GRAVITY, SAG, DRIFT, WARMTH, MOVES, AIR, CONTACTS = range(7)
SHOWN = 0.01  # of the band of the total, chosen: less is not worth a sentence
CLOSED = 1.5  # sd rms, chosen: half as much again as stated noise leaves
TOTAL = "total"
AXES = ("x", "y", "z")
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
        return float(np.sqrt(np.mean(self._tested**2))) if len(self._tested) else np.nan

    @property
    def share_within(self) -> float:
        """Return the share of components within their 95 % band, -."""
        return float(np.mean(np.abs(self._tested) <= NORMAL_95)) if len(self._tested) else np.nan

    @property
    def _tested(self) -> Series1:
        """Return what is left, in sd, of intervals with rows near both ends."""
        found = self.left / self.sd
        return found[np.isfinite(found)]

    @property
    def reason(self) -> Reason:
        """Return whether the balance closes."""
        numbers = {"rms": self.normalised_rms, "share": self.share_within}
        if not len(self._tested):
            return Reason(TorqueReason.BALANCE_UNTESTED)
        if self.normalised_rms <= CLOSED:
            return Reason(TorqueReason.BALANCE_CLOSED, (), numbers)
        return Reason(TorqueReason.BALANCE_OPEN, (), numbers)


@dataclass(frozen=True, slots=True, eq=False)
class TorqueCourse:
    """The torque of one cause, or of all together, along a record."""

    name: str
    torque: Series3  # (n, 3) N m
    sd: Series3  # N m

    @property
    def rms(self) -> Vector3:
        """Return the rms about each axis, N m."""
        return np.sqrt(np.mean(self.torque**2, axis=0))

    @property
    def greatest(self) -> float:
        """Return the greatest about any axis, N m."""
        return float(np.abs(self.torque).max())

    @property
    def typical_sd(self) -> float:
        """Return the rms of the sd over time and axes, N m."""
        return float(np.sqrt(np.mean(self.sd**2)))


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
    unmodelled_correlation: float  # s, of the same
    closure: MomentumClosure
    source: str = ""  # the recording
    sha256: str = ""

    @property
    def courses(self) -> tuple[TorqueCourse, ...]:
        """Return the torque of each cause, and of all together."""
        whole = TorqueCourse(TOTAL, self.total, self.total_sd)
        return (*(TorqueCourse(name, *self.of(name)) for name in self.causes), whole)

    @property
    def columns(self) -> dict[str, Series1]:
        """Return torque and sd of each cause and of the sum, N m: 'gravity_x', 'gravity_sd_x'."""
        return {
            f"{course.name}_{kind}{axis}": values[:, k]
            for course in self.courses
            for k, axis in enumerate(AXES)
            for kind, values in (("", course.torque), ("sd_", course.sd))
        }

    @property
    def closes(self) -> bool:
        """Say whether the causes close the momentum balance, as far as rows can test it."""
        return self.closure.reason.code is not TorqueReason.BALANCE_OPEN

    @property
    def reasons(self) -> tuple[Reason, ...]:
        """Return whether the balance closes, and what no term explains."""
        if not self.unmodelled_sd >= SHOWN * float(np.median(self.total_sd)):
            return (self.closure.reason,)
        numbers = {"sd": self.unmodelled_sd, "correlation": self.unmodelled_correlation}
        return (self.closure.reason, Reason(TorqueReason.TORQUE_UNMODELLED, (), numbers))

    def of(self, cause: str) -> tuple[Series3, Series3]:
        """Return torque and sd of a cause (n, 3), N m; KeyError if it is not among them."""
        k = {name: k for k, name in enumerate(self.causes)}[cause]
        return self.torque[:, k], self.sd[:, k]


def with_torque(recording: Recording, torque: TorqueByCause) -> Recording:
    """Return a recording with the torque of each cause as a channel, a row an interval."""
    columns = torque.columns
    rows = Samples(torque.t, np.column_stack(list(columns.values())))
    return replace(recording, cause_names=tuple(columns), torque_by_cause=rows)
