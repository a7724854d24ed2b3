"""What a device sent: one row of a sensor, and counts of its messages."""

from dataclasses import dataclass

from equipoise.model.hardware import Gives
from equipoise.model.reasons.reason import Reason


@dataclass(frozen=True, slots=True)
class Reading:
    """One row, in the sensor's own axes.

    attitude: unit quaternion, scalar first, that turns sensor components into components of the
    sensor's laboratory frame. rate: rad/s.
    """

    channel: Gives
    values: tuple[float, ...]  # 4 or 3 numbers
    stamp: float | None = None  # s, on the device's clock; None: it stamps no rows
    number: int | None = None  # of the row, as the device counts; None: it does not


@dataclass(frozen=True, slots=True)
class Counts:
    """What came over a port since it was opened."""

    good: int = 0  # messages understood
    corrupt: int = 0  # broken: checksum, half a line, a number that is none
    foreign: int = 0  # whole, and of no use to us


@dataclass(frozen=True, slots=True, eq=False)
class Rowless:
    """Why messages that are whole gave no row, as a camera's picture without its board."""

    reason: Reason  # of the last one with this code
    count: int  # messages with this code
