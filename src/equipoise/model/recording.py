"""A recording: what sensors and masses reported, verbatim, each channel at its own times.

Times are seconds on one clock and grow strictly within a channel. Mass displacements, stored
momentum and known torque are straight lines between their rows, and constant outside them.

A device's name begins with what is reported of it ('wheel:x', ``model.devices.recorded_name``):
a file writes each kind in its own unit, and is read without a testbed.

The torque by cause alone was not reported: it was found from the other channels and written beside
them (``model.torque_by_cause``). No estimator reads it.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from equipoise.model.arrays import Bools, Series, Series1
from equipoise.model.devices import Device, at_start, recorded_name
from equipoise.model.errors import InputError, nearest
from equipoise.model.from_memory import FromMemory
from equipoise.model.presentation import Plotted
from equipoise.model.unread_input import UnreadInput


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Samples:
    """One channel."""

    t: Series1  # s
    values: Series  # (n, k), SI

    def __repr__(self) -> str:
        """Return how many rows there are, and from when to when."""
        if not len(self):
            return "Samples(no rows)"
        rows = f"{len(self)} rows of {self.values.shape[1]}"
        return f"Samples({rows}, {self.t[0]:g} to {self.t[-1]:g} s)"

    def __len__(self) -> int:
        """Return the number of rows."""
        return len(self.t)

    def where(self, keep: Bools | slice) -> "Samples":
        """Return some of the rows."""
        return Samples(self.t[keep], self.values[keep])

    @property
    def varies(self) -> bool:
        """Say whether any row differs from the first."""
        return bool(np.any(self.values != self.values[:1]))

    @property
    def period(self) -> float:
        """Return the median time from a row to the next, s; there must be two rows.

        A few gaps and missing rows do not change it.
        """
        return float(np.median(np.diff(self.t)))


def runs(mask: Bools) -> list[tuple[int, int]]:
    """Return the first and the last row of each run in a mask."""
    edges = np.flatnonzero(np.diff(np.concatenate([[0], mask.astype(int), [0]])))
    return [(int(a), int(b) - 1) for a, b in edges.reshape(-1, 2)]


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Recording(Plotted, FromMemory):
    """What was recorded. Any channel may be absent."""

    attitude: Samples | None = None  # (n, 4) unit quaternions, scalar first, body to laboratory
    rate: Samples | None = None  # (n, 3) rad/s, body axes, as the gyro gave them
    mass_names: tuple[str, ...] = ()
    masses: Samples | None = None  # (n, k) m, displacement from home as reported
    momentum: Samples | None = None  # (n, 3) N m s, stored in wheels, body axes
    torque: Samples | None = None  # (n, 3) N m, known, body axes
    device_names: tuple[str, ...] = ()  # 'wheel:x', 'gimbal:a', 'dipole:x', 'cage:x', 'jet:x'
    devices: Samples | None = None  # (n, k) what each reported: rad/s, rad, A m^2, T, N m
    field: Samples | None = None  # (n, 3) T, magnetic, body axes, as the magnetometer gave it
    temperature: Samples | None = None  # (n, 1) degC, of the air at the bench or of the platform
    lamp: Samples | None = None  # (n, 1) of its full power, from each row to the next
    accelerometer: Samples | None = None  # (n, 3) m/s^2, specific force, body axes: +g up at rest
    sun: Samples | None = None  # (n, 3) unit vectors to the lamp, body axes
    position: Samples | None = None  # (n, 2) m, of P on a planar table, laboratory axes
    cause_names: tuple[str, ...] = ()  # 'gravity_x', 'gravity_sd_x': mean torque, and its sd
    torque_by_cause: Samples | None = None  # (n, k) N m, body axes, of the second behind each row
    # (n, 1) lengths of the attitude's quaternions as they were found, at the attitude's times; None
    # when they differ by no more than rounding. A mean of frames is shorter than one. Not written.
    attitude_norm: Samples | None = None
    source: str = ""  # the file, or the bench
    sha256: str = ""  # of the file's bytes; empty when it never was a file
    notes: tuple[str, ...] = ()  # what reading it had to set right
    gaps: tuple[str, ...] = ()  # where reading it found a sensor silent
    unread: tuple[UnreadInput, ...] = ()  # columns of its file that may say what drove it
    free_from: float | None = None  # s, when the platform was let go, where the file states it

    @property
    def rows(self) -> int:
        """Return how many rows camera and gyro have."""
        return sum(len(c) for c in (self.attitude, self.rate) if c is not None)

    @property
    def span(self) -> tuple[float, float]:
        """Return the first and last time of any sensor row, s."""
        edges = [(c.t[0], c.t[-1]) for c in (self.attitude, self.rate) if c is not None and len(c)]
        return float(min(e[0] for e in edges)), float(max(e[1] for e in edges))


CHANNELS = ("attitude", "rate", "masses", "momentum", "torque", "devices", "field", "temperature",
            "lamp", "accelerometer", "sun", "position", "torque_by_cause")  # fmt: skip
INPUTS = ("masses", "momentum", "torque", "devices", "lamp")  # known between their rows
# Channels whose columns have names, and where a recording has these.
NAMED = {"masses": "mass_names", "devices": "device_names", "torque_by_cause": "cause_names"}


def column_names(recording: Recording, channel: str) -> tuple[str, ...]:
    """Return the names of a channel's columns; none of a channel without names."""
    return getattr(recording, NAMED[channel]) if channel in NAMED else ()


