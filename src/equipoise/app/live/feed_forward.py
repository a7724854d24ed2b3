"""Gravity's torque for controllers while rows arrive: the tracker, and where it is sent."""

import time
from collections.abc import Callable, Generator
from contextlib import AbstractContextManager, contextmanager
from typing import Any

import numpy as np

from equipoise.actuators.sliding_masses import shift_by
from equipoise.actuators.stored_momentum import with_known_inputs
from equipoise.app.arguments.feeding import Receiver
from equipoise.app.console.terminal import complain
from equipoise.app.live.live_estimate import TAIL, LiveEstimate, grown
from equipoise.app.live.observed_bench import WatchedBench
from equipoise.app.live.status_block import SLICE
from equipoise.hardware.bench.open_port import open_port
from equipoise.hardware.transport.datagram_sink import DatagramSink
from equipoise.io.stream.gravity_datagram import packed
from equipoise.io.stream.gravity_message import KIND, message_of
from equipoise.maths.straight_lines import read_at
from equipoise.model.arrays import Vector3
from equipoise.model.bench import Bench
from equipoise.model.given_numbers import GivenNumbers
from equipoise.model.gravity_torque import GravityTorque
from equipoise.model.hardware import Port
from equipoise.model.recording import CHANNELS, Recording, Samples, join, window
from equipoise.model.testbed import Testbed
from equipoise.procedure.steps.gravity_feed_forward import (
    expected,
    known_body,
    nothing_expected,
)

LEAD = 0.5 * SLICE  # s, chosen: the middle of the time until the next slice
Listener = Callable[[GravityTorque], None]


class FeedForward:
    """Takes rows as they arrive, and gives the torque to each listener; an onlooker of a bench.

    An estimate that fails restarts; until it is usable again, the torque is given as not usable.
    """

    def __init__(self, testbed: Testbed, given: GivenNumbers, *listeners: Listener) -> None:
        self._known = known_body(testbed, given)
        self._listeners = listeners
        self._begin = LiveEstimate(testbed, prior=self._known.posterior, params=self._known.params)
        self._estimate, self._waiting = self._begin, Recording()

    def __call__(self, rows: Recording) -> None:
        """Follow the platform along fresh rows, and report what is to be expected then."""
        newest = newest_of(rows)
        if newest is None:
            return
        self._follow(rows)
        content = self._expected(newest)
        for listener in self._listeners:
            listener(content)

    def _follow(self, rows: Recording) -> None:
        """Let the estimate grow, once an attitude has come by which a field can be turned."""
        fresh = join(self._waiting, rows)
        if fresh.attitude is None or not len(fresh.attitude):
            end = newest_of(fresh)
            self._waiting = fresh if end is None else window(fresh, end - TAIL, end)
            return
        self._waiting = Recording()
        try:
            known = with_known_inputs(fresh, self._begin.testbed)
            self._estimate = grown(self._estimate, known)[0]
        except Exception:  # whatever it was: the bench, and the stream, go on
            self._estimate = self._begin

    def _expected(self, newest: float) -> GravityTorque:
        state = self._estimate.state
        if state is None:
            return nothing_expected(newest, LEAD)
        return expected(state, self._known.heavy, self._shift(newest), newest, LEAD)

    def _shift(self, t: float) -> Vector3:
        """Return by how much the masses move the centre of mass, as they stand (m)."""
        testbed, tail = self._begin.testbed, self._estimate.tail
        masses = None if tail is None else tail.masses
        if masses is None or not len(masses):
            return np.zeros(3)
        return shift_by(testbed, read_at(np.array([t]), masses.t, masses.values)[0])


class DatagramStream(AbstractContextManager["DatagramStream"]):
    """Sends each torque in a datagram, numbered; it never waits, and counts what is lost."""

    def __init__(self, host: str, port: int) -> None:
        """Open a port that sends there; PortLost where there is no such host."""
        self._sink = DatagramSink(open_port(Port(f"udpout:{host}:{port}")))
        self._sequence = 0

    @property
    def lost(self) -> int:
        """How many datagrams the system could not take."""
        return self._sink.lost

    def close(self) -> None:
        """Close the port."""
        self._sink.close()

    def __exit__(self, *_raised: object) -> None:
        """Close the port."""
        self.close()

    def __call__(self, content: GravityTorque) -> None:
        """Send it."""
        self._sink.send(packed(content, self._sequence, time.time_ns()))
        self._sequence += 1


def as_events(event: Callable[[float, str, str, dict[str, Any]], None]) -> Listener:
    """Return a listener that makes an event of each torque, for a record or a live view.

    ``event`` takes time (s), kind, sentence and data.
    """
    return lambda content: event(content.t, KIND, "", message_of(content))


@contextmanager
def fed(
    bench: Bench, receiver: Receiver | None, note: Callable[[str, str, dict[str, Any]], None]
) -> Generator[Bench]:
    """Lend the bench, its rows followed and gravity's torque sent, if there is a receiver.

    ``note`` puts an event (kind, sentence, data) into the record and the live view of the bench.
    """
    if receiver is None:
        yield bench
        return
    with DatagramStream(receiver.host, receiver.port) as stream:
        noted = as_events(lambda _t, kind, sentence, data: note(kind, sentence, data))
        sender = FeedForward(bench.testbed, receiver.given, stream, noted)
        yield WatchedBench(bench, sender, SLICE)
        if stream.lost:
            complain(f"feed-forward: the system could not take {stream.lost} datagrams")


def newest_of(rows: Recording) -> float | None:
    """Return the time (s) of the newest row of any channel; None if there is none."""
    channels: list[Samples | None] = [getattr(rows, name) for name in CHANNELS]
    ends = [float(each.t[-1]) for each in channels if each is not None and len(each)]
    return max(ends, default=None)
