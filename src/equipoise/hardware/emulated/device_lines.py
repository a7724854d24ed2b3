"""An emulated microcontroller that speaks device lines, with the outputs that a unit drives.

Written from docs/device-protocol.md, independently of the driver. It has memory for one line of 200
bytes, reads no line that its checksum does not vouch for, takes each order once and in order, and
rests when nothing has come for half a second. It does what it was last told, to the platform that
is simulated behind it; what it counts is what the platform's devices did.
"""

import json
from collections.abc import Callable, Sequence
from typing import Any, cast

import numpy as np

from equipoise.hardware.emulated.device import Given
from equipoise.model.arrays import Floats
from equipoise.model.devices import (
    REPORTED,
    TRAITS,
    Device,
    at_start,
    greatest_input,
    least_input,
    recorded_name,
)
from equipoise.model.hardware import ActuatorUnit
from equipoise.model.recording import Recording
from equipoise.model.units import MS

MEMORY = 200  # bytes of a line
DEADMAN, PERIOD, STARTING = 0.5, 0.02, 1.0  # s
BEGUN, WORKING, HALTED, DIED = 0, 1, 2, 3  # modes
BROKEN, UNKNOWN, COUNT, BEYOND, RESTING, LONG = 1, 2, 3, 4, 5, 6  # what is refused
OVER = 1e-6  # relative: what single precision makes of a limit
TIRED = 1 << 32  # ms: there its clock restarts


