"""A motor board and its port."""

from equipoise.hardware.links.health import Health
from equipoise.hardware.transport.driver_protocol import BoardDriver
from equipoise.hardware.transport.reconnecting_port import Connection
from equipoise.model.hardware import MotorBoard


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
