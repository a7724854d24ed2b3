"""What drivers have in common: conversations of bytes, without a port and without a clock.

A driver is fed what has arrived and asked what to send; times come in as arguments, s, on the
bench's clock. So each can be tested by the bytes of its manual, and fuzzed. Nothing that arrives
raises: what cannot be understood is counted.
"""

import math
from abc import abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from enum import StrEnum
from typing import TypeVar

from equipoise.hardware.transport.conversation import Tally
from equipoise.model.errors import BenchStopped, InputError, nearest
from equipoise.model.hardware import ActuatorUnit, MotorBoard
from equipoise.model.reasons.reason import Reason


class Phase(StrEnum):
    """What a board does now."""

    CONNECTING = "connecting"
    READY = "ready"  # it stands, and may be asked to home or, where it is sure, to move
    HOMING = "homing"
    MOVING = "moving"
    HALTED = "halted"  # it was told to stop, and has not confirmed yet that it stands
    FAULT = "fault"


Kind = TypeVar("Kind")


@dataclass(frozen=True, slots=True)
class BoardState:
    """What is known of a board now."""

    phase: Phase
    fault: Reason | None = None  # what happened and what to do, in phase FAULT
    position: Mapping[str, float] = field(default_factory=dict[str, float])  # m, displacement
    goal: Mapping[str, float] = field(default_factory=dict[str, float])  # m, where masses are sent
    reported: float | None = None  # s, time of the last reported position; None: never
    sure: bool = False  # the position is known: found by switches or by a person, not lost since

    @property
    def sentence(self) -> str:
        """The fault for people; empty if there is none."""
        return "" if self.fault is None else self.fault.sentence


class BoardDriver(Tally):
    """The conversation with one motor board; ``state`` is what is known of it now.

    Long ways are sent in legs of at most ``LEG`` each, at most two ahead, so that a board whose
    computer has died stands still within twice that.
    """

    def __init__(self, board: MotorBoard) -> None:
        super().__init__()
        self._board, self.state = board, BoardState(Phase.CONNECTING)
        self._most_speed = math.inf  # m/s, of the way that was asked for last

    @abstractmethod
    def opened(self, t: float) -> None:
        """Restart: the port has just been opened. What was sure of the position is lost."""

    @abstractmethod
    def closed(self, why: str) -> None:
        """Note that the port is gone: a fault."""

    @abstractmethod
    def feed(self, data: bytes, t: float) -> None:
        """Take in what has arrived."""

    @abstractmethod
    def due(self, t: float) -> bytes:
        """Return what to send now; asked at every turn, some hundred times a second."""

    @abstractmethod
    def home(self, t: float) -> None:
        """Find the position, then go to displacement zero; ends a fault whose cause is gone.

        Without switches: masses stand at home now, a person says so.
        """

    def go(self, goals: Mapping[str, float], t: float, speed: float = math.inf) -> None:
        """Send masses on their way to displacements (m), checked before; others go on.

        All of them go no faster than ``speed`` (m/s) from now on.

        Raises BenchStopped while they may not move.
        """
        if self.state.phase not in (Phase.READY, Phase.MOVING) or not self.state.sure:
            unsure = "" if self.state.sure else ", its position is not known"
            why = self.state.sentence or f"it is {self.state.phase}{unsure}"
            raise BenchStopped(f"board {self._board.name}: {why}")
        self._most_speed = speed
        self._aim({**self.state.goal, **goals}, t)

    @property
    def remarks(self) -> list[Reason]:
        """What the board is set to that makes it worse than it need be; it stops nothing."""
        return []

    @abstractmethod
    def halt(self, t: float) -> None:
        """Stop every mass at once, slowing down in order; the position stays known."""

    @abstractmethod
    def _aim(self, goal: Mapping[str, float], t: float) -> None:
        """Take up a goal of all masses (m)."""


class Activity(StrEnum):
    """What the electronics of wheels, gyros, coils or jets do now."""

    CONNECTING = "connecting to it"
    RESTING = "resting"  # no torque; it works as soon as it is driven
    WORKING = "working"
    FAULT = "at fault"


@dataclass(frozen=True, slots=True)
class ActuatorState:
    """What is known of such electronics now."""

    activity: Activity
    fault: Reason | None = None  # what happened and what to do, at fault
    inputs: Mapping[str, float] = field(default_factory=dict[str, float])  # those that last, wanted

    @property
    def sentence(self) -> str:
        """The fault for people; empty if there is none."""
        return "" if self.fault is None else self.fault.sentence

    @property
    def active(self) -> bool:
        """Say whether any device is given more than nothing."""
        return self.activity is Activity.WORKING and any(self.inputs.values())


@dataclass(frozen=True, slots=True)
class Counted:
    """One report: what is counted of each device (``model.devices.Traits``), by name."""

    stamp: float  # s, on the device's clock
    values: Mapping[str, float]


@dataclass(frozen=True, slots=True)
class Taken:
    """Inputs that a device has taken, by name, and when its reports first show it."""

    stamp: float  # s, on the device's clock
    inputs: Mapping[str, float]


class ActuatorDriver(Tally):
    """The conversation with electronics that drive devices; ``state`` is what is known now.

    They come to rest by themselves when nothing reaches them for as long as their deadman allows.
    """

    def __init__(self, unit: ActuatorUnit) -> None:
        super().__init__()
        self._unit, self.state = unit, ActuatorState(Activity.CONNECTING)
        self.taken: list[Taken] = []  # since somebody took them out
        self.begun = 0  # how often its clock and its counts restarted

    @abstractmethod
    def opened(self, t: float) -> None:
        """Restart: the port has just been opened."""

    @abstractmethod
    def closed(self, why: str) -> None:
        """Note that the port is gone: a fault."""

    @abstractmethod
    def feed(self, data: bytes, t: float) -> Sequence[Counted]:
        """Return the reports that are complete with these bytes."""

    @abstractmethod
    def due(self, t: float) -> bytes:
        """Return what to send now; asked at every turn, some hundred times a second."""

    @abstractmethod
    def rest(self, t: float) -> None:
        """Let every device rest: no torque, gimbals and jets still, no pulse goes on."""

    @abstractmethod
    def begin(self, t: float) -> None:
        """Let every device rest; ends a fault whose cause is gone."""

    def drive(self, inputs: Mapping[str, float], t: float) -> None:
        """Give devices their inputs, checked before; what is not named goes on as it was.

        Raises BenchStopped while they may not be driven.
        """
        if self.state.activity not in (Activity.RESTING, Activity.WORKING):
            why = self.state.sentence or f"the program is {self.state.activity}"
            raise BenchStopped(f"actuator {self._unit.name}: {why}")
        self._give(inputs, t)

    @property
    def remarks(self) -> list[Reason]:
        """What the electronics declare that makes them worse than they need be."""
        return []

    @abstractmethod
    def _give(self, inputs: Mapping[str, float], t: float) -> None:
        """Take up inputs."""


LEG = 0.25  # s, chosen: what a board does without its computer is over within twice that
POLL = 0.1  # s, chosen: how often a board is asked where it is while masses stand
POLL_MOVING = 0.05  # s, the same while they move
POLL_HALTED = 0.02  # s, the same until they surely stand
SILENCE = 1.5  # s, attended, chosen: an answer takes a few ms, or 0.5 s there and back by radio


def driver_named(kinds: Mapping[str, Kind], driver: str, what: str) -> Kind:
    """Return a registry's entry; InputError names the nearest for a ``what`` without a driver."""
    if driver not in kinds:
        raise InputError(f"hardware.{what}", f"driver '{driver}'", nearest(driver, list(kinds)))
    return kinds[driver]
