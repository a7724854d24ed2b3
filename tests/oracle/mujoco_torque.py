"""The torque by cause on platforms made of MuJoCo bodies, from their own state. Development only.

    gravity  m r_0 x g_B               r_0: centre of mass as the record begins
    drift    m (r' t) x g_B            warmth alike
    air      the torque that is given
    total    change of K, with int w x K dt,     K = J w + h,  J: masses as the record begins
    moves    total less all others

J is the inertia that the bodies were made of, h what their rotors hold. Nothing here shares code
with ``equipoise.dynamics`` or ``equipoise.estimation``.
"""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from equipoise.model.mass_properties import parallel_axis
from equipoise.model.recording import Recording, join
from equipoise.model.testbed import Testbed
from equipoise.model.torque_by_cause import TOTAL
from tests.oracle.mujoco_bench import OracleRun, Platform, matrix
from tests.oracle.mujoco_experiment import BEAT, ExperimentBench, Surroundings, warmth
from tests.oracle.mujoco_live import STEP

Array = NDArray[np.float64]
EVERY = 5  # steps between rows of what is true; torques change at every fourth of these alone


def gusts(rng: np.random.Generator, t: Array, sd: float, lasts: float) -> Array:
    """Return an exponentially correlated torque about three axes at even times, N m, (n, 3)."""
    stay = np.exp(-(t[1] - t[0]) / lasts)
    fresh = sd * rng.normal(size=(len(t), 3))
    found = np.empty_like(fresh)
    found[0] = fresh[0]
    for k in range(1, len(t)):
        found[k] = stay * found[k - 1] + np.sqrt(1 - stay**2) * fresh[k]
    return found


def down(platform: Platform, q: Array) -> Array:
    """Return g_B at attitudes, m/s^2, (n, 3)."""
    return -platform.gravity * np.array([matrix(each)[2] for each in q])


def inertia_at(platform: Platform, displacement: Array) -> Array:
    """Return the inertia about P with the masses there, kg m^2."""
    moved = (
        parallel_axis(s.mass, s.home + d * s.axis) - parallel_axis(s.mass, s.home)
        for s, d in zip(platform.slides, displacement, strict=True)
    )
    return platform.inertia_P + sum(moved, np.zeros((3, 3)))


def read_at(t: Array, values: Array, edges: Array) -> Array:
    """Return a series at some times, straight between its rows."""
    return np.array([np.interp(edges, t, column) for column in values.T]).T


def impulses(t: Array, torque: Array, edges: Array) -> Array:
    """Return the integrals of a torque between neighbouring edges, N m s."""
    steps = 0.5 * (torque[1:] + torque[:-1]) * np.diff(t)[:, None]
    return np.diff(read_at(t, np.vstack([np.zeros((1, 3)), np.cumsum(steps, axis=0)]), edges),
                   axis=0)  # fmt: skip


def divided(
    t: Array, acting: Mapping[str, Array], w: Array, momentum: Array, edges: Array
) -> dict[str, Array]:
    """Return mean torques by cause between edges (s), with moves and their total, N m."""
    seconds = np.diff(edges)[:, None]
    found = {name: impulses(t, torque, edges) / seconds for name, torque in acting.items()}
    change = np.diff(read_at(t, momentum, edges), axis=0)
    total = (change + impulses(t, np.cross(w, momentum), edges)) / seconds
    return {**found, "moves": total - sum(found.values()), TOTAL: total}


def torque_of(run: OracleRun, air: Array, edges: Array) -> dict[str, Array]:
    """Return the torque by cause of a run under a torque of air in body axes, (steps, 3)."""
    platform, first = run.platform, run.displacement[0]
    gravity = np.cross(platform.mass * run.com[0], down(platform, run.q))
    acting = {"gravity": gravity, "air": np.vstack([air, air[-1:]])}
    return divided(run.t, acting, run.rate, run.rate @ inertia_at(platform, first), edges)


class WatchedBench(ExperimentBench):
    """An experiment in moving air; its recording and its truth are kept from when it begins."""

    def __init__(
        self, testbed: Testbed, platform: Platform, surroundings: Surroundings, seed: int
    ) -> None:
        self.observed: Recording | None = None
        self._air, self._beat = np.zeros(3), 0.0
        self._rows_kept = list[tuple[float, float, Array, Array, Array, Array, Array]]()
        super().__init__(testbed, platform, surroundings, seed)
        self._wind = np.random.default_rng([seed, 8])

    def begin(self) -> None:
        """Let the experiment begin; the times of the lamp count from now."""
        lit = tuple((self.time + on, self.time + off) for on, off in self._around.lamp)
        self._around = replace(self._around, lamp=lit)
        super().begin()

    def blow(self, sd: float, lasts: float) -> None:
        """Let air push from now on: its sd (N m) and how long it lasts (s)."""
        t = np.arange(round(3600.0 / (BEAT * STEP))) * BEAT * STEP
        self._gusts = iter(gusts(self._wind, t, sd, lasts))

    def read(self, duration: float) -> Recording:
        """Let time pass and return what was seen since the last read."""
        rows = super().read(duration)
        if self._began is not None:
            self.observed = rows if self.observed is None else join(self.observed, rows)
        return rows

    def _before_step(self) -> None:
        if self._steps % BEAT == 0:
            self._beat = self.time
            if self._began is not None:
                self._air = next(self._gusts)
        super()._before_step()

    def _from_jets(self) -> Array:
        return super()._from_jets() + self._air

    def _measurement(self) -> None:
        if self._began is not None and self._steps % EVERY == 0:
            spins = np.array([self._data.joint(w.name).qvel[0] for w in self.testbed.wheels])
            q, w = self._data.qpos[:4].copy(), self._data.qvel[:3].copy()
            at = self.time, self._beat, q, w, spins, self._reported.copy(), self._air.copy()
            self._rows_kept.append(at)
        super()._measurement()

    @property
    def kept_from(self) -> float:
        """The time (s) from which on the truth is kept."""
        return self._rows_kept[0][0]

    @property
    def kept_until(self) -> float:
        """The time (s) up to which the truth is kept."""
        return self._rows_kept[-1][0]

    def torque_by_cause(self, edges: Array) -> dict[str, Array]:
        """Return the torque by cause between times (s); the record begins with the first."""
        t, beat, q, w, spins, d, air = (np.array(each) for each in zip(*self._rows_kept,
                                                                      strict=True))  # fmt: skip
        k, platform = int(np.searchsorted(t, edges[0] - 1e-9)), self._platform
        lamp = self.testbed.lamp
        assert lamp is not None
        warm = warmth(beat, self._around.lamp, lamp.warms, lamp.time_constant)
        drifted, warmed = np.outer(beat, self._around.drift), np.outer(warm, self._around.thermal)
        first = platform.com_at(d[k]) + drifted[k] + warmed[k]
        g = down(platform, q)
        acting = {
            name: np.cross(platform.mass * place, g)
            for name, place in (("gravity", first), ("drift", drifted - drifted[k]),
                                ("warmth", warmed - warmed[k]))
        }  # fmt: skip
        wheels = self.testbed.wheels
        held = (spins * np.array([x.inertia for x in wheels])) @ np.array([x.axis for x in wheels])
        momentum = w @ inertia_at(platform, d[k]) + held
        return divided(t, {**acting, "air": air}, w, momentum, edges)