class EmulatedDeviceLines:
    """The firmware, and what it knows of its devices."""

    def __init__(self, unit: ActuatorUnit, devices: Sequence[Device]) -> None:
        by_name = {device.name: device for device in devices}
        self._name, self._devices = unit.name, [by_name[name] for name in unit.drives]
        self._observed = [at_start(device) for device in self._devices]  # as a recording has it
        self._counted_at = 0.0  # s
        self.powered, self.fault = True, 0
        self._begun: list[Given] = []
        self._reported = 0.0  # s, when it last was
        self._begin(-STARTING)

    def take(self, data: bytes, t: float) -> bytes:
        """Return what it answers at once."""
        said = b""
        if not self._awake(t):
            return said
        for value in data:
            if value != 10:
                self._line = self._line[:MEMORY] + bytes([value])
                continue
            line, self._line = self._line.rstrip(b"\r"), b""
            said += self._read(line, t) if line else b""
        return said

    def run(self, t: float) -> tuple[bytes, Sequence[Given]]:
        """Let time pass; return what it says unasked, and what it gives its devices."""
        if self._mode == WORKING and t - self._alive > DEADMAN:
            self._rest(DIED, t)
        said, self._said = self._said if self._awake(t) else b"", b""
        given, self._begun = self._begun, []
        return said, given

    def observe(self, rows: Recording, t: float) -> None:
        """Take what the devices did up to t (s), and report it when it is time to."""
        devices = rows.devices
        if devices is None:
            self._report(t)
            return
        columns = [rows.device_names.index(recorded_name(device)) for device in self._devices]
        for when, row in zip(devices.t.tolist(), devices.values[:, columns], strict=True):
            self._count(when, row)
            self._report(when)

    # --- What people do to it ----------------------------------------------------------------

    def press_reset(self, t: float) -> None:
        """Let it restart."""
        self._rest(BEGUN, t)
        self._begin(t)

    def switch(self, on: bool, t: float) -> None:
        """Switch the power; without it no device is driven."""
        self._rest(BEGUN, t)
        self._begin(t)
        self.powered = on

    # --- Lines -------------------------------------------------------------------------------

    def _read(self, line: bytes, t: float) -> bytes:
        if len(line) > MEMORY - 1:
            return self._error(LONG)
        body, asterisk, digits = line.rpartition(b"*")
        if not asterisk or digits != _sum(body):
            return self._error(BROKEN)
        try:
            message: Any = json.loads(body)
        except ValueError:
            return self._error(BROKEN)
        if not isinstance(message, dict):
            return self._error(BROKEN)
        self._alive = t
        obeyed: dict[str, Callable[[dict[str, Any], float], bytes]] = {
            "hello": self._hello,
            "describe": self._describe,
            "arm": self._arm,
            "set": self._set,
            "halt": self._halt,
            "beat": lambda _message, _t: b"",
        }
        known = cast("dict[str, Any]", message)
        return next((obey(known, t) for word, obey in obeyed.items() if word in known),
                    self._error(UNKNOWN))  # fmt: skip

    def _hello(self, _message: dict[str, Any], t: float) -> bytes:
        self._rest(HALTED if self._mode != BEGUN else BEGUN, t)
        n, dead, period = len(self._devices), round(DEADMAN / MS), round(PERIOD / MS)
        return _line(
            f'{{"hello":1,"name":"{self._name}","n":{n},"deadman_ms":{dead},"period_ms":{period}}}'
        )

    def _describe(self, message: dict[str, Any], _t: float) -> bytes:
        k = message["describe"]
        if not isinstance(k, int) or not 0 <= k < len(self._devices):
            return self._error(COUNT)
        device = self._devices[k]
        most, traits = greatest_input(device), TRAITS[type(device)]
        limit = 0.0 if np.isinf(most) else most
        return _line(
            f'{{"device":{k},"kind":"{REPORTED[type(device)]}","name":"{device.name}",'
            f'"in":"{traits.input_unit}","counts":"{traits.counted_unit}",'
            f'"max":{_number(limit)},"min":{_number(least_input(device))},"rest":"hold"}}'
        )

    def _arm(self, message: dict[str, Any], _t: float) -> bytes:
        if self.fault == 0:
            self._mode, self._last = WORKING, message["arm"]
        return b""

    def _set(self, message: dict[str, Any], t: float) -> bytes:
        number, found = message["set"], message.get("u")
        if self._mode != WORKING:
            return self._error(RESTING, number)
        inputs = cast("list[float | None]", found if isinstance(found, list) else [])
        if len(inputs) != len(self._devices):
            return self._error(COUNT, number)
        if number <= self._last:
            return b""
        wanted = [(d, float(u)) for d, u in zip(self._devices, inputs, strict=True)
                  if u is not None]  # fmt: skip
        if not all(_can(device, value) for device, value in wanted):
            return self._error(BEYOND, number)
        self._last = number
        self._begun += [Given(device.name, t, _fitted(device, u)) for device, u in wanted]
        return b""

    def _halt(self, _message: dict[str, Any], t: float) -> bytes:
        self._rest(HALTED, t)
        return b""

    def _error(self, code: int, number: int = 0) -> bytes:
        return _line(f'{{"err":{code},"at":{number}}}')

    # --- Devices -----------------------------------------------------------------------------

    def _rest(self, mode: int, t: float) -> None:
        if self._mode == WORKING:
            self._begun += [Given(device.name, t, 0.0) for device in self._devices]
        self._mode = mode

    def _count(self, t: float, row: Floats) -> None:
        for k, (device, value) in enumerate(zip(self._devices, row.tolist(), strict=True)):
            if TRAITS[type(device)].pulsed:  # a recording has the mean since the row before
                self._observed[k] += value * (t - self._counted_at)
            else:
                self._observed[k] = value
        self._counted_at = t

    def _report(self, t: float) -> None:
        if not self._awake(t) or t - self._reported < PERIOD - 0.1 * MS:
            return
        self._reported = t
        counted = ",".join(_number(o - z) for o, z in zip(self._observed, self._zero, strict=True))
        clock = round((t - self._started) / MS) % TIRED
        self._said += _line(
            f'{{"t_ms":{clock},"a":{self._last},"m":{self._mode},"f":{self.fault},"y":[{counted}]}}'
        )

    def _awake(self, t: float) -> bool:
        return self.powered and t - self._started >= STARTING

    def _begin(self, t: float) -> None:
        self._mode, self._last, self._line, self._said = BEGUN, 0, b"", b""
        self._started, self._alive = t, t
        pulsed = [TRAITS[type(device)].pulsed for device in self._devices]
        self._zero = [o if p else 0.0 for o, p in zip(self._observed, pulsed, strict=True)]


def _can(device: Device, value: float) -> bool:
    size = abs(value)
    most, least = greatest_input(device) * (1 + OVER), least_input(device) * (1 - OVER)
    return size <= most and (size == 0.0 or size >= least)


def _fitted(device: Device, value: float) -> float:
    """Return an input within the limits, of which the line has shown so many digits only."""
    size = min(abs(value), greatest_input(device))
    return float(np.sign(value)) * (max(size, least_input(device)) if size else 0.0)


def _number(value: float) -> str:
    return f"{value:.9f}"


def _line(text: str) -> bytes:
    body = text.encode()
    return body + b"*" + _sum(body) + b"\r\n"


def _sum(body: bytes) -> bytes:
    """Return the checksum, bit by bit, as a small processor computes it."""
    crc = 0xFFFF
    for value in body:
        crc ^= value << 8
        for _ in range(8):
            crc = ((crc << 1) ^ 0x1021 if crc & 0x8000 else crc << 1) & 0xFFFF
    return b"%04X" % crc
