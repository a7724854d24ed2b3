"""The simulated bench's stop beside MuJoCo's: a disc that meets a plane when it tilts far enough.

The disc's lowest point is r sin(tilt) below its middle, whatever the heading, so a plane at the
limit's depth is a level ring. MuJoCo's contact is a damped spring: with a damping of ten times the
critical one, solved to the last digit, it gives nothing back, and yields by some hundredths of a
degree.
"""

import mujoco
import numpy as np
import pytest

from equipoise.dynamics.propagation import body_of
from equipoise.maths.attitude import difference, tilt
from equipoise.maths.linalg import pack_symmetric
from equipoise.model.mass_properties import parallel_axis
from equipoise.simulation.motion import run
from equipoise.simulation.stop import stop_at

MASS, GRAVITY, RADIUS, THIN = 14.0, 9.81, 0.5, 1e-5
INERTIA = np.array([[0.4, 0.005, -0.006], [0.005, 0.38, 0.005], [-0.006, 0.005, 0.5]])
LIMIT, STEP, PERIOD = np.radians(20.0), 1e-3, 0.1  # rad, s, s
UP, LEVEL = np.array([0.0, 0.0, 1.0]), np.array([1.0, 0.0, 0.0, 0.0])
YIELDS = np.radians(0.12)  # that MuJoCo's contact does in the fastest case


def texts(values):
    return " ".join(f"{value:.12g}" for value in values)


def by_mujoco(com, rate, seconds):
    """Attitudes (n, 4), one in PERIOD."""
    six = pack_symmetric(INERTIA - parallel_axis(MASS, com))
    depth = RADIUS * np.sin(LIMIT) + THIN * np.cos(LIMIT)
    model = mujoco.MjModel.from_xml_string(f"""
        <mujoco><option timestep="{STEP}" gravity="0 0 {-GRAVITY}" tolerance="1e-12"/><worldbody>
          <geom type="plane" pos="0 0 {-depth}" size="5 5 0.1" condim="1"/>
          <body><joint type="ball"/>
            <inertial pos="{texts(com)}" mass="{MASS}" fullinertia="{texts(six)}"/>
            <geom type="cylinder" size="{RADIUS} {THIN}" mass="0" condim="1"
                  solref="{4 * STEP} 10" solimp="0.99 0.999 0.0001"/>
          </body></worldbody></mujoco>""")
    data = mujoco.MjData(model)
    data.qpos[:], data.qvel[:] = LEVEL, rate
    found = []
    for k in range(round(seconds / STEP) + 1):
        if k % round(PERIOD / STEP) == 0:
            found.append(data.qpos.copy())
        mujoco.mj_step(model, data)
    return np.array(found)


@pytest.mark.parametrize(
    ("com", "rate"),
    [
        ((60e-6, 20e-6, -100e-6), (0.05, 0.02, 0.1)),  # swings to it
        ((20e-6, 0.0, 150e-6), (0.0, 0.02, 0.2)),  # topples, and slides on it
        ((200e-6, -10e-6, -300e-6), (0.0, 0.3, 0.4)),  # strikes it fast
    ],
)
def test_a_platform_meets_its_stop_as_a_disc_meets_a_plane(com, rate):
    com, rate = np.array(com), np.array(rate)
    theirs = by_mujoco(com, rate, 30.0)
    t = PERIOD * np.arange(len(theirs))
    body = body_of(MASS, GRAVITY, pack_symmetric(INERTIA), MASS * com)
    start, known = np.append(LEVEL, INERTIA @ rate), np.zeros((len(t), 6))
    ours = run(body, np.zeros((0, 18)), start, t, known, stop_at(UP, LIMIT))
    assert ours.touch[:, 2:].any(axis=1).sum() > 100
    assert tilt(theirs, UP).max() < LIMIT + YIELDS
    assert np.abs(difference(ours.y[:, :4], theirs)).max() < 1.2 * YIELDS
