"""Stored momentum against bodies that turn: our propagator with MuJoCo's wheels and gyros.

The platform's attitude over a minute agrees within 1e-6 rad, whether wheels are driven, gyros with
inertia of their own are gimballed, or both while a mass travels. Left out, each of these effects
moves the platform by far more.
"""

from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip("mujoco", reason="MuJoCo is a development dependency")

from equipoise.actuators.control_moment_gyros import (
    gimbal_coordinates,
    gimbal_maps,
    spin_axes,
)
from equipoise.actuators.reaction_wheels import wheel_momentum
from equipoise.actuators.sliding_masses import MassMaps, inertia_shift, mass_maps
from equipoise.actuators.stored_momentum import stored_momentum
from equipoise.dynamics.propagation import body_of, stacked
from equipoise.dynamics.rigid_body import KNOWN_D
from equipoise.maths.attitude import to_matrix
from equipoise.maths.linalg import pack_symmetric, unpack_symmetric
from equipoise.model.devices import ControlMomentGyro, ReactionWheel
from equipoise.model.mass_properties import MassProperties
from equipoise.model.recording import Recording, Samples
from equipoise.model.testbed import SlidingMass, Testbed
from equipoise.simulation.motion import run
from tests.oracle import mujoco_momentum as oracle
from tests.oracle.mujoco_bench import (
    Platform,
    Ramp,
    Slide,
    angle_between,
    command,
    middles,
    rotation,
)
from tests.support.gyro_pyramid import with_light_gimbals

DT, DURATION = 1e-3, 60.0
T = middles(DURATION, DT)
INERTIA = np.array([[0.46, -0.008, 0.031], [-0.008, 0.53, 0.011], [0.031, 0.011, 0.78]])
AGREE = 1e-6  # rad


def unit(*x):
    return np.array(x) / np.linalg.norm(x)


def platform(gravity=9.81, slides=()):
    return Platform(
        14.0, INERTIA, np.array([20e-6, -10e-6, -80e-6]), slides, gravity,
        rotation(np.array([0.06, -0.04, 0.7])), np.array([0.02, -0.03, 0.05]),
    )  # fmt: skip


WHEELS = (
    oracle.Wheel("wx", np.array([0.15, 0.0, 0.05]), unit(1, 0.1, 0), 0.4, 5e-4, 3e-4, 100.0),
    oracle.Wheel("wy", np.array([0.0, 0.15, 0.0]), unit(0, 1, -0.2), 0.4, 5e-4, 3e-4, -50.0),
    oracle.Wheel("wz", np.array([0.0, -0.1, -0.1]), unit(0.1, 0, 1), 0.4, 5e-4, 3e-4),
)
GYROS = tuple(
    oracle.Gyro(
        f"g{i}", np.array([0.2 * x, 0.2 * y, 0.03]), unit(0.8 * x, 0.8 * y, 0.6),
        np.array([-y, x, 0.0]), 0.3, np.array([1.5e-3, 4e-3, 3e-3]), 0.5, 1.2e-3, 0.7e-3, 150.0, a,
    )
    for i, (x, y, a) in enumerate([(1.0, 0.0, 0.0), (0.0, 1.0, 0.5), (-1.0, 0.0, -0.3)])
)  # fmt: skip
SLIDES = (Slide("s", 0.1, np.array([0.05, 0.2, -0.1]), unit(1, 0.2, 0.3)),)
MOVE = (Ramp(10.0, np.array([0.04])), Ramp(35.0, np.array([-0.03])))


def torques(wheels):
    """Torques that speed each wheel up and down again, up to 10 mN m."""
    swings = [np.sin(2 * np.pi * T / period) for period in (20.0, 13.0, 31.0)]
    return 0.01 * np.column_stack(swings[: len(wheels)])


