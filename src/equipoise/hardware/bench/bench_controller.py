"""The keeper of a bench: polls its ports, evaluates its interlocks and reports, turn by turn.

One turn polls every port, feeds the drivers, evaluates the interlocks, sends what is due and hands
on what was received. It does not wait and has no clock. The commander can be lost at any moment:
then ``halt`` is called for it.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from equipoise.hardware.bench.interlocks import LAST, Observed, silence, tripped
from equipoise.hardware.bench.onlookers import Onlookers, why_lost
from equipoise.hardware.links.device_links import Links
from equipoise.hardware.links.device_rows import DeviceRows
from equipoise.hardware.links.health import Health
from equipoise.hardware.links.row_buffer import RowBuffer
from equipoise.hardware.links.sensor_link import SensorLink
from equipoise.model.arrays import Floats
from equipoise.model.bench_requests import check_speed, checked_inputs, checked_targets
from equipoise.model.errors import BenchStopped, DriveRefused
from equipoise.model.hardware import Hardware
from equipoise.model.reasons.interlocks import Interlock
from equipoise.model.reasons.reason import Reason
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed
from equipoise.model.units import MM

REMEMBERED = 0.2  # s, chosen: between the two answers from which a mass's speed is computed
RECORD = "the record"  # without which nothing may move, where one was asked for


class Listener(Protocol):
    """Who receives all that happens: a recording, a live view."""

    def rows(self, recording: Recording) -> None:
        """Take rows as they arrive."""
        ...

    def event(self, t: float, kind: str, sentence: str, data: Mapping[str, object]) -> None:
        """Take a command, an interlock or a note, at t s."""
        ...

    def turn(self, t: float) -> None:
        """Note that time has passed."""
        ...


@dataclass(frozen=True, slots=True)
class BenchState:
    """What whoever commands knows of a bench now."""

    trip: Reason | None = None  # why every motor is stopped; None: none is
    stops: int = 0  # how often every motor was stopped so far
    trouble: Reason | None = None  # what keeps masses from being moved now; None if nothing does
    answered: bool = False  # every board and actuator has said how it is
    ready: bool = False  # every board stands and knows where, every actuator can be driven
    fresh: bool = False  # every sensor gives rows
    lost: tuple[str, ...] = ()  # sentences on views that failed; the bench goes on without them


class Keeper:
    """See above; ``hardware`` is the testbed's own."""

    def __init__(self, testbed: Testbed, hardware: Hardware, links: Links) -> None:
        self.testbed, self.links = testbed, links
        self._limits = hardware.limits
        self._listeners = Onlookers[Listener](self._left)
        self._lost: tuple[str, ...] = ()
        self._attitudes: list[tuple[float, Floats]] = []
        self._rates: list[tuple[float, Floats]] = []
        self._before: dict[str, tuple[float, float]] = {}
        self._silent: tuple[str, ...] = ()  # sensor and channel
        self._received = RowBuffer(testbed.masses, testbed.device_names)
        driven = [link.unit.drives for link in links.actuators]
        self._counted = DeviceRows(testbed.devices, driven)
        self.t = 0.0
        self.trip: Reason | None = None
        self._stops = 0

    @property
    def state(self) -> BenchState:
        """What is to be known of it now."""
        links, silent = self.links, silence(self._observed(self.t), self._limits)
        trouble = links.unreachable or silent or links.unsure
        return BenchState(
            self.trip, self._stops, trouble, links.answered, links.ready, silent is None, self._lost
        )

    def listen(self, listener: Listener, name: str = RECORD) -> None:
        """Hand all that happens from now on to a listener; a lost record stops the bench."""
        self._listeners.add(name, listener)

    def turn(self, t: float) -> None:
        """Poll every device and evaluate every interlock once."""
        self.t = t
        for link in self.links.sensors:
            self._sensed(link, t)
        for link in self.links.boards:
            link.turn(t)
        self._counted_by_devices(t)
        self._received.masses(self.links.positions, self.links.wants, self.links.reported)
        self._guard(t)
        self.links.send(t)
        self._report(t)

    def taken(self) -> Recording:
        """Return the rows received since the last call."""
        return self._received.taken()

    def begin(self) -> None:
        """Note that the platform is free from now on, and forget the rows before."""
        self.note("start", "the platform is free from here on", {})
        self._received.begin()

    def health(self) -> list[Health]:
        """Return how well each device answers."""
        return self.links.health

    def home(self) -> None:
        """Let every board find its position; ends a stop whose cause is gone."""
        self.trip, self._before = None, {}
        self.note("command", "home", {})
        if self.trip is None:  # to note it may have filled the disk
            self.links.home(self.t)

    def go(self, targets: Mapping[str, float], speed: float = math.inf) -> None:
        """Send masses to displacements (m), no faster than ``speed`` (m/s): all or none.

        Raises InputError or MoveRefused for a target that cannot be, BenchStopped while masses
        may not move.
        """
        check_speed(speed)
        here = np.array([self.links.positions.get(name, 0.0) for name in self.testbed.mass_names])
        goals = checked_targets(self.testbed.masses, here, targets)
        self._able()
        by_name = {self.testbed.masses[i].name: goal for i, goal in goals.items()}
        reported = ", ".join(f"{name} to {goal / MM:.3f} mm" for name, goal in by_name.items())
        self.note("command", f"go: {reported}", by_name)
        self._able()  # to note it may have filled the disk
        self.links.go(by_name, self.t, speed)

    def drive(self, inputs: Mapping[str, float]) -> None:
        """Give devices their inputs: all or none; what is not named goes on as it was.

        Raises InputError or DriveRefused for an input that cannot be, BenchStopped while devices
        may not be driven.
        """
        devices = self.testbed.devices
        checked = checked_inputs(devices, inputs)
        by_name = {devices[i].name: value for i, value in checked.items()}
        driven = {name for link in self.links.actuators for name in link.unit.drives}
        for name in (name for name, value in by_name.items() if value and name not in driven):
            raise DriveRefused(name, by_name[name], 0.0, "(no [[hardware.actuator]] drives it)")
        if not by_name.keys() & driven:
            return
        self._able()
        self.links.drive(by_name, self.t)

    def halt(self, why: Reason | None = None) -> None:
        """Stop every mass and device; with a reason, they stay until ``home``."""
        if why is not None:
            self._stop(why)
            return
        self.links.halt(self.t)
        self.note("command", "halt", {})

    def note(self, kind: str, sentence: str, data: Mapping[str, object]) -> None:
        """Hand on what happened now, here or at whoever commands."""
        self._listeners.hand_on(lambda listener: listener.event(self.t, kind, sentence, data))

    def close(self) -> None:
        """Stop every mass, note how well each device answered, and close every port."""
        self.links.halt(self.t)
        self.links.send(self.t)
        for each in self.links.health:
            self.note("health", each.sentence, each.data)
        self.links.close()

    def _able(self) -> None:
        """Raise BenchStopped while masses may not move."""
        why = self.trip or self.state.trouble
        if why is not None:
            raise BenchStopped(f"nothing was moved: {why.sentence}", why)

    def _counted_by_devices(self, t: float) -> None:
        """Take what actuators report; rows go on once all of them have."""
        for i, link in enumerate(self.links.actuators):
            reports = link.turn(t)
            if link.begun_anew:
                self._counted.begin()
            for report in reports:
                self._counted.reported(i, report.t, report.values)
        for when, values in self._counted.rows():
            self._received.devices(when, values)

    def _sensed(self, link: SensorLink, t: float) -> None:
        for row in link.turn(t):
            if self._received.row(row):
                last = self._attitudes if row.channel == "attitude" else self._rates
                last.append((row.t, row.values))
                del last[:-LAST]

    def _guard(self, t: float) -> None:
        """Ask the interlocks; note a sensor that falls silent or comes back while masses stand."""
        observed = self._observed(t)
        found = tripped(observed, self.testbed, self._limits)
        if found is not None and (self.trip is None or self.trip.code is not found.code):
            self._stop(found)
        quiet = silence(observed, self._limits)
        silent = () if quiet is None else quiet.parameters
        if silent != self._silent:
            code = Interlock.SENSOR_SILENT if silent else Interlock.SENSOR_BACK
            self._warn(Reason(code, silent or self._silent))
            self._silent = silent
        self._remember()

    def _observed(self, t: float) -> Observed:
        silent, states = self.links.silent, self.links.states
        return Observed(
            t, self._attitudes, self._rates, silent, states, self._before,
            self.links.activities, self.links.deviation,
        )  # fmt: skip

    def _remember(self) -> None:
        """Keep an earlier answer of each board, to compute speeds from."""
        for state in self.links.states.values():
            if state.reported is None or not state.sure:
                continue
            for name, at in state.position.items():
                if state.reported - self._before.get(name, (float("-inf"), 0.0))[0] > REMEMBERED:
                    self._before[name] = (state.reported, at)

    def _stop(self, trip: Reason) -> None:
        self.links.halt(self.t)
        self.links.send(self.t)  # now: to note it may take the disk long
        self.trip, self._stops = trip, self._stops + 1
        self._warn(trip)

    def _warn(self, why: Reason) -> None:
        data = {"code": why.code, "parameters": list(why.parameters), "numbers": dict(why.numbers)}
        self.note("interlock", why.sentence, data)

    def _report(self, t: float) -> None:
        """Hand on what was received."""
        fresh = self._received.fresh()
        if fresh is not None:
            self._listeners.hand_on(lambda listener: listener.rows(fresh))
        self._listeners.hand_on(lambda listener: listener.turn(t))

    def _left(self, name: str, error: Exception) -> None:
        """Stop the bench for a record that is lost; go on without a view, and say so."""
        sentence = why_lost(name, error)
        if name == RECORD:
            self._stop(Reason(Interlock.RECORD_LOST, (sentence,)))
        else:
            self._lost += (sentence,)
            self.note("note", sentence, {})
