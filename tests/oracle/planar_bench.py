"""A platform on a ball joint that a sled carries over a tilted table, by MuJoCo: the truth.

The table is level in its own axes, and gravity leans. Friction is a force on the sled, evaluated at
every stage of MuJoCo's integrator: minus a coefficient, which changes over the table, times the
velocity. Nothing here shares code with ``equipoise.dynamics``.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

import mujoco
import numpy as np

from equipoise.model.recording import Recording, Samples
from tests.oracle import mujoco_bench as oracle

Array = oracle.Array
Coefficient = Callable[[float, float], float]  # of x and y, m: N s/m


@dataclass(frozen=True, eq=False)
class Floor:
    """The sled and the table under it."""

    sled: float  # kg
    slope: Array  # (2,) rad, downhill
    friction: Coefficient
    position: Array  # (2,) m, at the start
    velocity: Array  # (2,) m/s


@dataclass(frozen=True, slots=True, eq=False)
class PlanarRun:
    """What really happened."""

    run: oracle.OracleRun
    position: Array  # (n, 2) m, of P
    velocity: Array  # (n, 2) m/s


def model_text(platform: oracle.Platform, floor: Floor, dt: float, locked: bool) -> str:
    """Return the MuJoCo model of platform and sled."""
    text = oracle.model_text(platform, dt, locked)
    g, (x, y) = platform.gravity, floor.slope
    leaning = np.array([g * x, g * y, -g * np.sqrt(1 - x * x - y * y)])
    small = " ".join(["1"] * 3)
    sled = (
        '<body name="sled"><joint name="x" type="slide" axis="1 0 0"/>'
        '<joint name="y" type="slide" axis="0 1 0"/>'
        f'<inertial pos="0 0 0" mass="{floor.sled:.17g}" diaginertia="{small}"/>'
    )
    written = " ".join(f"{v:.17g}" for v in leaning)
    text = text.replace(f'gravity="0 0 {-g:.17g}"', f'gravity="{written}"')
    text = text.replace('<body name="platform">', sled + '<body name="platform">')
    return text.replace("</body></worldbody>", "</body></body></worldbody>")


def simulate(
    platform: oracle.Platform,
    floor: Floor,
    duration: float,
    schedule: tuple[oracle.Ramp, ...] = (),
    dt: float = 2e-3,
) -> PlanarRun:
    """Run it for so many seconds; masses are welded at home without a schedule."""
    locked, t = not schedule, oracle.middles(duration, dt)
    model = mujoco.MjModel.from_xml_string(model_text(platform, floor, dt, locked))
    data = mujoco.MjData(model)
    data.qpos[:2], data.qvel[:2] = floor.position, floor.velocity
    data.qpos[2:6], data.qvel[2:5] = platform.q, platform.rate
    if not locked:
        down = oracle.matrix(platform.q).T @ model.opt.gravity
        data.qpos[6:] = platform.slide_axes @ down / platform.servos**2
    wanted = None if locked else oracle.command(platform, schedule, t)
    rows_q, rows_v = np.empty((len(t) + 1, model.nq)), np.empty((len(t) + 1, model.nv))

    def rub(_: mujoco.MjModel, now: mujoco.MjData) -> None:
        c = floor.friction(float(now.qpos[0]), float(now.qpos[1]))
        now.qfrc_passive[:2] -= c * now.qvel[:2]

    mujoco.set_mjcb_passive(rub)
    try:
        for k in range(len(t)):
            rows_q[k], rows_v[k] = data.qpos, data.qvel
            if wanted is not None:
                data.ctrl[: wanted.shape[1]] = wanted[k]
            mujoco.mj_step(model, data)
    finally:
        mujoco.set_mjcb_passive(None)
    rows_q[-1], rows_v[-1] = data.qpos, data.qvel
    at, k = np.arange(len(t) + 1) * dt, len(platform.slides)
    still = np.zeros((len(at), k))
    d, speed = (still, still) if locked else (rows_q[:, 6:], rows_v[:, 5:])
    whole = oracle.OracleRun(
        platform, at, rows_q[:, 2:6], rows_v[:, 2:5], d, speed, platform.com_at(d)
    )
    return PlanarRun(whole, rows_q[:, :2], rows_v[:, :2])


def planar_log(
    run: PlanarRun,
    rng: np.random.Generator,
    capture: tuple[float, float, float] = (50.0, float(np.deg2rad(0.05)), 3e-4),
    gyro: tuple[float, float] = (50.0, float(np.deg2rad(0.02))),
    bias: Array | None = None,
) -> Recording:
    """Return what motion capture (Hz, rad, m) and a gyro (Hz, rad/s) record of it."""
    rate, turn, place = capture
    log = oracle.sensor_log(run.run, rng, rate, turn, gyro[0], gyro[1], bias)
    rows = oracle.every(run.run, rate)
    places = run.position[rows] + rng.normal(0.0, place, run.position[rows].shape)
    masses = log.masses if run.run.platform.slides else None
    return replace(log, position=Samples(run.run.t[rows].copy(), places), masses=masses)
