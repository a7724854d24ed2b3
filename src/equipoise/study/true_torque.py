"""The true torque by cause on a simulated platform, to judge what an estimator says of it.

    J w|_(t+1) - J w|_t + int w x J w dt = sum of the impulses of all causes

with J of the masses as they stand at first. Every cause but the moves is integrated from its own
formula along the simulated motion; moves are what is left of the balance. Neither the regressor nor
the propagator's sensitivities have a part in it.
"""

import numpy as np
from scipy.interpolate import CubicSpline

from equipoise.actuators.sliding_masses import inertia_shift, mass_maps
from equipoise.dynamics.regressor import CONSTANT, DRIFT, QUADRATIC, SWIRL, THERMAL, VISCOUS
from equipoise.maths.attitude import to_matrix
from equipoise.maths.linalg import unpack_symmetric
from equipoise.maths.straight_lines import read_at
from equipoise.model import torque_by_cause as cause
from equipoise.model.arrays import Floats, Matrix3, Series1, Series3, Vector3
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed
from equipoise.simulation.bench import SimulatedBench
from equipoise.simulation.motion import Path
from equipoise.simulation.noise_torque import torque_at
from equipoise.simulation.surroundings.lamp import warmth_since_start


class TrueTorqueBench(SimulatedBench):
    """A simulated bench that keeps its motion, and the noise torque, at every node."""

    def __init__(self, testbed: Testbed, seed: int) -> None:
        super().__init__(testbed, seed)
        self._standing = self.displacements
        self._t: list[Series1] = []
        self._q: list[Floats] = []
        self._w: list[Series3] = []
        self._air: list[Series3] = []

    def _recording(self, t: Series1, path: Path, after: float, since: float) -> Recording:
        fresh = t > self._t[-1][-1] if self._t else np.ones(len(t), dtype=bool)
        fresh &= t >= 0.0
        if np.any(fresh):
            self._t.append(t[fresh])
            self._q.append(path.y[: len(t)][fresh, :4])
            self._w.append(path.rate[: len(t)][fresh])
            self._air.append(torque_at(self._noise, t[fresh]))
        return super()._recording(t, path, after, since)

    def torque_by_cause(self, edges: Series1) -> Floats:
        """Return the mean torque of each cause between times (s), (n, causes, 3) N m, body axes.

        Of a platform without devices, that meets neither its stop nor a hand.
        """
        t, q, w = np.concatenate(self._t), np.vstack(self._q), np.vstack(self._w)
        torque = self._torques(t, q, w, np.vstack(self._air))
        impulse = np.stack([integrals(t, each, edges) for each in torque], axis=1)
        moves = self._balance(t, w, edges) - impulse.sum(axis=1)
        impulse[:, cause.MOVES] = moves
        return impulse / np.diff(edges)[:, None, None]

    def _balance(self, t: Series1, w: Series3, edges: Series1) -> Series3:
        """Return the change of J w over each interval, with int w x J w, N m s."""
        inertia = self._inertia()
        change = np.diff(read_at(edges, t, w @ inertia), axis=0)
        return change + integrals(t, np.cross(w, w @ inertia), edges)

    def _inertia(self) -> Matrix3:
        """Return the inertia about P with the masses as they stood at first, kg m^2."""
        shift = inertia_shift(mass_maps(self.platform.masses), self._standing)
        return self.platform.body.inertia_P + unpack_symmetric(shift)

    def _moment(self) -> Vector3:
        """Return the first moment at first, kg m."""
        maps = mass_maps(self.platform.masses)
        return self.platform.body.first_moment + self._standing @ maps.first_moment

    def _torques(self, t: Series1, q: Floats, w: Series3, noise: Series3) -> Floats:
        """Return the torque of every cause but the moves at times t (s), (causes, n, 3)."""
        c, mass, g0 = self.platform.torque, self.platform.body.mass, self.testbed.gravity
        n = -to_matrix(q)[:, 2, :]  # down
        g, found = g0 * n, np.zeros((len(cause.CAUSES), len(t), 3))
        warmth = warmth_since_start(self._lamp, t)
        found[cause.GRAVITY] = np.cross(self._moment(), g)
        found[cause.SAG] = mass * np.cross(n @ self.sag, g)
        found[cause.DRIFT] = mass * np.cross(np.outer(t, c[DRIFT : DRIFT + 3]), g)
        found[cause.WARMTH] = mass * np.cross(warmth * c[THERMAL : THERMAL + 3], g)
        speed = np.linalg.norm(w, axis=1, keepdims=True)
        damping = c[VISCOUS : VISCOUS + 3] * w + c[QUADRATIC] * speed * w
        found[cause.AIR] = c[CONSTANT : CONSTANT + 3] - c[SWIRL] * n - damping + noise
        return found


def integrals(t: Series1, values: Series3, edges: Series1) -> Series3:
    """Return the integrals of a smooth series between neighbouring edges (s)."""
    running = CubicSpline(t, values).antiderivative()(edges)
    return np.diff(np.asarray(running, dtype=np.float64), axis=0)