def window(recording: Recording, start: float, end: float) -> Recording:
    """Return the part from ``start`` to ``end`` (s); inputs keep the row before and after it."""
    parts = {
        name: (_known if name in INPUTS else _sensed)(getattr(recording, name), start, end)
        for name in (*CHANNELS, "attitude_norm")
    }
    return replace(recording, **parts)


def _sensed(channel: Samples | None, start: float, end: float) -> Samples | None:
    if channel is None:
        return None
    return channel.where((channel.t >= start) & (channel.t <= end))


def _known(channel: Samples | None, start: float, end: float) -> Samples | None:
    if channel is None or not len(channel):
        return channel
    first = max(int(np.searchsorted(channel.t, start, side="right")) - 1, 0)
    last = int(np.searchsorted(channel.t, end, side="left")) + 1
    return channel.where(slice(first, last))


def rows_between(recording: Recording, since: float, until: float) -> Recording:
    """Return the rows after one time (s) and up to another; a channel without any is absent."""
    parts = {
        name: _between(getattr(recording, name), since, until)
        for name in (*CHANNELS, "attitude_norm")
    }
    return replace(recording, **parts)


def _between(channel: Samples | None, since: float, until: float) -> Samples | None:
    if channel is None:
        return None
    first, last = np.searchsorted(channel.t, [since, until], side="right")
    return channel.where(slice(first, last)) if last > first else None


def join(first: Recording, second: Recording) -> Recording:
    """Return the two, one after the other; rows of the second at or before the first's end go."""
    parts = {name: _both(getattr(first, name), getattr(second, name)) for name in CHANNELS}
    lengths = _both(first.attitude_norm, _lengths_after(first.attitude, second.attitude_norm))
    names = {each: getattr(first, each) or getattr(second, each) for each in NAMED.values()}
    return replace(first, attitude_norm=lengths, **parts, **names)


def _both(a: Samples | None, b: Samples | None) -> Samples | None:
    if a is None or b is None or not len(a):
        return b if a is None or not len(a) else a
    new = b.t > a.t[-1]
    return Samples(np.append(a.t, b.t[new]), np.vstack([a.values, b.values[new]]))


def joined(parts: Sequence[Recording]) -> Recording:
    """Return records as one, two by two: what is copied grows with n log n, not with n^2."""
    if len(parts) == 1:
        return parts[0]
    half = len(parts) // 2
    return join(joined(parts[:half]), joined(parts[half:]))


def _lengths_after(attitude: Samples | None, lengths: Samples | None) -> Samples | None:
    """Return the lengths of rows that a join keeps, though the first may have none of its own."""
    if attitude is None or lengths is None or not len(attitude):
        return lengths
    return lengths.where(lengths.t > attitude.t[-1])


def arranged(recording: Recording, names: tuple[str, ...]) -> Recording:
    """Return the recording with its mass columns in the order of ``names``, absent masses at home.

    Raises InputError for a mass that is not among the names.
    """
    masses = recording.masses
    if masses is None or recording.mass_names == names:
        return recording
    have = recording.mass_names or names[: masses.values.shape[1]]
    where = f"{recording.source or 'recording'}: masses"
    masses = _in_order(masses, have, dict.fromkeys(names, 0.0), where)
    return replace(recording, mass_names=names, masses=masses)


def arranged_devices(recording: Recording, devices: tuple[Device, ...]) -> Recording:
    """Return the recording with its device columns in the order of a testbed's devices.

    A device that has no column stays as it is at the start. Raises InputError for a column of no
    device.
    """
    start = {recorded_name(device): at_start(device) for device in devices}
    rows, names = recording.devices, tuple(start)
    if rows is None or recording.device_names == names:
        return recording
    where = f"{recording.source or 'recording'}: devices"
    rows = _in_order(rows, recording.device_names, start, where)
    return replace(recording, device_names=names, devices=rows)


def _in_order(
    rows: Samples, have: tuple[str, ...], wanted: dict[str, float], where: str
) -> Samples:
    """Return columns in the wanted order; what there is no column of stands at its value."""
    names = list(wanted)
    for name in have:
        if name not in wanted:
            none = "none: the testbed has none"
            raise InputError(where, f"'{name}'", nearest(name, names) if names else none)
    values = np.tile(np.array(list(wanted.values()), float), (len(rows), 1))
    for column, name in zip(rows.values.T, have, strict=True):
        values[:, names.index(name)] = column
    return Samples(rows.t, values)
