"""A quaternion PD controller on wheels, with gravity's torque fed forward and without.

The torque comes through a UDP datagram on this computer. The controller knows the inertia as the
testbed states it, and has no integral. The tracker begins with the testbed's own doubt; neither it
nor the controller knows of the sag of the deck.
"""

import socket
from collections.abc import Callable, Sequence
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
from equipoise.maths.attitude import leaning, to_matrix
from equipoise.model.bench import Bench
from equipoise.model.given_numbers import NOTHING_GIVEN
from equipoise.model.gravity_torque import GravityTorque
from equipoise.model.testbed import Testbed
from equipoise.model.units import DEG, UM
from equipoise.procedure.steps.sampler import opened, sample_of, sampled
from equipoise.simulation.bench import SimulatedBench
from tests.oracle.mujoco_live import MujocoBench, platform_of
from verification.result import Result, Row, Spread, at_most, in_turn

Array = NDArray[np.float64]
OFFSET = 3e-6  # m, greatest along each axis
SD = 8e-6  # m, of the centre of mass as it is stated, along each axis
TILT = np.radians(5.0)  # at which the platform is to stand
START = np.radians([2.0, -1.5, 10.0])  # roll, pitch, yaw at the beginning
PERIOD = 0.1  # s, of the controller
SETTLING, POINTING = 20.0, 40.0  # s: of the loop and of the tracker; in which errors are counted
HALF = 0.5  # of the pointing error
CLOSE, HONEST = 0.3 * UM, 1.3  # m, rms; stated sds, chosen: what is left of the torque
ON_MUJOCO = 3  # seeds, of those that MuJoCo has moved, too


class Pointed(NamedTuple):
    """One run of the controller."""

    rms: float  # rad, of the angle to the attitude that is wanted
    usable: float  # s, when the torque was usable first; inf: never, or not requested
    lost: int  # datagrams
    error: Array  # (n, 2) N m, of the torque about x and y, after settling
    sd: Array  # (n, 2) N m, as the datagrams state it


class Pair(NamedTuple):
    """The same platform without and with the feed-forward."""

    seed: int
    without: Pointed
    fed: Pointed

    @property
    def ratio(self) -> float:
        """The pointing error with it over that without."""
        return self.fed.rms / self.without.rms


class TrueBench(Bench, Protocol):
    """A bench that says how it really stands."""

    @property
    def attitude(self) -> Array:
        """Attitude now, body to laboratory."""
        ...

    @property
    def com(self) -> Array:
        """Centre of mass now, m, without sag."""
        ...


class Simulated(SimulatedBench):
    """The simulated bench, asked for its true attitude."""

    @property
    def attitude(self) -> Array:
        """Attitude now, body to laboratory."""
        return self._now[:4]


def true_torque(bench: TrueBench) -> Array:
    """Return gravity's torque now, N m, body axes."""
    sag = bench.sag if isinstance(bench, SimulatedBench) else np.zeros((3, 3))
    n = -to_matrix(bench.attitude)[2]
    return bench.testbed.weight * np.cross(bench.com + sag @ n, n)


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

    def take(self, t: float) -> GravityTorque:
        """Take the datagram that was sent at ``t`` (s); return what it holds."""
        found = unpacked(self._socket.recv(4096))
        if replaces(found, self._last, t - self._arrived):
            self._last, self._arrived = found, t
            self.usable = min(self.usable, t)
        return found.content

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


def simulated(seed: int) -> TrueBench:
    """Return a platform of the simulator: inertia up to 5 % off, a deck that sags, some drift."""
    return Simulated(bed_for(), seed)


def on_mujoco(seed: int) -> TrueBench:
    """Return a platform of MuJoCo's bodies: inertia 3 % off, no sag."""
    bed, rng = bed_for(), np.random.default_rng([seed, 41])
    com = rng.uniform(-OFFSET, OFFSET, 3)
    off = 1 + 0.03 * rng.normal(size=(3, 3))
    J = bed.body.inertia_P * (off + off.T) / 2
    rate = np.radians([0.2, -0.1, 0.2])
    return MujocoBench(bed, platform_of(bed, com, J, START, rate), seed)


def rms_of(values: Sequence[float] | Array) -> float:
    """Return the root mean square."""
    return float(np.sqrt(np.mean(np.square(values))))


