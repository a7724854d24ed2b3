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


def specific_force(
    run: oracle.OracleRun, place: Array, rows: slice, schedule: tuple[oracle.Ramp, ...] = ()
) -> Array:
    """Return what an accelerometer at a place (m) gives in rows of a run, m/s^2, (n, 3).

    With a schedule the masses move as in the run; without, they are welded at home.
    """
    platform, locked = run.platform, not schedule
    text = oracle.model_text(platform, float(run.t[1] - run.t[0]), locked)
    model = mujoco.MjModel.from_xml_string(with_accelerometer(text, place))
    model.dof_damping[:3] = platform.viscous
    data, found, free = mujoco.MjData(model), [], 0 if locked else len(platform.slides)
    wanted = oracle.command(platform, schedule, run.t[rows])[:, :free]
    at = np.hstack([run.q[rows], run.displacement[rows, :free]])
    moving = np.hstack([run.rate[rows], run.velocity[rows, :free]])
    for position, velocity, control in zip(at, moving, wanted, strict=True):
        data.qpos[:], data.qvel[:], data.ctrl[:free] = position, velocity, control
        mujoco.mj_forward(model, data)
        found.append(data.sensordata.copy())
    return np.array(found)


def accelerometer(
    run: oracle.OracleRun, rate: float, place: Array, schedule: tuple[oracle.Ramp, ...] = ()
) -> Samples:
    """Return the rows of an accelerometer without noise, m/s^2."""
    rows = oracle.every(run, rate)
    return Samples(run.t[rows].copy(), specific_force(run, place, rows, schedule))


def vector(run: oracle.OracleRun, rate: float, vector_N: Array) -> Samples:
    """Return the rows of a sensor of a vector of the laboratory, in the vector's unit."""
    rows = oracle.every(run, rate)
    given = np.array([oracle.matrix(q).T @ vector_N for q in run.q[rows]])
    return Samples(run.t[rows].copy(), given)


def noisy(rows: Samples, rng: np.random.Generator, noise: float, bias: Array) -> Samples:
    """Return rows with a bias and noise, one sd per axis."""
    return Samples(rows.t, rows.values + bias + rng.normal(0.0, noise, rows.values.shape))
