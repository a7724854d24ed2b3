"""Gravity's torque and the energy of a motion: by hand, by laws, and how well they are known."""

import mujoco
import numpy as np
import pytest

from equipoise.assessment.metrics.gravity_torque import gravity_torque
from equipoise.assessment.metrics.motion_energy import motion_energy
from equipoise.maths.attitude import exponential, normalise
from equipoise.maths.linalg import unpack_symmetric
from tests.support.builders import COM, GRAVITY, INERTIA, MASS, platform

LEVEL = np.array([[1.0, 0.0, 0.0, 0.0]])
NOT_KNOWN = np.zeros((9, 9))


def test_level_with_the_mass_to_the_side():
    """At r = (1, 2, -3) mm, level: tau = m r x (0, 0, -g) = m g (-y, x, 0)."""
    com = np.array([[1e-3, 2e-3, -3e-3]])
    torque, sd = gravity_torque(platform(), LEVEL, com, np.diag([4e-12, 9e-12, 1e-12]))
    weight = 14.24 * 9.81
    assert torque[0] == pytest.approx([-weight * 2e-3, weight * 1e-3, 0.0])
    assert sd[0] == pytest.approx([weight * 3e-6, weight * 2e-6, 0.0])


def test_leaning_by_a_right_angle():
    """Rolled by 90 deg, gravity is along -y of the body: tau = m g r x (0, -1, 0)."""
    q = exponential(np.array([[np.pi / 2, 0.0, 0.0]]))
    torque, _ = gravity_torque(platform(), q, np.array([[1e-3, 2e-3, -3e-3]]), np.zeros((3, 3)))
    assert torque[0] == pytest.approx(14.24 * 9.81 * np.array([-3e-3, 0.0, -1e-3]))


def test_torque_is_that_of_mujoco():
    """On a body that hangs on a ball joint; its qfrc_bias at rest is minus the torque."""
    rng = np.random.default_rng(3)
    q, com = normalise(rng.standard_normal(4)), np.array([2e-3, -1e-3, -4e-3])
    at = " ".join(f"{x:.9g}" for x in com)
    model = mujoco.MjModel.from_xml_string(f"""
        <mujoco><option gravity="0 0 -{GRAVITY}"/><worldbody><body><joint type="ball"/>
        <inertial pos="{at}" mass="{MASS}" diaginertia="0.4 0.5 0.8"/></body></worldbody></mujoco>
    """)
    data = mujoco.MjData(model)
    data.qpos[:] = q
    mujoco.mj_forward(model, data)
    torque, _ = gravity_torque(platform(), q[None], com[None], np.zeros((3, 3)))
    assert torque[0] == pytest.approx(-data.qfrc_bias, rel=1e-6)


def drawn(seed=5, n=20_000):
    """Return a covariance of com and J, an attitude, a rate with its sd, and draws of all."""
    rng = np.random.default_rng(seed)
    root = rng.standard_normal((9, 9)) * np.array([2e-6] * 3 + [2e-3] * 6)[:, None]
    mean = np.concatenate([1e3 * COM, INERTIA])
    rate, rate_sd = np.array([0.2, -0.1, 0.3]), np.array([1e-3, 2e-3, 1e-3])
    draws = mean + rng.standard_normal((n, 9)) @ root.T
    rates = rate + rate_sd * rng.standard_normal((n, 3))
    return root @ root.T, rate, rate_sd, draws, rates


def test_stated_sds_are_those_of_drawn_platforms():
    """20 000 draws: their spread is the sd to 2 % (0.5 % is one sd of a spread)."""
    covariance, rate, rate_sd, draws, rates = drawn()
    q, bed = exponential(np.array([[0.3, -0.2, 0.5]])), platform()
    every = np.repeat(q, len(draws), axis=0)
    mean = np.concatenate([1e3 * COM, INERTIA])
    torque_sd = gravity_torque(bed, q, mean[None, :3], covariance[:3, :3])[1]
    torques = gravity_torque(bed, every, draws[:, :3], np.zeros((3, 3)))[0]
    assert torques.std(axis=0) == pytest.approx(torque_sd[0], rel=0.02)
    motion = (q, rate[None], mean[None, :3])
    known = (unpack_symmetric(INERTIA), covariance, rate_sd[None])
    energy_sd = motion_energy(bed, motion, *known)[1]
    none = np.zeros((1, 3))
    energies = [
        motion_energy(bed, (q, w[None], d[None, :3]), unpack_symmetric(d[3:]), NOT_KNOWN, none)[0]
        for d, w in zip(draws[:4000], rates[:4000], strict=True)
    ]
    assert np.vstack(energies).std(axis=0) == pytest.approx(energy_sd[0], rel=0.05)


def test_energy_of_a_spinning_platform_by_hand():
    """1/2 . 0.8782 . 0.5^2 about z, and m g times a height of 1 mm."""
    motion = (LEVEL, np.array([[0.0, 0.0, 0.5]]), np.array([[0.0, 0.0, 1e-3]]))
    energy, sd = motion_energy(
        platform(), motion, np.diag([0.3, 0.5, 0.8782]), NOT_KNOWN, np.zeros((1, 3))
    )
    kinetic, potential = 0.5 * 0.8782 * 0.25, 14.24 * 9.81 * 1e-3
    assert energy[0] == pytest.approx([kinetic, potential, kinetic + potential])
    assert not sd.any()


def test_energy_of_free_motion_is_kept():
    """MuJoCo swings a platform 3 mm off for 20 s: the sum stays to 1e-5 of what goes to and fro."""
    model = mujoco.MjModel.from_xml_string(f"""
        <mujoco><option gravity="0 0 -{GRAVITY}" timestep="0.0005" integrator="RK4"/>
        <worldbody><body><joint type="ball" damping="0"/>
        <inertial pos="0.001 0 -0.003" mass="{MASS}" diaginertia="0.4 0.5 0.8"/></body></worldbody>
        </mujoco>
    """)
    data = mujoco.MjData(model)
    data.qpos[:] = exponential(np.array([0.2, 0.1, 0.0]))
    data.qvel[:] = [0.01, -0.02, 0.05]
    q, w = [], []
    for _ in range(400):
        mujoco.mj_step(model, data, 100)
        q.append(data.qpos.copy())
        w.append(data.qvel.copy())
    com = np.array([1e-3, 0.0, -3e-3])
    inertia_P = np.diag([0.4, 0.5, 0.8]) + MASS * (com @ com * np.eye(3) - np.outer(com, com))
    motion = (np.array(q), np.array(w), np.tile(com, (400, 1)))
    energy, _ = motion_energy(platform(), motion, inertia_P, NOT_KNOWN, np.zeros((400, 3)))
    kinetic, _, total = energy.T
    assert np.ptp(total) < 1e-5 * np.ptp(kinetic)
