"""What emulated devices have in common: bytes in, bytes out, and a platform behind them.

They open no port either; times are s on the platform's clock.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

from equipoise.hardware.links.frame_transform import as_sensed
from equipoise.model.arrays import Floats
from equipoise.model.hardware import Gives, SensorUnit
from equipoise.model.recording import Recording


@dataclass(frozen=True, slots=True)
class Leg:
    """A mass on its way: from where it is at ``t`` straight to ``displacement`` at ``end``.

    A leg replaces what is left of the one before; at the end the mass stands.
    """

    mass: str
    t: float  # s
    end: float  # s
    displacement: float  # m


@dataclass(frozen=True, slots=True)
class Given:
    """An input that the electronics of a device give it (``model.devices``), from t on."""

    device: str
    t: float  # s
    value: float


class EmulatedSensor(Protocol):
    """A sensor's emulated counterpart."""

    def take(self, data: bytes, t: float) -> bytes:
        """Return the answer to what the host sent."""
        ...

    def messages(self, rows: Recording) -> Sequence[bytes]:
        """Return the messages for the rows since the last call, in order of time.

        Attitude and rate are those of the body; the unit's alignment and laboratory frame are
        undone here.
        """
        ...


class EmulatedBoard(Protocol):
    """A motor board's emulated counterpart."""

    @property
    def homing(self) -> bool:
        """Say whether masses are on their way to their switches."""
        ...

    def take(self, data: bytes, t: float) -> bytes:
        """Return what it answers at once to what the host sent."""
        ...

    def run(self, t: float) -> tuple[bytes, Sequence[Leg]]:
        """Let time pass up to ``t``; return what it says meanwhile and the legs that began."""
        ...

    def press_reset(self) -> None:
        """Press the button on the board."""
        ...

    def switch(self, on: bool) -> None:
        """Switch the power; without it masses stand where they are."""
        ...

    def hit_limit(self) -> None:
        """Push the limit switch ahead of whatever goes."""
        ...


class EmulatedActuator(Protocol):
    """The emulated counterpart of the electronics of wheels, gyros, coils or jets."""

    def take(self, data: bytes, t: float) -> bytes:
        """Return what it answers at once to what the host sent."""
        ...

    def run(self, t: float) -> tuple[bytes, Sequence[Given]]:
        """Let time pass up to ``t``; return what it says meanwhile and what it gives devices."""
        ...

    def observe(self, rows: Recording, t: float) -> None:
        """Take what the platform's devices did up to ``t``; to be said from now on."""
        ...

    def press_reset(self, t: float) -> None:
        """Press the button on it."""
        ...

    def switch(self, on: bool, t: float) -> None:
        """Switch the power; without it no device is driven."""
        ...


def sensed_rows(unit: SensorUnit, rows: Recording) -> Sequence[tuple[float, dict[Gives, Floats]]]:
    """Return each time (s), in order, with the rows of the unit's channels in the unit's axes."""
    found: dict[float, dict[Gives, Floats]] = {}
    for channel in ("attitude", "rate"):
        samples = rows.attitude if channel == "attitude" else rows.rate
        if samples is not None and channel in unit.gives:
            sensed = as_sensed(unit, channel, samples.values)
            for t, row in zip(samples.t, sensed, strict=True):
                found.setdefault(float(t), {})[channel] = row
    return sorted(found.items())
