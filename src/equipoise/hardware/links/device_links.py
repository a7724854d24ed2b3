"""The units of a bench, each with its port, and their combined state."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from equipoise.hardware.links.actuator_link import ActuatorLink
from equipoise.hardware.links.driver_turn import fed, said
from equipoise.hardware.links.health import Health
from equipoise.hardware.links.mass_interpolation import on_the_way
from equipoise.hardware.links.sensor_link import SensorLink
from equipoise.hardware.transport.driver_protocol import (
    Activity,
    ActuatorState,
    BoardDriver,
    BoardState,
    Phase,
)
from equipoise.hardware.transport.reconnecting_port import Connection
from equipoise.model.hardware import Gives, MotorBoard
from equipoise.model.reasons.interlocks import Interlock
from equipoise.model.reasons.reason import Reason


class BoardLink:
    """Carries bytes between a board's driver and its port."""

    def __init__(self, board: MotorBoard, driver: BoardDriver, connection: Connection) -> None:
        self.board, self.driver, self.connection = board, driver, connection

    @property
    def health(self) -> Health:
        """How well it answers."""
        return Health(f"board {self.board.name}", self.driver.counts)

    def turn(self, t: float) -> None:
        """Feed the driver what has arrived."""
        fed(self.driver, self.connection, t)

    def send(self, t: float) -> None:
        """Send what the driver has to say."""
        said(self.driver, self.connection, t)


@dataclass(frozen=True, slots=True)
class Links:
    """Motor boards, sensors and actuators."""

    boards: Sequence[BoardLink]
    sensors: Sequence[SensorLink]
    actuators: Sequence[ActuatorLink] = ()

    @property
    def states(self) -> dict[str, BoardState]:
        """How each board is, by its name."""
        return {link.board.name: link.driver.state for link in self.boards}

    @property
    def activities(self) -> dict[str, ActuatorState]:
        """How each actuator is, by its name."""
        return {link.unit.name: link.driver.state for link in self.actuators}

    @property
    def deviation(self) -> Reason | None:
        """The first device that does not do what it is driven to; None: all do."""
        found = (link.deviation for link in self.actuators)
        return next((reason for reason in found if reason is not None), None)

    @property
    def positions(self) -> dict[str, float]:
        """Where the boards say that masses are, m."""
        return {k: v for state in self.states.values() for k, v in state.position.items()}

    @property
    def ready(self) -> bool:
        """Say whether every board stands and knows where, and every actuator can be driven."""
        able = (Activity.RESTING, Activity.WORKING)
        return all(
            state.phase is Phase.READY and state.sure for state in self.states.values()
        ) and all(state.activity in able for state in self.activities.values())

    @property
    def answered(self) -> bool:
        """Say whether every board and every actuator has said how it is."""
        return all(state.phase is not Phase.CONNECTING for state in self.states.values()) and all(
            state.activity is not Activity.CONNECTING for state in self.activities.values()
        )

    @property
    def reported(self) -> float | None:
        """When a board last reported a position, s; None while one does not know its own."""
        states = self.states.values()
        known = [s.reported for s in states if s.reported is not None and s.sure]
        return max(known) if known and len(known) == len(states) else None

    @property
    def wants(self) -> dict[str, bool]:
        """Which masses are not yet where they were sent."""
        parts = [on_the_way(link.driver.state, link.board.axes) for link in self.boards]
        return {name: short for part in parts for name, short in part.items()}

    @property
    def unreachable(self) -> Reason | None:
        """The first device whose port is closed, and why; None if none is."""
        links = [(f"sensor {link.unit.name}", link.connection.why) for link in self.sensors]
        links += [(f"board {link.board.name}", link.connection.why) for link in self.boards]
        links += [(f"actuator {link.unit.name}", link.connection.why) for link in self.actuators]
        closed = (Reason(Interlock.UNREACHABLE, (name, why)) for name, why in links if why)
        return next(closed, None)

    @property
    def unsure(self) -> Reason | None:
        """The first board or actuator that may not be used, and why; None if all may."""
        for name, state in self.states.items():
            if state.phase is Phase.FAULT or not state.sure:
                fault = Reason(Interlock.FAULT, (name, state.sentence))
                return fault if state.sentence else Reason(Interlock.POSITION_UNKNOWN, (name,))
        for name, state in self.activities.items():
            if state.activity in (Activity.CONNECTING, Activity.FAULT):
                why = state.sentence or f"the program is {state.activity}"
                return Reason(Interlock.DEVICE_FAULT, (name, why))
        return None

    @property
    def health(self) -> list[Health]:
        """How well each device answers."""
        return [link.health for link in (*self.boards, *self.sensors, *self.actuators)]

    @property
    def silent(self) -> dict[tuple[str, Gives], float]:
        """How long each channel of each sensor has given no row, s."""
        return {
            (link.unit.name, channel): seconds
            for link in self.sensors
            for channel, seconds in link.silent.items()
        }

    def go(self, targets: Mapping[str, float], t: float, speed: float) -> None:
        """Send masses to displacements (m), each by its board, no faster than ``speed`` (m/s)."""
        for link in self.boards:
            own = {a.mass: targets[a.mass] for a in link.board.axes if a.mass in targets}
            if own:
                link.driver.go(own, t, speed)

    def drive(self, inputs: Mapping[str, float], t: float) -> None:
        """Give devices their inputs, each by its actuator."""
        for link in self.actuators:
            own = {name: inputs[name] for name in link.unit.drives if name in inputs}
            if own:
                link.driver.drive(own, t)

    def home(self, t: float) -> None:
        """Let every board find its position, and every actuator rest and restart."""
        for link in self.boards:
            link.driver.home(t)
        for link in self.actuators:
            link.begin(t)

    def halt(self, t: float) -> None:
        """Stop every mass, and let every device rest."""
        for link in self.boards:
            link.driver.halt(t)
        for link in self.actuators:
            link.driver.rest(t)

    def send(self, t: float) -> None:
        """Send each board and each actuator what its driver has to say."""
        for link in (*self.boards, *self.actuators):
            link.send(t)

    def close(self) -> None:
        """Close every port."""
        for link in (*self.boards, *self.sensors, *self.actuators):
            link.connection.close()
