"""The simulated bench: the same verbs as a real one, and a seed that reproduces everything.

The motion is integrated from node to node. Nodes are moments that do not depend on how the bench
is read: every sample of every sensor, corners of the masses' tracks, the noise torque's grid and
whole seconds. The state is kept at the last node that precedes every later sample, so reads of any
length return the same rows.

Rows come at most once: those stamped in (previous read, now], the first read with time zero. Mass
rows reach back by the sensors' delay, as samples do. A rate that is sampled exactly when a mass
starts or stops is the rate just before. Before time zero the masses stood at home and the platform
moved as it must have to be at its first attitude and rate at time zero.

At the tilt limit the platform meets its stop (``simulation.stop``).
"""

import math
from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from equipoise.actuators.control_moment_gyros import gimbal_maps
from equipoise.actuators.sliding_masses import com_shift, inertia_shift, mass_maps
from equipoise.actuators.stored_momentum import stored_momentum
from equipoise.dynamics.modal_motion import begun, modes_of
from equipoise.dynamics.propagation import rigid_body, stacked
from equipoise.dynamics.regressor import DRIFT, THERMAL
from equipoise.dynamics.sag_trim import SAG_TERMS, acting_com, sag_matrix
from equipoise.maths.attitude import tilt
from equipoise.maths.linalg import unpack_symmetric
from equipoise.maths.straight_lines import read_at
from equipoise.model.arrays import Floats, Matrix3, Series1, Series3, Vector3
from equipoise.model.bench_requests import check_duration, check_speed
from equipoise.model.mass_properties import MassProperties
from equipoise.model.recording import Recording, Samples
from equipoise.model.testbed import AttitudeSensor, Gyro, Testbed
from equipoise.model.torque_terms import TERMS
from equipoise.sensors.vector_sensors import CHANNELS, VectorSensor, vector_sensors
from equipoise.simulation import actuator
from equipoise.simulation.camera_and_gyro import (
    Sensor,
    camera_rows,
    errors_of,
    gyro_rows,
    lead,
    outside,
    sampled_at,
    samples_between,
    vector_rows,
)
from equipoise.simulation.clock import multiples, samples, tick, tick_one
from equipoise.simulation.devices import (
    all_off,
    effects,
    field_rows,
    grid_of,
    inputs_of,
    kept_until,
    reported_states,
    started,
    stored,
)
from equipoise.simulation.draw_truth import draw_truth
from equipoise.simulation.events import com_moved, run_through, times
from equipoise.simulation.followers import bends, driven, without_past
from equipoise.simulation.magnetised import run_magnetised
from equipoise.simulation.motion import Path
from equipoise.simulation.noise_torque import extended, forgotten, start_noise, torque_at
from equipoise.simulation.sensor_errors import misfelt, misread, whole, whole_angles, with_bad_rows
from equipoise.simulation.stop import NO_STOP, stop_at
from equipoise.simulation.surroundings.lamp import (
    is_lit,
    lamp_nodes,
    lamp_of,
    power_rows,
    temperature_rows,
    warmth_since_start,
)
from equipoise.simulation.surroundings.magnetic_field import field_at, measured_field
from equipoise.simulation.touches import Noted, Touch, noted

REPORTS = 20.0  # Hz, chosen: how often devices report where no sensor sets the pace
A_MOMENT = 1e-3  # s, chosen: the motion is followed on to now, or so far on when now is a node
AT_ONCE = 1e-3  # s, chosen: a leg that begins so soon after another is the same way


