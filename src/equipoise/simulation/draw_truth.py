"""What the simulated platform really is: given, or drawn within what ``Truth`` allows.

    com        uniform in the box
    inertia_C  each moment J_ii (1 + e u), products J_ij (1 + e u) + 0.05 e u sqrt(J_ii J_jj),
               u uniform in (-1, 1), drawn again until some body can have it
    attitude   heading uniform, tilt uniform up to the given one or the stop, in any direction
    rate       each component uniform up to the limit

What is given does not change what is drawn for the rest. The errors are laid on the inertia about
the centre of mass, as a drawn centre of mass would otherwise be paid for by the inertia.
"""

from dataclasses import dataclass, replace
from math import pi

import numpy as np

from equipoise.maths.attitude import exponential, from_euler321, level, multiply, tilt
from equipoise.model.arrays import Floats, Matrix3, Quaternion, Vector3
from equipoise.model.errors import InputError
from equipoise.model.mass_properties import MassProperties, from_centre, smallest_second_moment
from equipoise.model.testbed import SlidingMass, Testbed, TrueDrive, Truth
from equipoise.model.torque_terms import TERMS
from equipoise.model.units import DEG, in_si
from equipoise.simulation.surroundings.magnetic_field import TrueField, draw_field

DRIVE = ("gain", "axis", "backlash", "accuracy")  # of a mass, what its true drive may change
LITTLE = 0.05  # -, chosen: of the moments' geometric mean, what CAD may miss in a product
# Without a truth: the testbed's own body, let go by hand (chosen: as the preset sputnix).
SMALL_TILT = in_si(3.0, DEG)  # rad
SMALL_RATE = in_si(0.3, DEG)  # rad/s
ROUNDING = 1e-6  # rad, chosen: of angles in a file


@dataclass(frozen=True, slots=True, eq=False)
class SimulatedPlatform:
    """The platform as it really is at the start of the bench's clock."""

    body: MassProperties  # masses at home
    attitude: Quaternion
    rate: Vector3  # rad/s
    torque: Floats  # (19,) coefficients in the order of TERMS, SI
    masses: tuple[SlidingMass, ...]  # with the drives that they really have
    field: TrueField | None  # magnetic; None: not known
    truth: Truth  # as given: noise, faults, events and errors of sensors, of which nothing is drawn


def own_truth(testbed: Testbed) -> Truth:
    """Return the truth of a testbed that states none: its own body and a small random start."""
    com, zero = testbed.body.com, np.zeros(3)
    inertia_P = testbed.body.inertia_P
    return Truth(com, com, com, inertia_P, 0.0, None, SMALL_TILT, None, SMALL_RATE, {}, 0.0, 30.0,
                 zero)  # fmt: skip


def draw_inertia(inertia_C: Matrix3, error: float, rng: np.random.Generator) -> Matrix3:
    """Return an inertia wrong by up to ``error`` (relative) that a body can have, kg m^2."""
    size = np.sqrt(np.diag(inertia_C))
    little = LITTLE * (np.outer(size, size) - np.diag(size**2))
    while True:
        factor, offset = rng.uniform(-1.0, 1.0, (2, 3, 3))
        upper = np.triu(inertia_C * (1 + error * factor) + error * offset * little)
        drawn = upper + np.triu(upper, 1).T
        if smallest_second_moment(drawn) > 0:
            return drawn


def draw_attitude(up: Vector3, greatest: float, rng: np.random.Generator) -> Quaternion:
    """Return an attitude of any heading, tilted by up to ``greatest`` (rad) in any direction."""
    heading, direction = rng.uniform(-pi, pi, 2)
    tilt = rng.uniform(0.0, greatest)
    turn_N = exponential(np.array([0.0, 0.0, heading]))
    lean_N = exponential(tilt * np.array([np.cos(direction), np.sin(direction), 0.0]))
    return multiply(lean_N, multiply(turn_N, level(up)))


def given_attitude(euler: Vector3, testbed: Testbed) -> Quaternion:
    """Return the attitude of roll, pitch and yaw (rad); InputError for one beyond the stop."""
    q = from_euler321(*euler)
    lean = float(tilt(q, testbed.up))
    if lean > testbed.tilt_limit + ROUNDING:
        where = f"{testbed.source or testbed.name}: truth.attitude_deg"
        wanted = f"at most platform.tilt_limit_deg = {testbed.tilt_limit / DEG:.4g}, its stop"
        raise InputError(where, f"a tilt of {lean / DEG:.4g} deg", wanted)
    return q


def real_masses(
    stated: tuple[SlidingMass, ...], drives: tuple[TrueDrive, ...]
) -> tuple[SlidingMass, ...]:
    """Return the masses with the drives that they really have, as stated where none is given."""
    true = {
        drive.mass: {k: v for k in DRIVE if (v := getattr(drive, k)) is not None}
        for drive in drives
    }
    return tuple(replace(mass, **true.get(mass.name, {})) for mass in stated)


def coefficients(torque: dict[str, float]) -> Floats:
    """Return the torque coefficients in the order of TERMS; those not named are zero."""
    return np.array([torque.get(term, 0.0) for term in TERMS])


def draw_truth(testbed: Testbed, rng: np.random.Generator) -> SimulatedPlatform:
    """Return the platform that ``testbed.truth`` gives, with what it leaves open drawn."""
    truth = testbed.truth or own_truth(testbed)
    com = rng.uniform(truth.com_low, truth.com_high)
    attitude = draw_attitude(testbed.up, min(truth.tilt, testbed.tilt_limit), rng)
    rate = rng.uniform(-1.0, 1.0, 3) * truth.rate_limit
    inertia_C = draw_inertia(testbed.body.inertia_C, truth.inertia_error, rng)
    com = com if truth.com is None else truth.com
    body = from_centre(testbed.body.mass, com, inertia_C)
    if truth.inertia_P is not None:
        body = MassProperties(body.mass, com, truth.inertia_P)
    return SimulatedPlatform(
        body=body,
        attitude=attitude if truth.attitude is None else given_attitude(truth.attitude, testbed),
        rate=rate if truth.rate is None else truth.rate,
        torque=coefficients(dict(truth.torque)),
        masses=real_masses(testbed.masses, truth.drives),
        field=draw_field(testbed, rng),
        truth=truth,
    )
