"""A bench whose platform is made of MuJoCo bodies, read and driven as any bench. Development only.

Masses are points on slide joints whose servos follow a motor at constant speed; wheels are rotors
on hinges, turned by torque. Masses report what their motors were told, as stepper boards do; wheels
report the speed that they have. Jets and coils are torques on the bearing's ball joint, in body
axes. The camera and the gyro add white noise and a bias.

Servos give way by g / SERVO^2, alike along three rails at right angles with alike masses: an
isotropic sag, which turns nothing.
"""

import math
from collections.abc import Mapping
from dataclasses import replace

import mujoco
import numpy as np
from numpy.typing import NDArray

from equipoise.actuators.stored_momentum import stored_momentum
from equipoise.model.recording import Recording, Samples
from equipoise.model.testbed import Testbed
from tests.oracle.mujoco_bench import Platform, Slide, matrix, product, rotation
from tests.oracle.mujoco_momentum import Driven, Wheel, model_text

Array = NDArray[np.float64]
STEP = 2e-3  # s, chosen: 0.4 rad of the servos, far inside RK4's stability
SERVO = 200.0  # rad/s, chosen
ROTOR = 0.3  # kg, chosen


def platform_of(testbed: Testbed, com: Array, inertia_P: Array, tilt: Array, rate: Array
                ) -> Platform:  # fmt: skip
    """Return a platform with a testbed's masses; com, inertia and start are the truth."""
    slides = tuple(Slide(m.name, m.mass, m.home, m.axis, SERVO) for m in testbed.masses)
    mass = testbed.body.mass
    return Platform(mass, inertia_P, com, slides, testbed.gravity, rotation(tilt), rate)


def wheels_of(testbed: Testbed) -> tuple[Wheel, ...]:
    """Return a testbed's wheels as rotors, each a hand's breadth from P."""
    return tuple(
        Wheel(w.name, 0.1 * w.axis, w.axis, ROTOR, w.inertia, 0.6 * w.inertia, w.speed)
        for w in testbed.wheels
    )


def columns(axes: list[Array]) -> Array:
    """Return axes side by side, (3, n)."""
    return np.array(axes).reshape(-1, 3).T


