"""The devices of a bench, each with its port, and their combined state."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from equipoise.hardware.links.health import Health
from equipoise.hardware.links.mass_interpolation import on_the_way
from equipoise.hardware.links.sensor_link import SensorLink
from equipoise.hardware.transport.driver_protocol import BoardDriver, BoardState, Phase
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
        turn = self.connection.turn(t)
        if turn.opened:
            self.driver.opened(t)
        for data in turn.data:
            self.driver.feed(data, t)
        if turn.lost:
            self.driver.closed(turn.lost)

    def send(self, t: float) -> None:
        """Send what the driver has to say."""
        if self.connection.why:
            return
        lost = self.connection.send(self.driver.due(t), t).lost
        if lost:
            self.driver.closed(lost)


@dataclass(frozen=True, slots=True)
class Links:
    """Motor boards and sensors."""

    boards: Sequence[BoardLink]
    sensors: Sequence[SensorLink]

    @property
    def states(self) -> dict[str, BoardState]:
        """How each board is, by its name."""
        return {link.board.name: link.driver.state for link in self.boards}

    @property
    def positions(self) -> dict[str, float]:
        """Where the boards say that masses are, m."""
        return {k: v for state in self.states.values() for k, v in state.position.items()}

    @property
    def ready(self) -> bool:
        """Say whether every board stands and knows where."""
        return all(state.phase is Phase.READY and state.sure for state in self.states.values())

    @property
    def answered(self) -> bool:
        """Say whether every board has said how it is."""
        return all(state.phase is not Phase.CONNECTING for state in self.states.values())

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
        closed = (Reason(Interlock.UNREACHABLE, (name, why)) for name, why in links if why)
        return next(closed, None)

    @property
    def unsure(self) -> Reason | None:
        """The first board that is at fault or has lost its position, and why; None if none."""
        for name, state in self.states.items():
            if state.phase is Phase.FAULT or not state.sure:
                fault = Reason(Interlock.FAULT, (name, state.sentence))
                return fault if state.sentence else Reason(Interlock.POSITION_UNKNOWN, (name,))
        return None

    @property
    def health(self) -> list[Health]:
        """How well each device answers."""
        return [*(link.health for link in self.boards), *(link.health for link in self.sensors)]

    @property
    def silent(self) -> dict[tuple[str, Gives], float]:
        """How long each channel of each sensor has given no row, s."""
        return {
            (link.unit.name, channel): seconds
            for link in self.sensors
            for channel, seconds in link.silent.items()
        }

    def go(self, targets: Mapping[str, float], t: float) -> None:
        """Send masses to displacements (m), each by its board."""
        for link in self.boards:
            own = {a.mass: targets[a.mass] for a in link.board.axes if a.mass in targets}
            if own:
                link.driver.go(own, t)

    def home(self, t: float) -> None:
        """Let every board find its position."""
        for link in self.boards:
            link.driver.home(t)

    def halt(self, t: float) -> None:
        """Stop every mass."""
        for link in self.boards:
            link.driver.halt(t)

    def send(self, t: float) -> None:
        """Send each board what its driver has to say."""
        for link in self.boards:
            link.send(t)

    def close(self) -> None:
        """Close every port."""
        for link in (*self.boards, *self.sensors):
            link.connection.close()
