"""A recording as a bench: what was recorded is read again, at any speed.

The four verbs of ``model.bench``. What a recording cannot do again is to obey: a move is checked
against the travel, as any bench checks it; masses then do as they did. Time is the recording's.
"""

import math
from collections.abc import Callable, Mapping

import numpy as np

from equipoise.model.bench_requests import (
    check_duration,
    check_speed,
    checked_inputs,
    checked_targets,
)
from equipoise.model.errors import EquipoiseError
from equipoise.model.recording import Recording, rows_between
from equipoise.model.testbed import Testbed

Wait = Callable[[float], None]  # s


class RecordingEnded(EquipoiseError):
    """There is nothing more to read."""

    def __init__(self, source: str, end: float) -> None:
        super().__init__(
            f"{source or 'recording'}: it ends at {end:.3f} s; there is nothing more to read"
        )


class ReplayedBench:
    """A bench whose readings are a recording's."""

    def __init__(self, testbed: Testbed, recording: Recording, wait: Wait | None = None) -> None:
        """Begin at the first row; ``wait`` is asked to let each reading's time pass, None: no."""
        self.testbed, self._recording, self._wait = testbed, recording, wait
        self._time, self._end = recording.span
        self._observed = -math.inf  # s, up to which rows have been handed out

    @property
    def time(self) -> float:
        """Time of the recording, s."""
        return self._time

    def read(self, duration: float) -> Recording:
        """Return the rows of the next ``duration`` seconds; RecordingEnded when none are left."""
        check_duration(duration)
        if self._observed >= self._end:
            raise RecordingEnded(self._recording.source, self._end)
        if self._wait is not None:
            self._wait(duration)
        since, self._time = self._observed, self._time + duration
        self._observed = self._time
        return rows_between(self._recording, since, self._time)

    def move(self, targets: Mapping[str, float], speed: float = math.inf) -> None:
        """Check displacements (m) against the travel; masses do as was recorded."""
        check_speed(speed)
        here = np.array([self._displacement(name) for name in self.testbed.mass_names])
        checked_targets(self.testbed.masses, here, targets)

    def drive(self, inputs: Mapping[str, float]) -> None:
        """Check inputs by name and number; devices do as was recorded."""
        checked_inputs(self.testbed.devices, inputs)

    def stop(self) -> None:
        """Do nothing: what was recorded cannot be stopped."""

    def _displacement(self, name: str) -> float:
        """Return where a mass is now, m; at home if that was not recorded."""
        masses, names = self._recording.masses, self._recording.mass_names
        if masses is None or name not in names or not len(masses):
            return 0.0
        return float(np.interp(self._time, masses.t, masses.values[:, names.index(name)]))
