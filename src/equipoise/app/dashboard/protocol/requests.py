"""Requests of a person at the page to the runner."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Balance:
    """Balance by a law; on a real bench only if somebody holds the platform."""

    target: tuple[float, float, float]  # m
    tolerance: tuple[float, float, float]  # m
    law: str
    max_time: float | None = None  # s; None: the law's own
    held: bool = False


@dataclass(frozen=True, slots=True)
class Identify:
    """Identify from the rows since the platform was let go."""

    method: str


@dataclass(frozen=True, slots=True)
class Stop:
    """End the running procedure and halt every mass."""


@dataclass(frozen=True, slots=True)
class Jog:
    """Send one mass to a displacement from home."""

    mass: str
    displacement: float  # m


@dataclass(frozen=True, slots=True)
class Mark:
    """Note that something happened now."""

    text: str


@dataclass(frozen=True, slots=True)
class Record:
    """Begin a recording, or end it."""

    on: bool


@dataclass(frozen=True, slots=True)
class Pause:
    """Hold the simulated platform or the replay, or let it go on."""

    on: bool


@dataclass(frozen=True, slots=True)
class Speed:
    """Let so many seconds of the bench pass in one."""

    factor: float


@dataclass(frozen=True, slots=True)
class Anew:
    """Take another simulated platform."""

    seed: int


@dataclass(frozen=True, slots=True)
class Replay:
    """Show a recording of the data folder; with no name go back to the simulated platform."""

    name: str


@dataclass(frozen=True, slots=True)
class Seek:
    """Go to a time of the recording that is shown."""

    t: float  # s


Request = Balance | Identify | Stop | Jog | Mark | Record | Pause | Speed | Anew | Replay | Seek