def pointed(bench: TrueBench, fed: bool, silent_from: float = np.inf) -> Pointed:
    """Let the controller hold an attitude; the stream may stop at some time (s)."""
    bed, receiver = bench.testbed, Receiver()
    stream = DatagramStream("127.0.0.1", receiver.port)
    sender = FeedForward(bed, NOTHING_GIVEN, stream)
    wanted = at_rest(leaning(bed.up, np.array([0.8, 0.6, 0.0]), TILT))
    gains = Gains(bed.body.inertia_P, FREQUENCY, DAMPING, 0.0, 0.0)
    pid, known, errors = unwound(), opened(bed), list[float]()
    torques: list[tuple[Array, Array]] = []
    while bench.time < SETTLING + POINTING - 1e-9:
        rows = bench.read(PERIOD)
        if fed and bench.time < silent_from:
            sender(rows)
            content = receiver.take(bench.time)
            torques.append((content.torque - true_torque(bench), content.torque_sd))
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
    stream.close()
    rms, late = rms_of(errors), torques[round(SETTLING / PERIOD) :]
    error, sd = (np.array([each[k][:2] for each in late]).reshape(-1, 2) for k in (0, 1))
    return Pointed(rms, receiver.usable, stream.lost, error, sd)


def compared(task: tuple[Callable[[int], TrueBench], int]) -> Pair:
    """Let the controller hold one platform without the feed-forward, and with it."""
    make, seed = task
    return Pair(seed, pointed(make(seed), fed=False), pointed(make(seed), fed=True))


def rows_of(where: str, pairs: Sequence[Pair]) -> tuple[Row, ...]:
    """Return what came of some platforms."""
    without = rms_of([each.without.rms for each in pairs]) / DEG
    fed = rms_of([each.fed.rms for each in pairs]) / DEG
    weight = bed_for().weight
    left = np.vstack([each.fed.error for each in pairs]) / weight / UM
    z = np.vstack([each.fed.error / each.fed.sd for each in pairs])
    text = f"{without:.3f} deg without, {fed:.4f} deg with"
    x, y = rms_of(left[:, 0]), rms_of(left[:, 1])
    return (
        Row(f"{where}: pointing error, rms of {len(pairs)} platforms", text,
            f"at most {HALF:g} of it", bool(fed <= HALF * without)),
        at_most(f"{where}: worst platform, error with over without",
                max(each.ratio for each in pairs), HALF),
        at_most(f"{where}: centre of mass that is left sideways, rms about y and x, um "
                f"({y:.2f}, {x:.2f}), greater", max(x, y), CLOSE / UM),
        at_most(f"{where}: error of the torque in its stated sd, rms",
                rms_of(z), HONEST),
        at_most(f"{where}: s until the torque is usable, worst",
                max(each.fed.usable for each in pairs), SETTLING),
        at_most(f"{where}: datagrams lost", sum(each.fed.lost for each in pairs), 0),
    )  # fmt: skip


def measure(seeds: Sequence[int], spread: Spread = in_turn, on_other: int = ON_MUJOCO) -> Result:
    """Compare the controller with and without the feed-forward on the platforms of the seeds."""
    bed = bed_for()
    assert bed.attitude is not None
    assert bed.gyro is not None
    tasks = [(simulated, seed) for seed in seeds]
    tasks += [(on_mujoco, seed) for seed in list(seeds)[:on_other]]
    pairs: list[Pair] = spread(compared, tasks)
    ours, theirs = pairs[: len(seeds)], pairs[len(seeds) :]
    claim = (
        f"Preset reference-table, {bed.body.mass:g} kg, centre of mass within {OFFSET / UM:g} um "
        f"of its place along each axis and stated to {SD / UM:g} um (sd), inertia some percent "
        f"off, camera {bed.attitude.noise / DEG:.2g} deg at {bed.attitude.rate:g} Hz, gyro "
        f"{bed.gyro.noise / DEG:.2g} deg/s at {bed.gyro.rate:g} Hz. A quaternion PD controller on "
        f"wheels, {1 / PERIOD:g} Hz, {FREQUENCY:g} rad/s, damping {DAMPING:g}, without integral, "
        f"holds a tilt of {TILT / DEG:g} deg. Errors are true ones, from {SETTLING:g} s to "
        f"{SETTLING + POINTING:g} s. Gravity's torque comes in UDP datagrams. The simulator's deck "
        "sags by 25 um, which nobody is given; MuJoCo's does not."
    )
    rows = rows_of("simulator", ours) + (rows_of("MuJoCo", theirs) if theirs else ())
    return Result("feed_forward", claim, rows)
