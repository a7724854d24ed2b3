"""An actuator's driver and its emulated counterpart, turn by turn, and what devices were given."""

from equipoise.hardware.actuators.registry import ACTUATORS
from equipoise.hardware.emulated.registry import emulated_actuator
from equipoise.io.testbed.presets import read_preset
from equipoise.model.hardware import ActuatorUnit, Port
from equipoise.model.recording import Recording

BED = read_preset("reference-table")
TURN = 0.01  # s
DRIVES = ("rw_x", "mt_y", "jp_z")  # one of each kind


def unit_of(kind, drives=DRIVES):
    """Return a unit of a kind of driver."""
    return ActuatorUnit("mixed", kind, Port("serial:X"), tuple(drives))


class ActuatorWire:
    """Carries bytes there and back; devices do nothing, their inputs are kept."""

    def __init__(self, kind, drives=DRIVES, turn=TURN, devices=BED.devices):
        self.unit = unit_of(kind, drives)
        self.driver = ACTUATORS[kind](self.unit, devices)
        self.remote = emulated_actuator(self.unit, devices)
        self.t, self.turn = 2.0, turn  # s; it has long begun
        self.given, self.reports = [], []
        self.cut = False  # what the device says does not arrive
        self.sent = b""
        self.lost_there = lambda data: data  # what becomes of bytes to the device
        self.remote.run(self.t)
        self.driver.opened(self.t)

    def run(self, seconds, listen=True, until=""):
        """Let time pass, or until an activity; ``listen=False`` is a computer that has died."""
        end = self.t + seconds
        while self.t < end - 1e-9 and self.driver.state.activity != until:
            self.t = round(self.t + self.turn, 9)
            said, given = self.remote.run(self.t)
            self.given += given
            self.remote.observe(Recording(), self.t)
            if listen:
                self._talk(said)
        return self.driver.state

    def pause(self, seconds):
        """Let the host do nothing for a while; what the device says meanwhile waits for it."""
        end, waiting = self.t + seconds, b""
        while self.t < end - 1e-9:
            self.t = round(self.t + self.turn, 9)
            said, given = self.remote.run(self.t)
            self.given += given
            self.remote.observe(Recording(), self.t)
            waiting += said
        self._talk(waiting)

    def _talk(self, said):
        if not self.cut:
            self.reports += self.driver.feed(said, self.t)
        reported = self.lost_there(self.driver.due(self.t))
        self.sent += reported
        if reported:
            self.remote.take(reported, self.t)

    def at_rest(self):
        assert self.run(5.0, until="resting").activity == "resting"
        return self

    def working(self, inputs):
        self.at_rest()
        self.driver.drive(inputs, self.t)
        self.run(0.3)
        return self

    def value(self, name):
        """Return what a device was given last."""
        return next((each.value for each in reversed(self.given) if each.device == name), 0.0)
