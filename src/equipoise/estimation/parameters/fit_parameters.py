"""The unknowns of a trajectory.

Physical coordinates, in which information and covariance are stated:

    [ turn of the first attitude (3) | first rate (3) | J_P xx yy zz xy xz yz | com (3)
      | torque coefficients | errors of the masses | sensor coefficients | gyro bias (3) ]

The inertia itself is kept as the six numbers of ``maths.pseudo_inertia``, so every point is a body
that can exist. What a step does to a point is in ``retraction``.
"""

from dataclasses import dataclass, replace

import numpy as np

from equipoise.actuators.mass_errors import unit_of
from equipoise.estimation.parameters import retraction
from equipoise.maths import pseudo_inertia
from equipoise.maths.linalg import pack_symmetric
from equipoise.model import sensor_terms, torque_terms
from equipoise.model.arrays import Floats, Ints, Quaternion, Vector3, Vector6
from equipoise.model.estimate import ATTITUDE, COM, INERTIA
from equipoise.model.estimate import RATE as RATES
from equipoise.model.mass_properties import MassProperties, from_centre
from equipoise.model.testbed import CLOCK_SD, PLUMB_SD, Testbed
from equipoise.sensors.vector_sensors import vector_sensors

TURN, RATE, JP, R = slice(0, 3), slice(3, 6), slice(6, 12), slice(12, 15)
CORE = slice(JP.start, R.stop)  # inertia and centre of mass
FIXED = retraction.BEHIND  # coordinates before torques, errors and bias


def core_of(body: MassProperties) -> Floats:
    """Return what a body has in ``CORE``: J_P (6) and com (3)."""
    return np.append(pack_symmetric(body.inertia_P), body.com)


@dataclass(frozen=True, slots=True, eq=False)
class Layout:
    """Which of the optional unknowns there are."""

    terms: tuple[str, ...] = ()  # torques
    errors: tuple[str, ...] = ()
    bias: bool = False
    sensor: tuple[str, ...] = ()  # of what is wrong with the sensors

    @property
    def size(self) -> int:
        """Return the number of unknowns."""
        return FIXED + len(self.terms) + len(self.errors) + len(self.sensor) + 3 * self.bias

    @property
    def torques(self) -> slice:
        """Return where the torque coefficients stand."""
        return slice(FIXED, FIXED + len(self.terms))

    @property
    def mass_errors(self) -> slice:
        """Return where the errors of the masses stand."""
        return slice(self.torques.stop, self.torques.stop + len(self.errors))

    @property
    def sensors(self) -> slice:
        """Return where the sensors' coefficients stand."""
        return slice(self.mass_errors.stop, self.mass_errors.stop + len(self.sensor))

    @property
    def gyro_bias(self) -> slice:
        """Return where the gyro's bias stands."""
        return slice(self.sensors.stop, self.size)

    @property
    def names(self) -> tuple[str, ...]:
        """Return the names in physical coordinates."""
        bias = ("gyro_bias_x", "gyro_bias_y", "gyro_bias_z") if self.bias else ()
        return (*ATTITUDE, *RATES, *INERTIA, *COM, *self.terms, *self.errors, *self.sensor, *bias)

    @property
    def units(self) -> tuple[str, ...]:
        """Return their units."""
        first = ("rad",) * 3 + ("rad/s",) * 3 + ("kg m2",) * 6 + ("m",) * 3
        terms = tuple(torque_terms.unit_of(term) for term in self.terms)
        errors = tuple(unit_of(name) for name in self.errors)
        bias = ("rad/s",) * (3 * self.bias)
        sensor = tuple(sensor_terms.unit_of(term) for term in self.sensor)
        return first + terms + errors + sensor + bias

    @property
    def torque_index(self) -> list[int]:
        """Return the columns of the torques among all of them."""
        return [torque_terms.TERMS.index(term) for term in self.terms]

    @property
    def sensor_index(self) -> list[int]:
        """Return where the sensors' coefficients stand among all of them."""
        return [sensor_terms.TERMS.index(term) for term in self.sensor]

    @property
    def slots(self) -> Ints:
        """Return where a flat point keeps each coordinate; -1 for the turn and J_P, kept as q, six.

        The bias comes last in a point, whether it is sought or not.
        """
        w, com, error = retraction.W, retraction.COM, retraction.ERROR
        bias = error + len(self.errors)
        slots = [*[-1] * 3, *range(w, w + 3), *[-1] * 6, *range(com, com + 3)]
        slots += [retraction.TORQUE + k for k in self.torque_index]
        slots += [*range(error, bias), *(retraction.SENSOR + k for k in self.sensor_index)]
        slots += range(bias, bias + 3 * self.bias)
        return np.array(slots, dtype=np.int64)


