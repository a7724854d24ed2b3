"""An ADCS experiment on a platform of MuJoCo bodies whose centre of mass drifts. Development only.

The experiment is its owner's: a quaternion PD controller without integral and without any knowledge
of gravity torque, which points the platform by its own sensors and its own wheels. It shares no
code with ``equipoise``. Meanwhile the bare body's centre of mass drifts evenly, and a lamp that
goes on and off warms it, which shifts it too.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from equipoise.model.recording import Recording, Samples
from equipoise.model.testbed import Testbed
from tests.oracle.mujoco_bench import Platform, angle_between, matrix, product, rotation, smooth
from tests.oracle.mujoco_live import STEP, MujocoBench

Array = NDArray[np.float64]
BEAT = 20  # steps, chosen: the controller runs at 25 Hz
STIFF, DAMPED = 1.0, 0.8  # rad/s, -, chosen: a pointing loop of a nanosatellite
OWN_NOISE = np.deg2rad(0.005), np.deg2rad(0.01)  # rad, rad/s: of the experiment's own sensors
AHEAD = 0.01  # s, over which the wanted rate is taken
LEAN, EACH, SLEW = np.deg2rad(8.0), 60.0, 20.0  # rad, s, s: it points elsewhere each minute


@dataclass(frozen=True, slots=True, eq=False)
class Surroundings:
    """What moves the centre of mass of the bare body."""

    drift: Array  # m/s
    thermal: Array  # m/K
    lamp: tuple[tuple[float, float], ...]  # s, on and off


def warmth(t: Array, on: tuple[tuple[float, float], ...], warms: float, lag: float) -> Array:
    """Return the warmth (K) at times after a lamp was on between pairs of times."""

    def risen(since: float) -> Array:
        return warms * -np.expm1(-np.maximum(t - since, 0.0) / lag)

    return sum((risen(a) - risen(b) for a, b in on), np.zeros_like(t))


def pointing(t: float) -> Array:
    """Return the attitude that the experiment wants at a time (s) since it began."""
    leg, within = divmod(t, EACH)

    def way(k: float) -> Array:
        heading = 2.4 * k  # rad, chosen: no two legs alike
        return LEAN * np.array([np.cos(heading), np.sin(heading), 0.0]) if k > 0 else np.zeros(3)

    share = float(smooth(np.array(min(within / SLEW, 1.0))))
    return rotation((1 - share) * way(leg) + share * way(leg + 1))


class ExperimentBench(MujocoBench):
    """A bench on which an experiment runs from ``begin`` on; what is true is kept each step."""

    def __init__(
        self, testbed: Testbed, platform: Platform, surroundings: Surroundings, seed: int
    ) -> None:
        self._around, self._began, self._away = surroundings, None, np.zeros(3)
        super().__init__(testbed, platform, seed)
        self._own = np.random.default_rng([seed, 7])
        self._bare = self._model.body_ipos[1].copy()
        self._share = platform.mass / self._model.body_mass[1]
        self._torque = np.zeros(3)
        self.t, self.error = list[float](), list[float]()  # s; rad, at each beat of the experiment
        self.q, self.coms, self.masses = list[Array](), list[Array](), list[Array]()

    def begin(self) -> None:
        """Let the experiment begin, from the attitude that the platform has."""
        self._began = self.time
        q = self._data.qpos[:4]
        away = np.sign(q[0]) * q[1:]
        sine = float(np.linalg.norm(away))
        self._away = 2.0 * np.arcsin(min(sine, 1.0)) * away / max(sine, 1e-12)

    def _wanted(self, t: float) -> Array:
        """Return the attitude that is wanted at a time (s) since it began, without a jump."""
        left = 1.0 - float(smooth(np.array(min(t / (2 * SLEW), 1.0))))
        return product(rotation(left * self._away), pointing(t))

    def end(self) -> None:
        """Let the wheels run free."""
        self._began = None
        self.drive({wheel.name: 0.0 for wheel in self.testbed.wheels})

    @property
    def moved(self) -> Array:
        """By how much drift and warmth have moved the total centre of mass, m."""
        lamp = self.testbed.lamp
        warm = 0.0
        if lamp is not None:
            t = np.array([self.time])
            warm = float(warmth(t, self._around.lamp, lamp.warms, lamp.time_constant)[0])
        return self._around.drift * self.time + self._around.thermal * warm

    @property
    def com(self) -> Array:
        """The total centre of mass, m, with the masses where their motors are."""
        return self._platform.com_at(self._reported) + self.moved

    def _before_step(self) -> None:
        if self._steps % BEAT:
            return
        self._model.body_ipos[1] = self._bare + self._share * self.moved
        if self._began is not None:
            self._control(self.time - self._began)
            self.masses.append(self._reported.copy())

    def _control(self, t: float) -> None:
        q, w = self._data.qpos[:4].copy(), self._data.qvel[:3].copy()
        wanted = self._wanted(t)
        self.t.append(self.time)
        self.q.append(q)
        self.coms.append(self.com)
        self.error.append(float(angle_between(q, wanted)))
        observed = product(q, rotation(OWN_NOISE[0] * self._own.normal(size=3)))
        rate = w + OWN_NOISE[1] * self._own.normal(size=3)
        turn = product(observed * np.array([1.0, -1.0, -1.0, -1.0]), wanted)
        e = 2.0 * np.sign(turn[0]) * turn[1:]
        ahead = product(wanted * np.array([1.0, -1.0, -1.0, -1.0]), self._wanted(t + AHEAD))
        turning = 2.0 * ahead[1:] / AHEAD  # rad/s, of the reference
        J = self._platform.inertia_P
        u = J @ (STIFF**2 * e + 2 * DAMPED * STIFF * (turning - rate))
        axes = np.array([wheel.axis for wheel in self.testbed.wheels])
        drive = -np.linalg.lstsq(axes.T, u, rcond=None)[0]
        for k, wheel in enumerate(self.testbed.wheels):
            most = wheel.max_torque
            spin = self._data.joint(wheel.name).qvel[0]
            full = abs(spin) >= wheel.max_speed and np.sign(drive[k]) == np.sign(spin)
            self._data.ctrl[k] = 0.0 if full else np.clip(drive[k], -most, most)

    def _recording(self) -> Recording:
        rows, on = super()._recording(), self._around.lamp
        if self.testbed.lamp is None or rows.rate is None:
            return rows
        t = rows.rate.t
        lit = sum(((t >= a) & (t < b) for a, b in on), np.zeros(len(t), bool))
        return replace(rows, lamp=Samples(t, lit.astype(float)[:, None]))


def torque_by_moves(bench: ExperimentBench, seconds: float = 1.0) -> Array:
    """Return the rms torque (N m) that moves added, second by second, from the bench's truth.

    What travelling masses give back, -dh/dt with the servos' smooth start, and the change of the
    gravity torque by masses since the second began.
    """
    t, d = np.array(bench.t), np.array(bench.masses)
    step, n = BEAT * STEP, round(seconds / (BEAT * STEP))
    kept = len(t) // n * n
    masses = bench.testbed.masses
    moment = np.array([m.mass * m.axis for m in masses])
    travel = np.array([m.mass * np.cross(m.home, m.axis) for m in masses])
    v = np.gradient(d[:kept], step, axis=0)
    reaction = -np.gradient(v, step, axis=0) @ travel
    since = (d[:kept].reshape(-1, n, d.shape[1]) - d[:kept:n][:, None]).reshape(kept, -1)
    down = np.array([matrix(q)[2] for q in bench.q[:kept]]) * -bench.testbed.gravity
    total = reaction + np.cross(since @ moment, down)
    return np.sqrt(np.mean(np.sum(total**2, axis=1).reshape(-1, n), axis=1))
