"""A quaternion PD controller on wheels, with gravity's torque fed forward and without.

The torque comes through a UDP datagram on this computer. The controller knows the inertia as the
testbed states it, and has no integral. The tracker begins with the testbed's own doubt; neither it
nor the controller knows of the sag of the deck.
"""

import socket
from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from equipoise.actuators.reaction_wheels import wheel_torques
from equipoise.app.live.feed_forward import DatagramStream, FeedForward
from equipoise.control.elements.attitude_pid import (
    DAMPING,
    FREQUENCY,
    Gains,
    at_rest,
    error_of,
    torque,
    unwound,
)
from equipoise.io.stream.gravity_datagram import Datagram, replaces, unpacked, weight_at
from equipoise.io.testbed.presets import read_preset
from equipoise.maths.attitude import leaning
from equipoise.model.bench import Bench
from equipoise.model.given_numbers import NOTHING_GIVEN
from equipoise.model.testbed import Testbed
from equipoise.procedure.steps.sampler import opened, sample_of, sampled
from equipoise.simulation.bench import SimulatedBench
from tests.oracle.mujoco_live import MujocoBench, platform_of
from verification.result import Result, Row, Spread, at_least, at_most, in_turn

Array = NDArray[np.float64]
OFFSET = 3e-6  # m, greatest along each axis
SD = 8e-6  # m, of the centre of mass as it is stated, along each axis
TILT = np.radians(5.0)  # at which the platform is to stand
START = np.radians([2.0, -1.5, 10.0])  # roll, pitch, yaw at the beginning
PERIOD = 0.1  # s, of the controller
SETTLING, POINTING = 20.0, 40.0  # s: of the loop and of the tracker; in which errors are counted
HALF = 0.5
ON_MUJOCO = 3  # seeds, of those that MuJoCo has moved, too


class Pointed(NamedTuple):
    """One run of the controller."""

    rms: float  # rad, of the angle to the attitude that is wanted
    usable: float  # s, when the torque was usable first; inf: never, or not requested
    lost: int  # datagrams


class TrueAttitude(Bench, Protocol):
    """A bench that says how it really stands."""

    @property
    def attitude(self) -> Array:
        """Attitude now, body to laboratory."""
        ...


class Simulated(SimulatedBench):
    """The simulated bench, asked for its true attitude."""

    @property
    def attitude(self) -> Array:
        """Attitude now, body to laboratory."""
        return self._now[:4]


class Receiver:
    """The controller's end of the stream, as the C header has it."""

    def __init__(self) -> None:
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._socket.bind(("127.0.0.1", 0))
        self._socket.settimeout(1.0)
        self.port: int = self._socket.getsockname()[1]
        self._last: Datagram | None = None
        self._arrived = -np.inf
        self.usable = np.inf

    def take(self, t: float) -> None:
        """Take the datagram that was sent at ``t`` (s)."""
        found = unpacked(self._socket.recv(4096))
        if replaces(found, self._last, t - self._arrived):
            self._last, self._arrived = found, t
            self.usable = min(self.usable, t)

    def first_moment(self, t: float) -> Array:
        """Return what to act on at ``t`` (s), kg m."""
        if self._last is None:
            return np.zeros(3)
        weight = weight_at(t - self._arrived, self._last.hold)
        return weight * self._last.content.first_moment

    def close(self) -> None:
        """Close the port."""
        self._socket.close()


def bed_for() -> Testbed:
    """Return the reference table, balanced to some micrometres."""
    bed = read_preset("reference-table")
    assert bed.truth is not None
    assert bed.magnetic_field is not None
    low, high = np.full(3, -OFFSET), np.full(3, OFFSET)
    truth = replace(bed.truth, com_low=low, com_high=high, attitude=START)
    body = replace(bed.body, com=np.zeros(3))
    field = replace(bed.magnetic_field, noise=None)
    return replace(bed, body=body, com_sd=np.full(3, SD), truth=truth, magnetic_field=field)


def simulated(seed: int) -> TrueAttitude:
    """Return a platform of the simulator: inertia up to 5 % off, a deck that sags, some drift."""
    return Simulated(bed_for(), seed)


def on_mujoco(seed: int) -> TrueAttitude:
    """Return a platform of MuJoCo's bodies: inertia 3 % off, no sag."""
    bed, rng = bed_for(), np.random.default_rng([seed, 41])
    com = rng.uniform(-OFFSET, OFFSET, 3)
    off = 1 + 0.03 * rng.normal(size=(3, 3))
    J = bed.body.inertia_P * (off + off.T) / 2
    rate = np.radians([0.2, -0.1, 0.2])
    return MujocoBench(bed, platform_of(bed, com, J, START, rate), seed)


def pointed(bench: TrueAttitude, fed: bool, silent_from: float = np.inf) -> Pointed:
    """Let the controller hold an attitude; the stream may stop at some time (s)."""
    bed, receiver = bench.testbed, Receiver()
    stream = DatagramStream("127.0.0.1", receiver.port)
    sender = FeedForward(bed, NOTHING_GIVEN, stream)
    wanted = at_rest(leaning(bed.up, np.array([0.8, 0.6, 0.0]), TILT))
    gains = Gains(bed.body.inertia_P, FREQUENCY, DAMPING, 0.0, 0.0)
    pid, known, errors = unwound(), opened(bed), list[float]()
    while bench.time < SETTLING + POINTING - 1e-9:
        rows = bench.read(PERIOD)
        if fed and bench.time < silent_from:
            sender(rows)
            receiver.take(bench.time)
        before, known = known, sampled(known, rows, bed)
        sample = sample_of(before, known, rows, bed)
        if sample is None:
            continue
        pid, u = torque(pid, sample, wanted, gains, receiver.first_moment(bench.time))
        speeds = known.states[: len(bed.wheels)]
        given = wheel_torques(bed.wheels, u, speeds, PERIOD).inputs
        bench.drive({w.name: float(x) for w, x in zip(bed.wheels, given, strict=True)})
        if bench.time > SETTLING:
            errors.append(float(np.linalg.norm(error_of(bench.attitude, wanted.q))))
    receiver.close()
    stream.sink.close()
    return Pointed(float(np.sqrt(np.mean(np.square(errors)))), receiver.usable, stream.sink.lost)