def angles(gyros):
    """Gimbals go to and fro by 1.2 rad, from rest, the rates up to 0.5 rad/s."""
    ways = [1 - np.cos(2 * np.pi * T / period) for period in (17.0, 23.0, 29.0)]
    return 0.6 * np.column_stack(ways[: len(gyros)]) + [g.angle for g in gyros]


def driven(wheels=(), gyros=(), slides=(), gravity=9.81):
    given = oracle.Driven(platform(gravity, slides), wheels, gyros, DT)
    return replace(
        given,
        torques=torques(wheels) if wheels else None,
        angles=angles(gyros) if gyros else None,
        displacements=command(given.platform, MOVE, T) if slides else None,
    )


def our_wheels(wheels):
    return tuple(ReactionWheel(w.name, w.axis, w.axial, 1e3, 1.0) for w in wheels)


def our_gyros(gyros):
    """A gyro's numbers from those of its bodies."""
    return tuple(
        ControlMomentGyro(
            g.name, g.gimbal_axis, g.spin_axis, g.axial * g.speed, 1.0,
            gimbal_inertia=g.gimbal_inertia[2] + g.across,
            asymmetry=g.gimbal_inertia[0] + g.axial - g.gimbal_inertia[1] - g.across,
        )
        for g in gyros
    )  # fmt: skip


def our_masses(slides):
    return tuple(
        SlidingMass(s.name, s.mass, s.home, s.axis, (-0.1, 0.1), 0.0, 0.0, 0.0, 0.01)
        for s in slides
    )


def momentum(given, shown, cmgs):
    """Stored in wheels and rotors, N m s; rotors at the speed that they really have."""
    h = wheel_momentum(our_wheels(given.wheels), shown.wheel_speeds)
    if cmgs:
        speed = shown.rotor_speeds / [g.speed for g in given.gyros]
        each = [c.momentum for c in cmgs] * speed
        h = h + np.einsum("nk,nkj->nj", each, spin_axes(cmgs, shown.angles))
    return h


def reported(given, shown, cmgs, h):
    """The known inputs of the propagator, and what their coordinates do."""
    maps = mass_maps(our_masses(given.platform.slides))
    coordinates = shown.displacement
    if cmgs:
        coordinates = np.hstack([coordinates, gimbal_coordinates(cmgs, shown.angles)])
        maps = MassMaps(*map(np.vstack, zip(maps, gimbal_maps(cmgs), strict=True)))
    return maps, np.hstack([h, np.zeros((len(h), 4)), coordinates])


def miss(given, shown, cmgs, h=None):
    """How far our attitude goes from MuJoCo's (rad), given what the devices did."""
    body = given.platform
    h = momentum(given, shown, cmgs) if h is None else h
    maps, known = reported(given, shown, cmgs, h)
    J = body.inertia_P + unpack_symmetric(inertia_shift(maps, known[0, KNOWN_D:]))
    y = np.concatenate([body.q, J @ body.rate + known[0, :3]])
    rigid = body_of(body.mass, body.gravity, pack_symmetric(body.inertia_P), body.mass * body.com)
    ours = run(rigid, stacked(maps), y, shown.t, known).y[:, :4]
    return angle_between(ours, shown.q).max()


CASES = {
    "wheels": {"wheels": WHEELS},
    "gyros": {"gyros": GYROS},
    "gyros, no gravity": {"gyros": GYROS, "gravity": 0.0},
    "both and a mass": {"wheels": WHEELS[:2], "gyros": GYROS[:2], "slides": SLIDES},
}
_runs = {}


def case(name):
    """What was given, MuJoCo's run of it, and our gyros."""
    if name not in _runs:
        given = driven(**CASES[name])
        _runs[name] = given, oracle.simulate(given, DURATION)
    given, shown = _runs[name]
    return given, shown, our_gyros(given.gyros)


@pytest.mark.parametrize("name", CASES)
def test_attitude_agrees_over_a_minute(name):
    """1e-6 rad, on the way through half a turn and more."""
    given, shown, cmgs = case(name)
    assert miss(given, shown, cmgs) < AGREE
    assert angle_between(shown.q, shown.q[:1]).max() > 1.5


