"""Device lines: our own protocol for electronics of wheels, gyros, coils and jets.

docs/device-protocol.md has it whole. A device reports some tens of times a second without being
asked: its time, the order that it took last, whether it works or rests and why, and what it counts.
It works after it was armed and for as long as something reaches it; else it comes to rest.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace

from equipoise.hardware.actuators.agreement import disagreement, disagreement_at_hello
from equipoise.hardware.actuators.checked_lines import checked, message_in
from equipoise.hardware.actuators.messages import (
    REFUSALS,
    VERSION,
    Description,
    Hello,
    Mode,
    Refusal,
    Report,
    read_message,
)
from equipoise.hardware.actuators.orders import AGAIN, Order, Orders
from equipoise.hardware.transport.attended_time import AttendedTime
from equipoise.hardware.transport.driver_protocol import (
    SILENCE,
    Activity,
    ActuatorDriver,
    ActuatorState,
    Counted,
    Taken,
)
from equipoise.hardware.transport.line_splitter import Lines
from equipoise.model.devices import TRAITS, Device
from equipoise.model.hardware import ActuatorUnit
from equipoise.model.reading import Counts
from equipoise.model.reasons.actuator_faults import ActuatorFault, ActuatorRemark
from equipoise.model.reasons.reason import Number, Reason
from equipoise.model.units import MS

BEGINNING = 3.0  # s, attended, chosen: a microcontroller restarts when its port is opened
REPEATED = 0.5  # s, chosen: between two questions of the same, who it is and what it has
STALE = 0.5  # s, attended, chosen: without a report, or an order taken, while it works
TIRED = 0.5 * 2**32 * MS  # s: by which a clock of 32 bits goes back when it restarts
SHOWN = 60  # bytes, chosen: of the last line, for people
HELLO, HALT, BEAT = checked(f'{{"hello":{VERSION}}}'), checked('{"halt":1}'), checked('{"beat":1}')
UNASKED = {
    Mode.BEGUN: ActuatorFault.BEGAN_ANEW,
    Mode.HALTED: ActuatorFault.HALTED_THERE,
    Mode.DEADMAN: ActuatorFault.DEADMAN,
}


class DeviceLines(ActuatorDriver):
    """The conversation."""

    def __init__(self, unit: ActuatorUnit, devices: Sequence[Device]) -> None:
        """Take all devices of the testbed, among them those that the unit drives."""
        super().__init__(unit)
        by_name = {device.name: device for device in devices}
        self._devices = tuple(by_name[name] for name in unit.drives)
        self._lines, self._clock = Lines(), AttendedTime()
        self._orders = Orders(unit.drives, self._clock)
        self._deadman = 0.0
        self._begin()

    def opened(self, t: float) -> None:
        """Restart."""
        self.counts = Counts()
        self._lines.cleared()
        self._begin()

    def closed(self, why: str) -> None:
        """Note that the port is gone."""
        self._fault(ActuatorFault.PORT_GONE, why)

    def feed(self, data: bytes, t: float) -> Sequence[Counted]:
        """Return the reports that are complete with these bytes."""
        dropped, found = self._lines.dropped, list[Counted]()
        for line in self._lines.cut(data):
            self._received = repr(line[-SHOWN:].decode("ascii", "replace"))
            plain = message_in(line)
            message = None if plain is None else read_message(plain)
            self.count(good=message is not None, corrupt=plain is None,
                       foreign=plain is not None and message is None)  # fmt: skip
            if isinstance(message, Report) and len(message.counted) == len(self._devices):
                found += self._reported(message)
            elif isinstance(message, Hello):
                self._greeted(message)
            elif isinstance(message, Description):
                self._described(message)
            elif isinstance(message, Refusal):
                self._refused(message)
        self.count(corrupt=self._lines.dropped - dropped)
        return found

    def due(self, t: float) -> bytes:
        """Return what to send now."""
        self._clock.turn(t)
        said = self._said(t)
        if said:
            self._sent = t
        return said

    def rest(self, t: float) -> None:
        """Let every device rest."""
        self._orders.clear()
        if self.state.activity is Activity.WORKING:
            self._halt()
            self.state = ActuatorState(Activity.RESTING)

    def begin(self, t: float) -> None:
        """Let every device rest, and ask anew who it is."""
        self._begin()

    @property
    def remarks(self) -> list[Reason]:
        """Return which wheels slow down at rest."""
        return [Reason(ActuatorRemark.SPINS_DOWN, (name,)) for name in self._spinning]

    def _give(self, inputs: Mapping[str, float], t: float) -> None:
        """Take up inputs; a device that rests is armed first, if there is anything to do."""
        if self.state.activity is Activity.RESTING:
            if not any(inputs.values()):
                return
            self._armed = False
            self._orders.put(Order())
        self._orders.put(Order(dict(inputs)))
        pulsed = {d.name for d in self._devices if TRAITS[type(d)].pulsed}
        lasting = {name: value for name, value in inputs.items() if name not in pulsed}
        self.state = ActuatorState(Activity.WORKING, inputs={**self.state.inputs, **lasting})

    # --- What is said ------------------------------------------------------------------------

    def _said(self, t: float) -> bytes:
        activity = self.state.activity
        if activity is Activity.CONNECTING:
            return self._question(t)
        if activity is not Activity.FAULT:
            self._check_patience()
        if self._halting:
            return self._once_in(AGAIN, HALT, t)
        if self.state.activity is not Activity.WORKING:
            return b""
        return self._orders.due(t) or (BEAT if self._armed and t - self._sent >= AGAIN else b"")

    def _question(self, t: float) -> bytes:
        """Return the next question: who it is, then what each of its outputs is."""
        waited = self._clock.now - self._since
        if waited > BEGINNING:
            if self._received:
                self._fault(ActuatorFault.NOT_ITS_KIND, "device lines", self._received)
            else:
                self._fault(ActuatorFault.NOTHING_RECEIVED, waited=waited)
            return b""
        line = HELLO if self._next < 0 else checked(f'{{"describe":{self._next}}}')
        return self._once_in(REPEATED, line, t)

    def _once_in(self, seconds: float, line: bytes, t: float) -> bytes:
        return line if t - self._sent >= seconds else b""

    def _check_patience(self) -> None:
        """Find a fault with a device that is silent, late, or does not rest."""
        now, working = self._clock.now, self.state.activity is Activity.WORKING
        silent, late = now - self._alive, self._orders.waited
        if silent > (STALE if working or self._halting else SILENCE):
            self._fault(ActuatorFault.SILENT, self._received or "none", waited=silent)
        elif late > STALE:
            order = self._orders.pending
            what = "an input" if order is not None and order.inputs else "to begin to work"
            self._fault(ActuatorFault.LATE, what, waited=late)
        elif self._halting and now - self._halted > STALE:
            self._fault(ActuatorFault.NOT_STOPPED, waited=now - self._halted)

    def _halt(self) -> None:
        self._halting, self._halted, self._sent = True, self._clock.now, float("-inf")

    # --- What is received --------------------------------------------------------------------

    def _greeted(self, hello: Hello) -> None:
        if self.state.activity is Activity.CONNECTING and self._next < 0:
            self._deadman = hello.deadman
            self._next = 0
            self._agree(disagreement_at_hello(hello, self._devices))

    def _described(self, description: Description) -> None:
        if self.state.activity is Activity.CONNECTING and description.index == self._next:
            device = self._devices[self._next]
            if description.rest != "hold":
                self._spinning = (*self._spinning, device.name)
            self._next += 1
            self._agree(disagreement(description, device))

    def _agree(self, wrong: str) -> None:
        """Go on to the next question, or to rest after the last."""
        self._sent, self._since = float("-inf"), self._clock.now
        if wrong:
            self._fault(ActuatorFault.DISAGREES, wrong)
        elif self._next == len(self._devices):
            self.state = ActuatorState(Activity.RESTING)
            self._alive = self._clock.now

    def _refused(self, refusal: Refusal) -> None:
        """Find a fault with a refusal, unless the line was garbled: then it is said again."""
        working = self.state.activity is Activity.WORKING and not self._halting
        if working and refusal.number and refusal.code in (2, 3, 4):
            self._fault(ActuatorFault.REFUSED, f"order {refusal.number}", REFUSALS[refusal.code])

    def _reported(self, report: Report) -> list[Counted]:
        if not self._advanced(report):
            return []
        if self.state.activity is Activity.CONNECTING:
            return []
        if self._halting:
            self._halting = report.mode is Mode.WORKING
            if not self._halting:
                rest = dict.fromkeys(self._unit.drives, 0.0)
                self.taken.append(Taken(report.stamp, rest))
        elif report.fault and self.state.activity is not Activity.FAULT:
            self._fault(ActuatorFault.OWN_FAULT, number=report.fault)
        elif self.state.activity is Activity.WORKING:
            self._worked(report)
        elif report.mode is Mode.WORKING:
            self._halt()
        return [Counted(report.stamp, dict(zip(self._unit.drives, report.counted, strict=True)))]

    def _advanced(self, report: Report) -> bool:
        """Say whether a report is a new one; a device that hangs says the same again and again."""
        if report.stamp <= self._stamp:
            wrapped = self._stamp - report.stamp > TIRED
            if report.stamp == self._stamp or not (report.mode is Mode.BEGUN or wrapped):
                return False
            self.begun += 1
        self._alive, self._stamp = self._clock.now, report.stamp
        return True

    def _worked(self, report: Report) -> None:
        """Note what was taken; a device that rests though it was armed is at fault."""
        if self._armed and report.mode is not Mode.WORKING:
            self._fault(UNASKED[report.mode], allowed=self._deadman)
        elif report.mode is Mode.WORKING:
            order = self._orders.taken(report.taken)
            if order is not None and order.inputs:
                self.taken.append(Taken(report.stamp, order.inputs))
            self._armed = self._armed or order is not None

    # --- Beginning and fault -----------------------------------------------------------------

    def _begin(self) -> None:
        self._orders.clear()
        self.state = ActuatorState(Activity.CONNECTING)
        self._next, self._sent = -1, float("-inf")
        self._stamp: float = -1.0
        self._alive = self._since = self._halted = self._clock.now
        self._armed = self._halting = False
        self._received, self._spinning = "", tuple[str, ...]()
        self.begun += 1

    def _fault(self, code: ActuatorFault, *names: str, **numbers: Number) -> None:
        """Let every device rest, if halts still reach it; nothing is driven until it restarted."""
        if self.state.activity is not Activity.FAULT:
            fault = Reason(code, names, numbers)
            self.state = replace(ActuatorState(Activity.FAULT), fault=fault)
        self._orders.clear()
        self._halt()
