"""The bench protocol on real devices: see ``model.bench.Bench``.

Time goes on whether anybody reads or not. A read that finds no row of any sensor goes on until
there is one; a move waits until every sensor gives rows. After ``PATIENCE`` both give up. When an
interlock stops the motors, the read or the move under way raises BenchStopped; reads after that
work, and masses stay until ``home``.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Protocol

from equipoise.actuators.stored_momentum import stored_momentum
from equipoise.hardware.bench.bench_controller import Keeper
from equipoise.hardware.bench.controller_process import DistantKeeper
from equipoise.hardware.links.health import Health
from equipoise.model.bench_requests import check_duration
from equipoise.model.errors import BenchStopped
from equipoise.model.reasons.interlocks import Interlock
from equipoise.model.reasons.reason import Reason
from equipoise.model.recording import Recording, join

PATIENCE = 30.0  # s, chosen: for a sensor to come back, or a board to be ready
HOMING = 1800.0  # s, chosen: each board's driver knows how long its homing may take, and ends it


class Clock(Protocol):
    """The bench's time."""

    @property
    def begun_ns(self) -> int:
        """UTC at bench time zero, ns since 1970."""
        ...

    @property
    def now(self) -> float:
        """Now, s."""
        ...

    def wait(self) -> None:
        """Let a little time pass: a turn."""
        ...


class RealBench:
    """Devices behind a keeper, here or in another process, and a clock."""

    def __init__(self, keeper: Keeper | DistantKeeper, clock: Clock) -> None:
        self._keeper, self._clock, self.testbed = keeper, clock, keeper.testbed
        self._reported = keeper.state.stops  # those that were reported already
        hardware = self.testbed.hardware
        self._senses = hardware is None or bool(hardware.sensors)

    @property
    def time(self) -> float:
        """Bench time, s."""
        return self._clock.now

    @property
    def begun_ns(self) -> int:
        """UTC at bench time zero, ns since 1970: what a row's stamp in UTC is counted from."""
        return self._clock.begun_ns

    def start(self) -> None:
        """Wait until every board answers, and let those that need it find their position.

        Raises BenchStopped if that does not come about.
        """
        keeper = self._keeper
        self._until(lambda: keeper.state.answered, PATIENCE, Interlock.NOT_ANSWERING)
        if not keeper.state.ready:
            keeper.home()
        self._until(lambda: keeper.state.ready, HOMING, Interlock.NOT_HOME)

    def watch(self) -> None:
        """Wait until every sensor gives rows, and begin there; masses may be anywhere."""
        self._until(lambda: self._keeper.state.fresh, PATIENCE, Interlock.NOT_STREAMING)
        self._keeper.begin()

    def read(self, duration: float) -> Recording:
        """Wait ``duration`` seconds and return what was recorded since the last read."""
        check_duration(duration)
        end = self.time + duration
        self._turn()
        while self.time < end:
            self._wait()
        found = self._keeper.taken()
        give_up = self.time + PATIENCE
        while duration > 0 and self._senses and found.attitude is None and found.rate is None:
            if self.time > give_up:
                self._keeper.halt(Reason(Interlock.NO_ROWS, (), {"seconds": PATIENCE}))
            self._wait()
            found = join(found, self._keeper.taken())
        return replace(found, momentum=stored_momentum(found, self.testbed))

    def move(self, targets: Mapping[str, float], speed: float = math.inf) -> None:
        """Set masses on their way to displacements (m), no faster than ``speed`` (m/s)."""
        keeper = self._keeper
        self._turn()
        if keeper.state.trip is None and not keeper.state.fresh:
            self._until(lambda: keeper.state.fresh, PATIENCE, Interlock.NOT_MOVABLE)
        keeper.go(targets, speed)
        self._turn()

    def drive(self, inputs: Mapping[str, float]) -> None:
        """Give devices their inputs; what is not named goes on as it was."""
        keeper = self._keeper
        self._turn()
        if keeper.state.trip is None and not keeper.state.fresh:
            self._until(lambda: keeper.state.fresh, PATIENCE, Interlock.NOT_MOVABLE)
        keeper.drive(inputs)
        self._turn()

    def stop(self) -> None:
        """Halt every mass where it is, and every device."""
        self._keeper.halt()
        self._turn()

    def note(self, kind: str, sentence: str, data: Mapping[str, object]) -> None:
        """Put what happened into the record and the live view."""
        self._keeper.note(kind, sentence, data)

    @property
    def lost(self) -> tuple[str, ...]:
        """Return a sentence on each view that failed; the bench went on without it."""
        return self._keeper.state.lost

    def health(self) -> list[Health]:
        """Return how well each device answers; nothing where the keeper has ended."""
        try:
            return self._keeper.health()
        except BenchStopped:
            return []

    def _until(self, done: Callable[[], bool], patience: float, otherwise: Interlock) -> None:
        """Wait for something; stop the bench and say what keeps it if it does not come about."""
        end = self.time + patience
        while not done():
            if self.time > end:
                cause = self._keeper.state.trouble
                why = "no reason is known" if cause is None else cause.sentence
                self._keeper.halt(Reason(otherwise, (why,), {"seconds": patience}))
            self._wait()

    def _wait(self) -> None:
        self._clock.wait()
        self._turn()

    def _turn(self) -> None:
        """Let the keeper take a turn; raise what stopped it, once."""
        self._keeper.turn(self._clock.now)
        state = self._keeper.state
        if state.trip is not None and state.stops > self._reported:
            self._reported = state.stops
            raise BenchStopped(f"every mass was stopped: {state.trip.sentence}", state.trip)