@pytest.mark.parametrize("name", [name for name in CASES if "wheels" not in name])
@pytest.mark.parametrize("effect", ["asymmetry", "gimbal_inertia"])
def test_it_would_not_without_the_gimbals_own_inertia(name, effect):
    given, shown, cmgs = case(name)
    less = tuple(replace(c, **{effect: 0.0}) for c in cmgs)
    assert miss(given, shown, less, momentum(given, shown, cmgs)) > 1e4 * AGREE


@pytest.mark.parametrize("name", ["wheels", "gyros"])
def test_it_would_not_without_stored_momentum(name):
    given, shown, cmgs = case(name)
    assert miss(given, shown, cmgs, np.zeros((len(shown.t), 3))) > 0.5


def test_speeds_are_those_against_the_platform():
    """In the laboratory the rotors turn with the platform too: 5e-4 of 0.5 kg m^2, 0.3 rad/s."""
    given, shown, cmgs = case("wheels")
    too_much = shown.rate @ np.array([w.axis for w in WHEELS]).T
    h = wheel_momentum(our_wheels(WHEELS), shown.wheel_speeds + too_much)
    assert miss(given, shown, cmgs, h) > 100 * AGREE


def recorded(given, shown):
    """What tachometers and encoders put down, and the testbed that they belong to."""
    body = given.platform
    values = np.hstack([shown.wheel_speeds, shown.angles])
    testbed = Testbed(
        "oracle", MassProperties(body.mass, body.com, body.inertia_P), 0.1, np.full(3, 1e-4),
        np.array([0.0, 0.0, 1.0]), 1.5, body.gravity,
        wheels=our_wheels(given.wheels), cmgs=our_gyros(given.gyros),
    )  # fmt: skip
    return Recording(device_names=testbed.device_names, devices=Samples(shown.t, values)), testbed


def slip(shown):
    """What of the rotors' momentum comes and goes, as servos give way, N m s, at most."""
    return float(np.abs(shown.rotor_speeds - 150.0).max() * 1.2e-3 * shown.angles.shape[1])


def test_stored_momentum_of_a_record_agrees():
    """With the rotors' speed as it should be: their servos hold it to 1e-5, 3e-6 N m s in all."""
    given, shown, cmgs = case("both and a mass")
    recording, testbed = recorded(given, shown)
    h = stored_momentum(recording, with_light_gimbals(testbed))
    assert slip(shown) < 3e-6
    np.testing.assert_allclose(h.values, momentum(given, shown, cmgs), atol=slip(shown))
    assert miss(given, shown, cmgs, h.values) < DURATION * slip(shown) / INERTIA[0, 0]


def test_total_momentum_from_a_record_is_kept_without_gravity():
    """R (J(x) w + h): recorded angles, their differences for gimbal rates, and the gyro's rates.

    The differences err by a sixth of dt^2 times the third slope, 0.3 rad/s^3 once the gimbals have
    settled: 1e-7 rad/s, of 4e-3 kg m^2.
    """
    given, shown, cmgs = case("gyros, no gravity")
    stored = stored_momentum(*recorded(given, shown)).values
    s, s0 = spin_axes(cmgs, shown.angles), spin_axes(cmgs, np.zeros(3))
    H = shown.rate @ INERTIA + stored
    for i, c in enumerate(cmgs):
        turned = np.einsum("ni,nj->nij", s[:, i], s[:, i]) - np.outer(s0[i], s0[i])
        H += c.asymmetry * np.einsum("nij,nj->ni", turned, shown.rate)
    H_N = np.einsum("nij,nj->ni", to_matrix(shown.q), H)[300:-1]
    assert np.ptp(H_N, axis=0).max() < 2 * slip(shown) + 1e-7
    assert np.abs(stored).max() > 0.1
