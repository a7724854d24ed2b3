"""The bench protocol: what simulated, replayed and real benches have in common."""

import math
from collections.abc import Mapping
from typing import Protocol, runtime_checkable

from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed


@runtime_checkable
class Bench(Protocol):
    """Four verbs. Nothing is clipped: what is beyond a limit is refused, and nothing moves."""

    @property
    def testbed(self) -> Testbed:
        """The nominal properties of the bench."""
        ...

    @property
    def time(self) -> float:
        """Bench time, s."""
        ...

    def read(self, duration: float) -> Recording:
        """Wait ``duration`` seconds and return what was recorded since the last read."""
        ...

    def move(self, targets: Mapping[str, float], speed: float = math.inf) -> None:
        """Set masses on their way to displacements from home (m); later reads show the travel.

        None of them travels faster than ``speed`` (m/s), nor than its drive can.
        """
        ...

    def drive(self, inputs: Mapping[str, float]) -> None:
        """Give devices (``model.devices``) their inputs; what is not named goes on as it was.

        A jet's pulse is given once. Raises DriveRefused beyond a device's limit.
        """
        ...

    def stop(self) -> None:
        """Halt every mass where it is, and every device: no torque, gimbals and jets at rest."""
        ...
