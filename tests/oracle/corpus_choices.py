"""The space of the corpus: what a seed draws before anything is simulated.

Every group of choices has a stream of its own, so that a new choice changes no other.
"""

from dataclasses import dataclass
from enum import StrEnum

import numpy as np

ISSUE = 35  # chosen: keeps these streams apart from those of other records
MASS, DEPTH = (0.5, 5000.0), (5e-6, 5e-3)  # kg; m, of the centre of mass, below P or above
SPIN, TILT = (0.5, 300.0), (0.2, 30.0)  # deg/s; deg
DURATION = (3.0, 3600.0)  # s
CAMERA_HZ = (1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0)
GYRO_HZ = (10.0, 20.0, 50.0, 100.0, 200.0)
CAMERA_DEG, GYRO_DEG_S = (0.005, 0.2), (0.003, 0.1)  # noise, one sd per axis and row
SPEED, WAY_MM = (0.010, 0.3), (2, 50)  # m/s; mm, of a mass
LATE = (0.020, 0.100)  # s, by which a late log is behind
DRAG = (1e-5, 5e-4)  # 1/s, of the moments of inertia
ABOVE, STILL, SLID, DRAGGED = 0.25, 0.15, 0.8, 0.5  # chosen shares of the platforms


class Shape(StrEnum):
    """How mass lies about its centre."""

    DISC = "disc"
    ROD = "rod"  # along x or z, moments 1 : 20 or so
    SPHERE = "sphere"


class Sensors(StrEnum):
    """What sees the platform."""

    CAMERA = "camera"
    GYRO = "gyro"
    BOTH = "both"


class MassLog(StrEnum):
    """What the record says of the masses."""

    NONE = "no masses"
    EXACT = "exact"  # an encoder on each rail, 50 Hz
    STEPS = "steps"  # of 2 mm, at the sensors' rate
    LATE = "late"  # where they were some time before
    COMMAND = "command"  # where they were commanded to be


@dataclass(frozen=True, slots=True)
class Choices:
    """One point of the space."""

    seed: int
    mass: float  # kg
    shape: Shape
    depth: float  # m, below P; negative: above
    spin: float  # deg/s, about body z
    tilt: float  # deg
    duration: float  # s, wanted; at the stop a record ends before
    sensors: Sensors
    camera_hz: float
    camera_deg: float
    gyro_hz: float
    gyro_deg_s: float
    log: MassLog
    moves: int
    speed: float  # m/s, of the mass that travels furthest
    late: float  # s
    drag: float  # 1/s, of the moments of inertia; 0: none

    @property
    def rates(self) -> tuple[float, ...]:
        """Return the rates of the sensors that there are, Hz."""
        present = {
            Sensors.CAMERA: (self.camera_hz,),
            Sensors.GYRO: (self.gyro_hz,),
            Sensors.BOTH: (self.camera_hz, self.gyro_hz),
        }
        return present[self.sensors]

    @property
    def label(self) -> str:
        """Return the class of the record in a few words."""
        height = f"com {abs(self.depth) * 1e6:.0f} um {'below' if self.depth > 0 else 'above'}"
        hz = "+".join(f"{rate:g}" for rate in self.rates)
        return (
            f"{self.shape} {self.mass:.3g} kg, {height}, {self.spin:.3g} deg/s, "
            f"tilt {self.tilt:.2g} deg, {self.sensors} {hz} Hz, {self.duration:.3g} s, {self.log}"
        )


def stream(seed: int, *path: int) -> np.random.Generator:
    """Return the stream of a group of choices."""
    return np.random.default_rng([ISSUE, seed, *path])


def between(rng: np.random.Generator, ends: tuple[float, float]) -> float:
    """Return a number whose logarithm is uniform."""
    return float(np.exp(rng.uniform(*np.log(ends))))


def choices(seed: int) -> Choices:
    """Return what a seed draws."""
    body, height, motion, length, sensed, slid, drag = (stream(seed, 0, k) for k in range(7))
    return Choices(
        seed,
        mass=between(body, MASS),
        shape=Shape(str(body.choice(list(Shape)))),
        depth=between(height, DEPTH) * (-1.0 if height.random() < ABOVE else 1.0),
        spin=_spin(motion),
        tilt=between(motion, TILT),
        duration=between(length, DURATION),
        sensors=Sensors(str(sensed.choice(list(Sensors)))),
        camera_hz=float(sensed.choice(CAMERA_HZ)),
        camera_deg=between(sensed, CAMERA_DEG),
        gyro_hz=float(sensed.choice(GYRO_HZ)),
        gyro_deg_s=between(sensed, GYRO_DEG_S),
        log=_log(slid),
        moves=int(slid.integers(1, 5)),
        speed=between(slid, SPEED),
        late=float(slid.uniform(*LATE)),
        drag=between(drag, DRAG) if drag.random() < DRAGGED else 0.0,
    )


def _spin(rng: np.random.Generator) -> float:
    """Return deg/s, either way; some platforms do not spin."""
    spin = between(rng, SPIN) * float(rng.choice([-1.0, 1.0]))
    return 0.0 if rng.random() < STILL else spin


def _log(rng: np.random.Generator) -> MassLog:
    kinds = [log for log in MassLog if log is not MassLog.NONE]
    log = MassLog(str(rng.choice(kinds)))
    return log if rng.random() < SLID else MassLog.NONE
