"""The simulated bench of a platform on a table; see ``model.bench.Bench``.

Camera, gyro, position and masses are those of ``simulation.bench``: noise, delays, averaging, stop
errors, lags. Nodes of the motion do not depend on how the bench is read. There is no stop, no edge
of the table, and no device beside the masses.
"""

import math
from collections.abc import Mapping

import numpy as np

from equipoise.actuators.sliding_masses import com_shift, inertia_shift, mass_maps
from equipoise.dynamics.planar.planar_motion import (
    P,
    PlanarMotion,
    Start,
    TableTop,
    first_state,
    run_planar,
)
from equipoise.dynamics.propagation import rigid_body, stacked
from equipoise.dynamics.rigid_body import KNOWN_D
from equipoise.dynamics.timeline import fill
from equipoise.maths.linalg import unpack_symmetric
from equipoise.maths.straight_lines import read_at
from equipoise.model.arrays import Floats, Series1
from equipoise.model.bench_requests import check_duration, check_speed
from equipoise.model.errors import InputError
from equipoise.model.mass_properties import MassProperties
from equipoise.model.recording import Recording, Samples
from equipoise.model.testbed import Testbed
from equipoise.simulation import actuator
from equipoise.simulation.camera_and_gyro import (
    camera_rows,
    gyro_rows,
    lead,
    outside,
    sampled_at,
    samples_between,
)
from equipoise.simulation.clock import multiples, samples, tick, tick_one
from equipoise.simulation.draw_truth import draw_truth
from equipoise.simulation.planar.true_table import true_table
from equipoise.simulation.sensor_errors import misfelt, misread, whole, whole_angles

LONGEST = 0.02  # s, chosen: of a step; classical Runge-Kutta then errs by rounding alone