class SimulatedBench:
    """A bench made of equations; see ``model.bench.Bench``. ``platform`` is what it really is.

    The testbed's [truth] says what the platform is like; the seed draws what it leaves open. Masses
    stand at home, or where ``standing`` says that they were left (m).
    """

    def __init__(
        self, testbed: Testbed, seed: int, standing: Mapping[str, float] | None = None
    ) -> None:
        streams = [np.random.default_rng(s) for s in np.random.SeedSequence(seed).spawn(12)]
        rng, self._stops_rng, self._camera_rng, self._gyro_rng, self._noise_rng = streams[:5]
        self._bad_rng, self._bad = streams[5], np.zeros(0)
        self._states_rng, self._field_rng = streams[6:8]
        self._vector_rngs = dict[str, np.random.Generator](
            zip(CHANNELS, streams[8:11], strict=True)
        )
        self._warm_rng = streams[11]
        self._devices = started(testbed)
        self.testbed, self.seed = testbed, seed  # as stated; of all that is drawn
        self.platform = draw_truth(testbed, rng)
        self._vectors = vector_sensors(testbed)
        self._sensors = (testbed.attitude, testbed.gyro, *self._vectors)
        body, truth, masses = self.platform.body, self.platform.truth, self.platform.masses
        self._body = rigid_body(body, testbed.gravity, self.platform.torque)
        self._modes = modes_of(truth.modes, testbed.up, testbed.gravity) if truth.modes else None
        self._stop = stop_at(testbed.up, testbed.tilt_limit)
        self._touched = Noted()
        self._happens = times([*truth.contacts, *truth.com_steps])
        self._lamp = lamp_of(testbed.lamp, truth.lamp)
        self._rails = mass_maps(masses)
        self._maps = np.vstack([stacked(self._rails), stacked(gimbal_maps(testbed.cmgs))])
        self._travel = actuator.left_at(masses, standing or {}, self._stops_rng)
        self._track = actuator.tracked(self._travel)
        self._normals = np.zeros(len(masses))  # stop errors of legs, of one sd
        self._noise = start_noise(truth.noise_torque, truth.noise_correlation, self._noise_rng)
        self._lead = max(map(lead, self._sensors))
        self._time, self._read_until = 0.0, -1.0
        self._now = self._first_state()
        self._node, self._state = 0.0, self._now
        if self._lead > 0:
            self._node = -self._lead
            self._state = self._follow(np.array([0.0, self._node])).y[-1]

    @property
    def time(self) -> float:
        """Bench time, s."""
        return self._time

    def read(self, duration: float) -> Recording:
        """Let ``duration`` seconds pass and return what was recorded since the last read."""
        check_duration(duration)
        since, self._time = self._time, tick_one(self._time + duration)
        after, self._read_until = self._read_until, self._time
        t = self._nodes()
        end = self._time if self._time > t[-1] else t[-1] + A_MOMENT
        path = self._follow(np.append(t, end))
        recording = self._recording(t, path, after, since)
        self._touched = noted(self._touched, t, path.touch, self._time)
        self._advance(t, path)
        return recording

    def move(self, targets: Mapping[str, float], speed: float = math.inf) -> None:
        """Set masses on their way to displacements from home (m); all of them or none."""
        check_speed(speed)
        masses, faults = actuator.slowed(self.platform.masses, speed), self.platform.truth.faults
        goals = actuator.checked(self._travel, self._time, targets, masses)
        travel = actuator.sent(self._travel, self._time, goals, masses, faults, self._stops_rng)
        self._command(travel)

    def lead(self, name: str, start: float, end: float, displacement: float) -> None:
        """Lead a mass on a leg, as a drive of its own does: from ``start`` to ``end`` (s), to m.

        Nothing is checked: that is the drive's matter. A leg that follows at once has the stop
        error of the one before.
        """
        i = self.testbed.mass_names.index(name)
        fresh = start > self._travel.arrive[i] + AT_ONCE
        if fresh:
            self._travel = replace(self._travel, moves=self._travel.moves + 1)
            self._normals[i] = self._stops_rng.standard_normal()
        platform, leg = self.platform, (start, end, displacement)
        mass, normal = platform.masses[i], float(self._normals[i])
        travel = actuator.led(self._travel, i, leg, mass, platform.truth.faults, normal)
        self._travel, self._track = travel, actuator.retracked(self._track, travel, start)

    def drive(self, inputs: Mapping[str, float]) -> None:
        """Give devices their inputs (``model.devices``); all of them or none."""
        self._devices = driven(self._devices, self._time, *inputs_of(self.testbed, inputs))

    def stop(self) -> None:
        """Halt every mass where it is, and every device."""
        self._command(actuator.halted(self._travel, self._time))
        self._devices = driven(self._devices, self._time, all_off(self.testbed), {})

    def truth(self) -> MassProperties:
        """Return the mass properties as masses and gimbals really stand now, as they act level.

        A platform that sags is described by the stiff one that behaves alike at small tilts.
        """
        body, real = self.platform.body, self.displacements
        gimbals = stored(self.testbed, self._devices, np.array([self._time]))[1][0]
        shift = inertia_shift(self._rails, real)
        shift += inertia_shift(gimbal_maps(self.testbed.cmgs), gimbals)
        inertia = body.inertia_P + unpack_symmetric(shift)
        return MassProperties(body.mass, acting_com(self.com, self.sag, self.testbed.up), inertia)

    @property
    def com(self) -> Vector3:
        """Where the centre of mass really is now, elastic sag apart, m."""
        body, coefficients = self.platform.body, self.platform.torque
        drift = coefficients[DRIFT : DRIFT + 3] * self._time
        slipped = com_moved(self.platform.truth.com_steps, self._time)
        warmth = warmth_since_start(self._lamp, np.array([self._time]))[0, 0]
        moved = drift + slipped + warmth * coefficients[THERMAL : THERMAL + 3]
        return body.com + moved + com_shift(self._rails, body.mass, self.displacements)

    @property
    def sag(self) -> Matrix3:
        """Elastic sag C, m."""
        coefficients = self.platform.torque
        return sag_matrix({term: float(coefficients[TERMS.index(term)]) for term in SAG_TERMS})

    @property
    def displacements(self) -> Floats:
        """Where the masses really are now, m from home."""
        return self._real(np.array([self._time]))[0]

    @property
    def bad_rows(self) -> Series1:
        """Stamps of the camera's rows so far that are outliers, s."""
        return self._bad

    @property
    def touches(self) -> tuple[Touch, ...]:
        """Touches of the stop so far."""
        return self._touched.touches

    def tilt_now(self) -> float:
        """Return the angle between the axis that should point up and the vertical, rad."""
        return float(tilt(self._now[:4], self.testbed.up))

    def _first_state(self) -> Floats:
        """Return the state at time zero: masses where they were left, devices as they start."""
        truth = self.platform
        h, gimbals = stored(self.testbed, self._devices, np.zeros(1))
        shift = inertia_shift(gimbal_maps(self.testbed.cmgs), gimbals[0])
        shift += inertia_shift(self._rails, self._travel.end[actuator.REAL])
        inertia = truth.body.inertia_P + unpack_symmetric(shift)
        modes = truth.truth.modes
        inner = sum((mode.coupling * mode.velocity for mode in modes), h[0])
        H = inertia @ truth.rate + inner
        return np.concatenate([truth.attitude, H, begun(modes, truth.rate)])

    def _command(self, travel: actuator.Travel) -> None:
        self._travel = travel
        self._track = actuator.retracked(self._track, travel, self._time)

    def _nodes(self) -> Series1:
        """Return the nodes from the one where the state is kept to now."""
        start, now = self._node, self._time
        self._noise = extended(self._noise, now, self._noise_rng)
        observed = [samples_between(sensor, start, now) for sensor in self._sensors]
        turns = tick(self._track.t + self.platform.truth.mass_lag)
        others = [turns, self._happens, bends(self._devices, start, now)]
        others.append(lamp_nodes(self._lamp, start, now))
        others.append(multiples(grid_of(self.testbed), start, now))
        if self._noise.sd > 0:
            others.append(self._noise.t)
        t = np.unique(np.concatenate([[start], *observed, *others]))
        return t[(t >= start) & (t <= now)]

    def _follow(self, t: Series1) -> Path:
        """Return the motion along nodes, from where the state is kept."""
        truth = self.platform.truth
        h, gimbals = stored(self.testbed, self._devices, t)
        dipole, jets = effects(self.testbed, self._devices, t)
        torque, warmth = torque_at(self._noise, t) + jets, warmth_since_start(self._lamp, t)
        known = np.hstack([h, torque, warmth, self._real(t), gimbals])
        platform, modes = (self._body, self._maps, self._state, t, known), self._modes
        stop = self._stop if t[-1] > t[0] else NO_STOP
        events = (stop, truth.contacts, truth.com_steps)
        if self.platform.field is None or not dipole.any():
            return run_through(*platform, *events, modes)
        field_N = field_at(self.platform.field, self.testbed, self._devices, t)
        return run_magnetised(*platform, *events, dipole, field_N, modes)

    def _real(self, t: Series1) -> Floats:
        """Return where the masses really are, m from home, (n, k)."""
        return read_at(t - self.platform.truth.mass_lag, self._track.t, self._track.real)

    def _recording(self, t: Series1, path: Path, after: float, since: float) -> Recording:
        """Return the rows stamped after a time (s), masses since a time (s)."""
        testbed, names = self.testbed, tuple(mass.name for mass in self.testbed.masses)

        def observed(sensor: Sensor, motion: Floats) -> tuple[Series1, Floats]:
            stamps = samples(sensor.rate, after, self._time)
            return stamps, motion[np.searchsorted(t, sampled_at(sensor, stamps))]

        attitude = rate = masses = None
        if testbed.attitude is not None:
            attitude = self._attitude(*observed(testbed.attitude, path.y[:, :4]), testbed.attitude)
        if testbed.gyro is not None:
            rate = self._rate(*observed(testbed.gyro, path.rate), testbed.gyro)
        if names:
            start = max(since - self._lead, 0.0)
            masses = actuator.reported_rows(self._track, start, self._time)
        source = f"simulated {testbed.name}, seed {self.seed}"
        found = Recording(attitude, rate, names, masses, source=source)
        if testbed.devices:
            found = self._with_devices(found, after)
        found = replace(
            found, field=self._magnetometer(t, path, after), **self._warmth(after, since)
        )
        return replace(found, **{s.channel: self._vector(s, t, path, after) for s in self._vectors})

    def _warmth(self, after: float, since: float) -> dict[str, Samples | None]:
        """Return temperature, stamped after a time (s), and the lamp's switch since a time."""
        sensor, rng, now = self.testbed.thermometer, self._warm_rng, self._time
        temperature = temperature_rows(self._lamp, sensor, after, now, rng)
        start = max(since - self._lead, 0.0)
        power = power_rows(self.platform.truth.lamp, start, now)
        return {"temperature": temperature, "lamp": power}

    def _vector(self, sensor: VectorSensor, t: Series1, path: Path, after: float) -> Samples:
        """Return the rows of a sensor of a vector, stamped after a time (s)."""
        truth, stamps = self.platform.truth, samples(sensor.rate, after, self._time)
        moments = sampled_at(sensor, stamps)
        at = np.searchsorted(t, moments)
        if sensor.channel == "field":
            sensor = replace(sensor, vector_N=self._field(moments[:, 0]))
        off = errors_of(sensor.channel, truth)
        rng = self._vector_rngs[sensor.channel]
        rows = vector_rows(path.y[at, :4], path.rate[at], sensor, off, rng)
        kept = outside(stamps, truth.gaps)
        if sensor.channel == "sun":
            kept &= is_lit(self.testbed.lamp, truth.lamp, moments[:, 0])
        return Samples(stamps[kept], rows[kept])

    def _magnetometer(self, t: Series1, path: Path, after: float) -> Samples | None:
        """Return the magnetometer's rows, at the attitude of the node at or before each stamp."""
        known = self.testbed.magnetic_field
        if known is None or known.noise is None:
            return None
        stamps = samples(self._reports, after, self._time)
        q = path.y[np.searchsorted(t, stamps, side="right") - 1, :4]
        return Samples(stamps, field_rows(q, self._field(stamps), known.noise, self._field_rng))

    def _field(self, t: Series1) -> Series3:
        """Return the magnetic field (n, 3) T at the magnetometer at times (s), laboratory axes."""
        assert self.platform.field is not None
        return measured_field(self.platform.field, self.testbed, self._devices, t)

    @property
    def _reports(self) -> float:
        """How often devices report, Hz."""
        sensor = self.testbed.gyro or self.testbed.attitude
        return REPORTS if sensor is None else sensor.rate

    def _with_devices(self, recording: Recording, after: float) -> Recording:
        """Return the recording with what the devices report, and what follows from it."""
        testbed, rng = self.testbed, self._states_rng
        t = samples(self._reports, after, self._time)
        rows = reported_states(testbed, self._devices, t, rng, 1 / self._reports)
        observed = replace(recording, device_names=testbed.device_names, devices=Samples(t, rows))
        return replace(observed, momentum=stored_momentum(observed, testbed))

    def _attitude(self, t: Series1, q: Floats, sensor: AttitudeSensor) -> Samples:
        """Return the camera's rows stamped ``t`` from attitudes at its samples."""
        errors = self.platform.truth.camera
        noisy = camera_rows(misread(q, errors, self.testbed.up), sensor, self._camera_rng)
        rows, bad = with_bad_rows(noisy, errors, self._bad_rng)
        kept = outside(t, self.platform.truth.gaps)
        self._bad = np.append(self._bad, t[bad & kept])
        return Samples(t[kept], whole_angles(rows, sensor.quantum)[kept])

    def _rate(self, t: Series1, w: Floats, sensor: Gyro) -> Samples:
        """Return the gyro's rows stamped ``t`` from rates at its samples."""
        truth = self.platform.truth
        rows = gyro_rows(misfelt(w, truth.gyro), sensor, truth.gyro_bias, self._gyro_rng)
        kept = outside(t, truth.gaps)
        return Samples(t[kept], whole(rows, sensor.quantum)[kept])

    def _advance(self, t: Series1, path: Path) -> None:
        """Keep the state now, and at the last node that precedes every later sample."""
        self._now = path.y[int(np.searchsorted(t, self._time))]
        behind = kept_until(self.testbed, self._time - self._lead)
        kept = max(int(np.searchsorted(t, behind, side="right")) - 1, 0)
        self._node, self._state = float(t[kept]), path.y[kept]
        self._noise = forgotten(self._noise, self._node)
        self._devices = without_past(self._devices, self._node - 1 / self._reports)
        self._track = actuator.without_past(self._track, self._node - self.platform.truth.mass_lag)
