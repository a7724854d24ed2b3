"""Wheels, gyros, coils and jets of the simulated bench, all of them followers of their inputs.

A cage's coils are driven too. What they and the background give is in ``surroundings``.

    device               input          y                       Y
    reaction wheel       torque         slope of speed rad/s^2  speed, within its limit
    control moment gyro  gimbal rate    gimbal rate             gimbal angle
    magnetorquer         dipole         dipole
    coil pair of a cage  field          field
    jet pair             impulse        torque, a pulse of impulse / torque seconds

They report what they do, with the noise of tachometers and encoders; their inputs are not reported.
"""

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from equipoise.actuators.control_moment_gyros import gimbal_coordinates, rotor_momentum
from equipoise.actuators.jets import on_platform
from equipoise.actuators.magnetorquers import dipole_of
from equipoise.actuators.reaction_wheels import wheel_momentum
from equipoise.maths.attitude import to_matrix
from equipoise.model.arrays import Floats, Series1, Series3, Series4
from equipoise.model.bench_requests import checked_inputs
from equipoise.model.devices import (
    CoilPair,
    ControlMomentGyro,
    Device,
    JetPair,
    Magnetorquer,
    ReactionWheel,
)
from equipoise.model.testbed import Testbed
from equipoise.simulation.clock import tick_one
from equipoise.simulation.followers import Followers, at_rest, followed
from equipoise.simulation.magnetised import PIECE

ALWAYS = 1.0  # s, chosen: a node at least so often, whatever the sensors do
GIMBALS = 0.004  # s, chosen: at 1 rad/s a straight line for h then errs by 2e-6 of it
LEAST_LAG = 1e-3  # s, chosen: no coil and no valve is faster
HAIR = 1e-9  # relative, chosen: a time at the end of a piece may be rounded beyond it by so much


class Inputs(NamedTuple):
    """What devices are given, by index."""

    goals: dict[int, float]  # of y
    lasting: dict[int, float]  # s, of pulses


def started(testbed: Testbed) -> Followers:
    """Return the devices as they are at the start."""
    wheels, devices = testbed.wheels, testbed.devices
    lag = [each.lag if isinstance(each, ReactionWheel | ControlMomentGyro)
           else max(each.lag, LEAST_LAG) for each in devices]  # fmt: skip
    rest = np.full(len(devices) - len(wheels), np.inf)
    limit = np.concatenate([np.array([wheel.max_speed for wheel in wheels]), rest])
    begin = [wheel.speed for wheel in wheels] + [gyro.angle for gyro in testbed.cmgs]
    Y = np.concatenate([np.array(begin), np.zeros(len(devices) - len(begin))])
    held = [each.field if isinstance(each, CoilPair) else 0.0 for each in devices]
    return at_rest(np.array(lag), limit, Y, np.array(held))


def grid_of(testbed: Testbed) -> float:
    """Return how often there must be a node, s."""
    if testbed.cmgs:
        return GIMBALS
    return PIECE if testbed.magnetorquers else ALWAYS


def kept_until(testbed: Testbed, t: float) -> float:
    """Return up to when the motion need not be followed again: coils work in whole pieces, s."""
    return tick_one(PIECE * float(np.floor(t / PIECE + HAIR))) if testbed.magnetorquers else t


def inputs_of(testbed: Testbed, inputs: Mapping[str, float]) -> Inputs:
    """Return inputs by index; InputError for a wrong name or number, DriveRefused beyond limits."""
    found = Inputs({}, {})
    for i, requested in checked_inputs(testbed.devices, inputs).items():
        device = testbed.devices[i]
        found.goals[i] = goal_of(device, requested)
        if isinstance(device, JetPair) and requested:
            found.lasting[i] = abs(requested) / device.torque
    return found


def goal_of(device: Device, requested: float) -> float:
    """Return the input of one device, checked, as a goal of its y."""
    if isinstance(device, JetPair):
        return float(np.sign(requested)) * device.torque
    return requested / device.inertia if isinstance(device, ReactionWheel) else requested


def all_off(testbed: Testbed) -> dict[int, float]:
    """Return goals that leave wheels at their speed and all else on the platform without effect.

    A cage stands beside it, and its field goes on.
    """
    return {i: 0.0 for i, each in enumerate(testbed.devices) if not isinstance(each, CoilPair)}


def stored(testbed: Testbed, devices: Followers, t: Series1) -> tuple[Series3, Floats]:
    """Return stored momentum (n, 3) N m s and gimbal coordinates (n, 3 g) at times (s)."""
    _, Y = followed(devices, t)
    angles = Y[:, testbed.columns(ControlMomentGyro)]
    h, gimbals = np.zeros((len(t), 3)), np.zeros((len(t), 0))
    if testbed.wheels:
        h += wheel_momentum(testbed.wheels, Y[:, testbed.columns(ReactionWheel)])
    if testbed.cmgs:
        h += rotor_momentum(testbed.cmgs, angles)
        gimbals = gimbal_coordinates(testbed.cmgs, angles)
    return h, gimbals


def effects(testbed: Testbed, devices: Followers, t: Series1) -> tuple[Series3, Series3]:
    """Return total dipole (n, 3) A m^2 and torque of jets (n, 3) N m at times (s), body axes."""
    y, _ = followed(devices, t)
    coils, jets = y[:, testbed.columns(Magnetorquer)], y[:, testbed.columns(JetPair)]
    none = np.zeros((len(t), 3))
    return (
        dipole_of(testbed.magnetorquers, coils) if testbed.magnetorquers else none,
        on_platform(testbed.jets, jets) if testbed.jets else none,
    )


def field_rows(q: Series4, field_N: Series3, noise: float, rng: np.random.Generator) -> Series3:
    """Return a magnetometer's rows (n, 3) T, body axes, at attitudes, in fields (n, 3) T."""
    turned: Series3 = np.einsum("ni,nij->nj", field_N, to_matrix(q))
    return turned + noise * rng.standard_normal(turned.shape)


def reported_states(
    testbed: Testbed, devices: Followers, t: Series1, rng: np.random.Generator, gap: float
) -> Floats:
    """Return what the devices report at times (s), (n, k), with the noise of their sensors.

    A wheel at rest is reported at rest; a jet reports the mean since ``gap`` (s) before, so that
    no pulse is lost between two rows.
    """
    y, Y = followed(devices, t)
    w, g = len(testbed.wheels), len(testbed.cmgs)
    mean = (Y - followed(devices, t - gap)[1]) / gap
    jets = len(testbed.devices) - len(testbed.jets)
    rows = np.hstack([Y[:, : w + g], y[:, w + g : jets], mean[:, jets:]])
    sd = [wheel.speed_noise for wheel in testbed.wheels] + [c.angle_noise for c in testbed.cmgs]
    noise = rng.standard_normal((len(t), w + g)) * np.array(sd)
    turning = np.hstack([rows[:, :w] != 0, np.ones((len(t), g), dtype=bool)])
    rows[:, : w + g] += np.where(turning, noise, 0.0)
    return rows