class PlanarBench:
    """A bench made of equations; ``platform`` and ``floor`` are what it really is."""

    def __init__(
        self, testbed: Testbed, seed: int, standing: Mapping[str, float] | None = None
    ) -> None:
        if testbed.devices:
            found = f"{', '.join(testbed.device_names)} beside [table]"
            raise InputError(f"{testbed.source}: table", found, "no device beside sliding masses")
        streams = [np.random.default_rng(s) for s in np.random.SeedSequence(seed).spawn(5)]
        rng, self._stops_rng, self._camera_rng, self._gyro_rng, self._position_rng = streams
        self.testbed, self.seed, self.platform = testbed, seed, draw_truth(testbed, rng)
        self.floor = true_table(testbed)
        self._top: TableTop = self.floor.top
        masses = self.platform.masses
        self._body = rigid_body(self.platform.body, testbed.gravity, self.platform.torque)
        self._rails = mass_maps(masses)
        self._travel = actuator.left_at(masses, standing or {}, self._stops_rng)
        self._track = actuator.tracked(self._travel)
        self._lead = max(lead(testbed.attitude), lead(testbed.gyro), self._delay)
        self._time, self._read_until, self._node = 0.0, -1.0, 0.0
        around = np.array([0.0, LONGEST])
        begun = Start(
            self.platform.attitude, self.platform.rate, self.floor.position, self.floor.velocity
        )
        self._state = first_state(
            self._body, self._top, stacked(self._rails), around, self._known(around), begun
        )
        if self._lead > 0:
            back = -fill(np.array([0.0, self._lead]), LONGEST)
            self._node, self._state = -self._lead, self._follow(back).state[-1]

    @property
    def _delay(self) -> float:
        return 0.0 if self.testbed.position is None else self.testbed.position.delay

    @property
    def time(self) -> float:
        """Bench time, s."""
        return self._time

    @property
    def touches(self) -> tuple[()]:
        """Touches of a stop: there is none."""
        return ()

    def read(self, duration: float) -> Recording:
        """Let ``duration`` seconds pass and return what was recorded since the last read."""
        check_duration(duration)
        since, self._time = self._time, tick_one(self._time + duration)
        after, self._read_until = self._read_until, self._time
        t = self._nodes()
        motion = self._follow(t)
        recording = self._recording(t, motion, after, since)
        behind = self._time - self._lead
        whole = np.append(multiples(1.0, self._node, behind), self._node)
        kept = int(np.searchsorted(t, float(whole.max())))
        self._node, self._state = float(t[kept]), motion.state[kept]
        self._track = actuator.without_past(self._track, self._node - self.platform.truth.mass_lag)
        return recording

    def move(self, targets: Mapping[str, float], speed: float = math.inf) -> None:
        """Set masses on their way to displacements from home (m); all of them or none."""
        check_speed(speed)
        masses, faults = actuator.slowed(self.platform.masses, speed), self.platform.truth.faults
        goals = actuator.checked(self._travel, self._time, targets, masses)
        sent = actuator.sent(self._travel, self._time, goals, masses, faults, self._stops_rng)
        self._command(sent)

    def drive(self, inputs: Mapping[str, float]) -> None:
        """Refuse any input: there is no device beside the masses."""
        if inputs:
            raise InputError("drive", f"'{next(iter(inputs))}'", "none: the testbed has no devices")

    def stop(self) -> None:
        """Halt every mass where it is."""
        self._command(actuator.halted(self._travel, self._time))

    def truth(self) -> MassProperties:
        """Return the mass properties as masses really stand now."""
        body, real = self.platform.body, self._real(np.array([self._time]))[0]
        inertia = body.inertia_P + unpack_symmetric(inertia_shift(self._rails, real))
        return MassProperties(
            body.mass, body.com + com_shift(self._rails, body.mass, real), inertia
        )

    def _command(self, travel: actuator.Travel) -> None:
        self._travel = travel
        self._track = actuator.retracked(self._track, travel, self._time)

    def _nodes(self) -> Series1:
        """Return the nodes from the one where the state is kept to a moment past now."""
        start, now = self._node, self._time
        turns = tick(self._track.t + self.platform.truth.mass_lag)
        sensors = (self.testbed.attitude, self.testbed.gyro)
        observed = [samples_between(sensor, start, now) for sensor in sensors]
        placed = self._placed_between(start, now)
        t = np.concatenate([[start], *observed, placed, turns, multiples(1.0, start, now)])
        t = np.unique(t[(t >= start) & (t <= now)])
        return fill(np.append(t, t[-1] + LONGEST), LONGEST)

    def _placed_between(self, start: float, now: float) -> Series1:
        """Return when positions in (start, now] s are measured, also of rows not yet stamped."""
        sensor = self.testbed.position
        if sensor is None:
            return np.zeros(0)
        return tick(samples(sensor.rate, start + sensor.delay, now + sensor.delay) - sensor.delay)

    def _known(self, t: Series1) -> Floats:
        """Return the known inputs at nodes: nothing but displacements."""
        return np.hstack([np.zeros((len(t), KNOWN_D)), self._real(t)])

    def _real(self, t: Series1) -> Floats:
        """Return where the masses really are, m from home, (n, k)."""
        return read_at(t - self.platform.truth.mass_lag, self._track.t, self._track.real)

    def _follow(self, t: Series1) -> PlanarMotion:
        """Return the motion along nodes, from where the state is kept."""
        maps = stacked(self._rails)
        return run_planar(self._body, self._top, maps, t, self._known(t), self._state)

    def _recording(self, t: Series1, motion: PlanarMotion, after: float, since: float) -> Recording:
        """Return the rows stamped after a time (s), masses since a time (s)."""
        testbed, masses = self.testbed, None
        if testbed.masses:
            start = max(since - self._lead, 0.0)
            masses = actuator.reported_rows(self._track, start, self._time)
        return Recording(
            self._attitude(t, motion.state, after),
            self._rate(t, motion.rate, after),
            testbed.mass_names,
            masses,
            position=self._position(t, motion.state, after),
            source=f"simulated {testbed.name}, seed {self.seed}",
        )

    def _attitude(self, t: Series1, states: Floats, after: float) -> Samples | None:
        sensor, errors = self.testbed.attitude, self.platform.truth.camera
        if sensor is None:
            return None
        stamps = samples(sensor.rate, after, self._time)
        q = states[np.searchsorted(t, sampled_at(sensor, stamps)), :4]
        rows = camera_rows(misread(q, errors, self.testbed.up), sensor, self._camera_rng)
        kept = outside(stamps, self.platform.truth.gaps)
        return Samples(stamps[kept], whole_angles(rows, sensor.quantum)[kept])

    def _rate(self, t: Series1, rates: Floats, after: float) -> Samples | None:
        sensor, truth = self.testbed.gyro, self.platform.truth
        if sensor is None:
            return None
        stamps = samples(sensor.rate, after, self._time)
        w = misfelt(rates[np.searchsorted(t, sampled_at(sensor, stamps))], truth.gyro)
        rows = gyro_rows(w, sensor, truth.gyro_bias, self._gyro_rng)
        kept = outside(stamps, truth.gaps)
        return Samples(stamps[kept], whole(rows, sensor.quantum)[kept])

    def _position(self, t: Series1, states: Floats, after: float) -> Samples | None:
        sensor = self.testbed.position
        if sensor is None:
            return None
        stamps = samples(sensor.rate, after, self._time)
        there = states[np.searchsorted(t, tick(stamps - sensor.delay)), P : P + 2]
        noise = sensor.noise * self._position_rng.standard_normal(there.shape)
        kept = outside(stamps, self.platform.truth.gaps)
        return Samples(stamps[kept], (there + noise)[kept])