@dataclass(frozen=True, slots=True, eq=False)
class Unknowns:
    """One point of the search."""

    q0: Quaternion
    w0: Vector3  # rad/s
    six: Vector6  # of J_C, masses at home
    com: Vector3  # m, masses at home
    torque: Floats  # (19,)
    sensor: Floats  # (40,)
    error: Floats  # (e,) in the units of ``mass_errors.unit_of``
    bias: Vector3  # rad/s

    @property
    def flat(self) -> Floats:
        """Return the point as the kernels keep it."""
        return np.concatenate([self.q0, self.w0, self.six, self.com, self.torque, self.sensor,
                               self.error, self.bias])  # fmt: skip

    def body(self, mass: float) -> MassProperties:
        """Return the mass properties with the masses at home."""
        return from_centre(mass, self.com, pseudo_inertia.to_inertia(self.six))


def unknowns_of(flat: Floats) -> Unknowns:
    """Return a point of the kernels by its parts: the inverse of ``Unknowns.flat``."""
    cuts = (retraction.W, retraction.SIX, retraction.COM, retraction.TORQUE,
            retraction.SENSOR, retraction.ERROR)  # fmt: skip
    return Unknowns(*np.split(flat, (*cuts, len(flat) - 3)))


def term_sizes(terms: tuple[str, ...], inertia: float, weight: float) -> Floats:
    """Return a size natural to each torque coefficient.

    For a moment of inertia (kg m^2) and a weight (N): damping in 10 s, the torque of 10 um, a sag
    of 10 um, a drift of 1 um/s, 1 um for each kelvin.
    """
    by_group = {"viscous": 0.1 * inertia, "quadratic": inertia, "sag": 1e-5, "drift": 1e-6,
                "thermal": 1e-6}  # fmt: skip
    return np.array([by_group.get(term.split("_")[0], 1e-5 * weight) for term in terms])


def sensor_sizes(terms: tuple[str, ...], testbed: Testbed) -> Floats:
    """Return how large each sensor coefficient may well be, one sd, chosen.

    A camera's vertical, a gyro's clock, biases and mountings as far off as stated, each part of a
    heading error 0.06 deg, 30 ms, a gyro 2 % off.
    """
    camera, gyro = testbed.attitude, testbed.gyro
    plumb = camera.plumb_sd if camera and camera.plumb_sd else PLUMB_SD
    clock = gyro.clock_sd if gyro and gyro.clock_sd else CLOCK_SD
    by_group = {"plumb": plumb, "heading2": 1e-3, "heading3": 1e-3, "camera": 0.03, "gyro": 0.02}
    by_term = {sensor_terms.GYRO_CLOCK: clock}
    for each in vector_sensors(testbed):
        by_term |= dict.fromkeys(sensor_terms.BIASES.get(each.channel, ()), each.bias_sd)
        by_term |= dict.fromkeys(sensor_terms.MOUNTINGS[each.channel], each.mounting_sd)
    return np.array([by_term.get(term) or by_group[term.split("_")[0]] for term in terms])


def physical(point: Unknowns, mass: float, layout: Layout) -> Floats:
    """Return the physical coordinates; the turn of the first attitude is zero at the point."""
    return retraction.coordinates(point.flat, mass, layout.slots)


def with_errors_of(point: Unknowns, old: Layout, new: Layout) -> Unknowns:
    """Return a point with the errors of masses of another layout, by name; new ones are zero."""
    known = dict(zip(old.errors, point.error, strict=True))
    return replace(point, error=np.array([known.get(name, 0.0) for name in new.errors]))
