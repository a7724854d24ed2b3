"""The tracker's estimate while rows arrive: the same numbers as of the whole recording at once.

The tracker (``estimation.tracker``) is fed part by part. Each part is preceded by a tail of the
earlier rows, so that it contains the stop of a mass that was moving.
"""

from dataclasses import dataclass, field, replace

from equipoise.estimation.tracker import tracker
from equipoise.model.arrays import Floats
from equipoise.model.recording import Recording, join, window
from equipoise.model.testbed import Testbed

TAIL = 3.0  # s, chosen: longer than any gap between two rows of a mass that moves


@dataclass(frozen=True, slots=True, eq=False)
class LiveEstimate:
    """Where the tracker is."""

    testbed: Testbed
    state: tracker.State | None = None
    tail: Recording | None = None
    prior: tracker.Posterior | None = None  # of the body; None: the testbed's
    params: tracker.Params = field(default_factory=tracker.Params)

    @property
    def covariance(self) -> Floats | None:
        """Return (9, 9) of com and J; None before the first attitude."""
        return None if self.state is None else self.state.posterior.covariance


def grown(posterior: LiveEstimate, rows: Recording) -> tuple[LiveEstimate, tracker.Track | None]:
    """Return the posterior after more rows, and its course along them; None without an attitude."""
    observed = rows if posterior.tail is None else join(posterior.tail, rows)
    state = posterior.state or _first(observed, posterior)
    if state is None or not _later(rows, state.t):
        return replace(posterior, state=state, tail=observed), None
    track = tracker.track(observed, posterior.testbed, posterior.params, state)
    end = track.end.t
    return replace(posterior, state=track.end, tail=window(observed, end - TAIL, end)), track


def _first(rows: Recording, posterior: LiveEstimate) -> tracker.State | None:
    """Return the state at the first attitude; None if there is none."""
    if rows.attitude is None or not len(rows.attitude):
        return None
    t, q = float(rows.attitude.t[0]), rows.attitude.values[0]
    return tracker.first_state(t, q, posterior.testbed, posterior.prior)


def _later(rows: Recording, t: float) -> bool:
    """Say whether any row of a sensor is later."""
    return any(c is not None and len(c) and c.t[-1] > t for c in (rows.attitude, rows.rate))
