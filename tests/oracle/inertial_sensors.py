"""What an accelerometer, a sun sensor and a magnetometer give of an oracle run. Development only.

The accelerometer is MuJoCo's own, on a site of the platform: MuJoCo is set to each attitude and
rate of the run, and asked for the sensor there. The others are rotation matrices.
"""

import mujoco
import numpy as np

from equipoise.model.recording import Samples
from tests.oracle import mujoco_bench as oracle
from tests.oracle.defects import Array


def with_accelerometer(text: str, place: Array) -> str:
    """Return a model with a site and an accelerometer there (m, from P)."""
    site = f'<site name="load" pos="{" ".join(f"{x:.17g}" for x in place)}"/>'
    sensor = '<sensor><accelerometer site="load"/></sensor>'
    text = text.replace('<joint name="bearing"', f'{site}<joint name="bearing"')
    return text.replace("</mujoco>", f"{sensor}</mujoco>")


def specific_force(run: oracle.OracleRun, place: Array, rows: slice) -> Array:
    """Return what an accelerometer at a place (m) feels in rows of a run, m/s^2, (n, 3).

    The masses are welded at home: it is for runs in which they do not move.
    """
    text = oracle.model_text(run.platform, float(run.t[1] - run.t[0]), locked=True)
    model = mujoco.MjModel.from_xml_string(with_accelerometer(text, place))
    model.dof_damping[:3] = run.platform.viscous
    data, found = mujoco.MjData(model), []
    for q, w in zip(run.q[rows], run.rate[rows], strict=True):
        data.qpos[:], data.qvel[:] = q, w
        mujoco.mj_forward(model, data)
        found.append(data.sensordata.copy())
    return np.array(found)


def accelerometer(run: oracle.OracleRun, rate: float, place: Array) -> Samples:
    """Return the rows of an accelerometer without noise, m/s^2."""
    rows = oracle.every(run, rate)
    return Samples(run.t[rows].copy(), specific_force(run, place, rows))


def vector(run: oracle.OracleRun, rate: float, vector_N: Array) -> Samples:
    """Return the rows of a sensor of a vector of the laboratory, in the vector's unit."""
    rows = oracle.every(run, rate)
    given = np.array([oracle.matrix(q).T @ vector_N for q in run.q[rows]])
    return Samples(run.t[rows].copy(), given)


def noisy(rows: Samples, rng: np.random.Generator, noise: float, bias: Array) -> Samples:
    """Return rows with a bias and noise, one sd per axis."""
    return Samples(rows.t, rows.values + bias + rng.normal(0.0, noise, rows.values.shape))
