"""What a person does at a bench without actuators: place weights, let go, record."""

from typing import Protocol, runtime_checkable

from equipoise.model.arrays import Ints
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed


@runtime_checkable
class Hands(Protocol):
    """Two verbs. Between a swing and the next the platform is held, loaded and levelled."""

    @property
    def testbed(self) -> Testbed:
        """The nominal properties of the bench, without any weights."""
        ...

    @property
    def time(self) -> float:
        """Time recorded so far, s."""
        ...

    def swing(self) -> Recording:
        """Hold it still and about level, let go, and return what was recorded until it is caught.

        Raises Awaited when that has not been done yet.
        """
        ...

    def place(self, wanted: Ints) -> Ints:
        """Load it as wanted (``model.weights``), and return how it is really loaded, as reported.

        Raises MoveRefused, and nothing moves, when no pile or no stock allows it.
        """
        ...


class Awaited(Exception):
    """A person has yet to do what was asked for last; no error."""
