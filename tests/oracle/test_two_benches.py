"""The simulated bench against MuJoCo: the same contact, slip and camera errors."""

from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip("mujoco", reason="MuJoCo is a development dependency")

from equipoise.model import defects as ours
from equipoise.model.mass_properties import MassProperties
from equipoise.model.testbed import AttitudeSensor, Gyro, Testbed, Truth
from equipoise.simulation.bench import SimulatedBench
from tests.oracle import cases, defective_run, sensors
from tests.oracle import mujoco_bench as oracle
from tests.oracle.defects import ComStep, Contact, Defects, Harmonic

SECONDS = 40.0
SHORT = 2e-3  # s: what MuJoCo needs for what takes no time here
IMPULSE, SHIFT = np.array([8e-4, -1.5e-3, 4e-4]), np.array([2e-6, -3e-6, 1e-6])
PLUMB = np.array([4e-3, -2e-3])
COSINE, SINE = np.array([1e-3, 0.0, 2e-3]), np.array([0.0, -2e-3, 1e-3])
WRONG = Defects(
    contacts=(Contact(10.0 - SHORT / 2, SHORT, IMPULSE),),
    com_steps=(ComStep(20.0 - 0.015 - 2 / defective_run.TIGHT, 0.03, SHIFT),),
    plumb=PLUMB,
    heading=(Harmonic(2, COSINE, SINE),),
    camera_delay=0.04,
)


def fourteen():
    """Return Case S's body without its masses."""
    return replace(cases.case_s(1).case.platform, slides=())


def simulated(platform, contacts=(), com_steps=()):
    """Return what a bench made of the same platform records, without noise."""
    body = MassProperties(platform.mass, platform.com, platform.inertia_P)
    none = np.zeros(3)
    truth = Truth(
        platform.com, none, none, platform.inertia_P, 0.0, angles(platform.q), 0.0, platform.rate,
        0.0, {}, 0.0, 30.0, none, contacts=contacts, com_steps=com_steps,
        camera=ours.CameraErrors(np.array([*PLUMB, 0.0]), COSINE, SINE),
    )  # fmt: skip
    up = np.array([0.0, 0.0, 1.0])
    camera, gyro = AttitudeSensor(5.0, 0.0, delay=0.04), Gyro(50.0, 0.0, 0.0)
    bed = Testbed("twin", body, 0.1, none, up, 1.0, platform.gravity, (), camera, gyro)
    return SimulatedBench(replace(bed, truth=truth), 0).read(SECONDS)


def angles(q):
    """Return roll, pitch and yaw from the matrix, by the textbook."""
    R = oracle.matrix(q)
    return np.array(
        [np.arctan2(R[2, 1], R[2, 2]), -np.arcsin(R[2, 0]), np.arctan2(R[1, 0], R[0, 0])]
    )


def test_both_benches_make_the_same_record():
    """Within 2e-6 rad, of a contact that turns the platform by 0.1 rad and a slip."""
    platform = fourteen()
    run = defective_run.simulate(platform, (), WRONG, SECONDS)
    rows = sensors.camera(run, np.random.default_rng(0), 5.0, 0.0, WRONG).attitude
    contact, slip = ours.Contact(10.0, IMPULSE), ours.ComStep(20.0, SHIFT)
    twin = simulated(platform, (contact,), (slip,))
    first = int(np.searchsorted(twin.attitude.t, rows.t[0] - 1e-9))
    off = oracle.angle_between(twin.attitude.values[first:], rows.values)
    assert off.max() < 2e-6
    w = sensors.gyro(run, np.random.default_rng(0), 50.0, 0.0, Defects()).values
    between = np.abs(twin.rate.t - 20.0) > 0.1
    between &= np.abs(twin.rate.t - 10.0) > 0.01
    np.testing.assert_allclose(twin.rate.values[between], w[between], atol=2e-6)
    plain = simulated(platform).attitude.values[first:]
    assert oracle.angle_between(plain, rows.values).max() > 0.05
