"""A board's random cycles in real time: a pseudo terminal, a clock on the wall, busy cores.

The emulated firmware has a thread of its own and its own clock; between it and the driver is what
the system makes of a serial line.
"""

import multiprocessing
import threading
import time
from contextlib import contextmanager

from equipoise.hardware.bench.open_port import open_port
from equipoise.hardware.emulated.counterpart import counterpart
from equipoise.hardware.emulated.registry import emulated_board
from equipoise.hardware.links.device_links import BoardLink
from equipoise.hardware.transport.reconnecting_port import Connection
from equipoise.model.hardware import Port
from tests.support.board_soak import Soak
from tests.support.board_wire import BED, board_of

PAUSE = 1e-3  # s, between turns, as a bench's clock has it


def _spin():
    while True:
        pass


@contextmanager
def busy_cores(count):
    """Let so many processes do nothing but work."""
    spinning = [multiprocessing.get_context("spawn").Process(target=_spin, daemon=True)
                for _ in range(count)]  # fmt: skip
    for each in spinning:
        each.start()
    try:
        yield
    finally:
        for each in spinning:
            each.kill()
            each.join()


class RealTimeSoak(Soak):
    """As ``Soak``, but time passes by itself."""

    def __init__(self, kind, seed, slack=0.1):
        super().__init__(kind, seed, None, slack=slack)
        self._wire = counterpart(Port("serial:any"))
        board = board_of(kind)
        self._lock, self._over = threading.RLock(), False
        self._zero = time.monotonic()
        self.remote = _Locked(emulated_board(board, BED.masses), self)
        self._link = BoardLink(board, self.driver, Connection(Port(self._wire.address), open_port))
        self._thread = threading.Thread(target=self._live, daemon=True)
        self._thread.start()

    @property
    def now(self):
        """Now, s."""
        return time.monotonic() - self._zero

    def close(self):
        """End it."""
        self._over = True
        self._thread.join()
        self._link.connection.close()
        self._wire.close()

    def _live(self):
        while not self._over:
            with self._lock:
                board, t = self.remote.inner, self.now
                said = board.take(self._wire.receive(), t)
                more, legs = board.run(t)
                self._wire.send(said + more)
                self._lead(legs)
            time.sleep(PAUSE / 2)

    def wait(self, seconds, until=()):
        """Let the driver take its turns."""
        end = self.t + seconds
        while self.t < end and self.driver.state.phase not in until:
            self._turn_now()
            time.sleep(PAUSE)
        return self.driver.state

    def _turn_now(self):
        self.t = self.now
        self._link.turn(self.t)
        self._send()

    def _send(self):
        self._link.send(self.t)

    def _go_to(self, t):
        """Let the host pause."""
        time.sleep(max(t - self.now, 0.0))
        self._turn_now()

    def unplug(self):
        """Pull the plug, and put it back: the port is closed and opened again."""
        self._perhaps_moving()
        self._link.connection.close()
        self.driver.closed("unplugged")
        self._expect_fault_now()
        time.sleep(self.rng.uniform(0.1, 1.0))
        self._ready("replug", 10.0)
        self._home()

    def _expect_fault_now(self):
        if self.driver.state.sure:
            self.tally.false.append((self.doing, "sure of a position that is lost"))

    def true(self, name, t=None):
        """Return where a mass is, m."""
        with self._lock:
            return super().true(name, t)

    def _stood(self, since):
        with self._lock:
            return super()._stood(since)


class _Locked:
    """What people do to a board, while its thread waits."""

    def __init__(self, inner, soak):
        self.inner, self._soak = inner, soak

    def __getattr__(self, name):
        def locked(*values):
            with self._soak._lock:
                self.inner.run(self._soak.now)
                return getattr(self.inner, name)(*values)

        return locked