class MujocoBench:
    """A live bench; see ``model.bench.Bench``. ``com`` is the truth, at any time."""

    def __init__(self, testbed: Testbed, platform: Platform, seed: int) -> None:
        self._testbed, self._platform = testbed, platform
        self._rng = np.random.default_rng(seed)
        given = Driven(platform, wheels_of(testbed), dt=STEP)
        self._model = mujoco.MjModel.from_xml_string(model_text(given))
        self._data = mujoco.MjData(self._model)
        self._slides = slice(len(testbed.wheels), len(testbed.wheels) + len(testbed.masses))
        self._stiffen()
        self._data.qpos[:4], self._data.qvel[:3] = platform.q, platform.rate
        self._steps, self._goal = 0, np.zeros(len(testbed.masses))
        self._reported, self._speed = self._goal.copy(), math.inf
        self._dipole = np.zeros(len(testbed.magnetorquers))
        self._pulse = np.zeros(len(testbed.jets))  # N m s that is left of the last pulses
        self._given = np.zeros(len(testbed.jets))  # N m s since the last row of devices
        self._coil_axes = columns([c.axis for c in testbed.magnetorquers])
        self._jet_axes = columns([jet.axis for jet in testbed.jets])
        self._most = STEP * np.array([jet.torque for jet in testbed.jets])  # N m s
        self._nothing = np.zeros(3)
        self._bias = np.deg2rad([0.02, -0.01, 0.015])
        self._rows = self._empty()
        self._measurement()

    def _stiffen(self) -> None:
        """Give the masses' servos their frequency."""
        mass = np.array([m.mass for m in self._testbed.masses])
        self._model.actuator_gainprm[self._slides, 0] = mass * SERVO**2
        self._model.actuator_biasprm[self._slides, 1] = -mass * SERVO**2
        self._model.actuator_biasprm[self._slides, 2] = -2 * mass * SERVO

    @staticmethod
    def _empty() -> dict[str, list[tuple[float, Array]]]:
        return {"attitude": [], "rate": [], "masses": [], "devices": []}

    @property
    def testbed(self) -> Testbed:
        """What is known of it beforehand."""
        return self._testbed

    @property
    def time(self) -> float:
        """Bench time, s."""
        return self._steps * STEP

    @property
    def com(self) -> Array:
        """The total centre of mass, m, with the masses where their motors are."""
        return self._platform.com_at(self._reported)

    @property
    def attitude(self) -> Array:
        """The attitude now, body to laboratory."""
        return self._data.qpos[:4].copy()

    @property
    def tilt(self) -> float:
        """The angle between the body's z axis and the vertical, rad."""
        return float(np.arccos(np.clip(matrix(self._data.qpos[:4])[2, 2], -1.0, 1.0)))

    def move(self, targets: Mapping[str, float], speed: float = math.inf) -> None:
        """Set masses on their way."""
        self._speed = speed
        for name, goal in targets.items():
            self._goal[self._testbed.mass_names.index(name)] = goal

    def drive(self, inputs: Mapping[str, float]) -> None:
        """Give wheels their torques, coils their dipoles, jets their pulses."""
        bed = self._testbed
        kinds = ((bed.wheels, self._data.ctrl), (bed.magnetorquers, self._dipole),
                 (bed.jets, self._pulse))  # fmt: skip
        for devices, reported in kinds:
            for k, device in enumerate(devices):
                reported[k] = inputs.get(device.name, reported[k])

    def stop(self) -> None:
        """Halt everything."""
        self._goal = self._reported.copy()
        self._data.ctrl[: len(self._testbed.wheels)] = 0.0
        self._dipole[:], self._pulse[:] = 0.0, 0.0

    def read(self, duration: float) -> Recording:
        """Let time pass and return what was seen since the last read."""
        speed = np.minimum([m.speed for m in self._testbed.masses], self._speed)
        for _ in range(round(duration / STEP)):
            way = self._goal - self._reported
            self._reported += np.clip(way, -speed * STEP, speed * STEP)
            self._before_step()
            self._data.ctrl[self._slides] = self._reported
            self._data.qfrc_applied[:3] = self._from_coils() + self._from_jets()
            mujoco.mj_step(self._model, self._data)
            self._steps += 1
            self._measurement()
        return self._recording()

    def _before_step(self) -> None:
        """Let what surrounds the platform have its effect; there is nothing here."""

    def _from_coils(self) -> Array:
        """Return the torque of the coils in the laboratory's field, N m, body axes."""
        if self._testbed.magnetic_field is None or not self._dipole.any():
            return self._nothing
        moment = self._coil_axes @ self._dipole
        field = matrix(self._data.qpos[:4]).T @ self._testbed.field_N()
        torque = np.empty(3)
        mujoco.mju_cross(torque, moment, field)
        return torque

    def _from_jets(self) -> Array:
        """Return the mean torque of the jets over this step, N m; spent pulses end."""
        if not self._pulse.any():
            return self._nothing
        now = np.clip(self._pulse, -self._most, self._most)
        self._pulse -= now
        self._given += now
        return self._jet_axes @ now / STEP

    def _measurement(self) -> None:
        """Add the rows that are due."""
        camera, gyro = self._testbed.attitude, self._testbed.gyro
        assert camera is not None
        assert gyro is not None
        if self._steps % round(1 / (camera.rate * STEP)) == 0:
            error = rotation(camera.noise * self._rng.normal(size=3))
            self._add("attitude", product(self._data.qpos[:4].copy(), error))
        if self._steps % round(1 / (gyro.rate * STEP)) == 0:
            noise = gyro.noise * self._rng.normal(size=3)
            self._add("rate", self._data.qvel[:3] + self._bias + noise)
            self._add("masses", self._reported.copy())
            speeds = [self._data.joint(w.name).qvel[0] for w in self._testbed.wheels]
            thrust = self._given * gyro.rate
            self._given = np.zeros_like(self._given)
            self._add("devices", np.array([*speeds, *self._dipole, *thrust]))

    def _add(self, channel: str, row: Array) -> None:
        self._rows[channel].append((self.time, row))

    def _recording(self) -> Recording:
        """Return the rows since the last read."""
        rows, self._rows = self._rows, self._empty()
        found = {name: self._samples(rows[name]) for name in rows}
        bed = self._testbed
        observed = Recording(
            found["attitude"], found["rate"], bed.mass_names, found["masses"],
            device_names=bed.device_names, devices=found["devices"], source="MuJoCo",
        )  # fmt: skip
        return replace(observed, momentum=stored_momentum(observed, bed))

    @staticmethod
    def _samples(rows: list[tuple[float, Array]]) -> Samples | None:
        if not rows:
            return None
        t, values = zip(*rows, strict=True)
        return Samples(np.array(t), np.array(values))
