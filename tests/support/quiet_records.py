"""Records of a platform that hardly moves, as a nearly balanced one does; made by MuJoCo.

2.7 kg, moments of 25 to 31 g m2, centre of mass 20 to 200 um below P and 2 um aside; it spins about
the vertical and tilts by some degrees. Every second seed has a camera that leans, by 0.2 deg (sd).
"""

from dataclasses import dataclass, replace

import numpy as np
from scipy.signal import lfilter

from equipoise.estimation.output_error.problem import element_sizes
from equipoise.maths.linalg import pack_symmetric, unpack_symmetric
from equipoise.model.mass_properties import MassProperties, is_possible
from equipoise.model.recording import Recording, Samples, window
from equipoise.model.testbed import AttitudeSensor, Testbed
from equipoise.model.units import MINUTE
from equipoise.procedure.identification.assess import AssessOptions, Fit, fit_of
from tests.oracle import mujoco_bench as oracle

MOMENTS, PRODUCT = np.array([0.028, 0.025, 0.031]), 3e-4  # kg m^2
LEAN = np.radians(0.2)
STEP, MEMORY = 5e-3, 3.0  # s


@dataclass(frozen=True, eq=False)
class Quiet:
    """Two minutes of one platform, and what a laboratory knows of it."""

    platform: oracle.Platform
    record: Recording
    testbed: Testbed  # inertia drawn about the truth, as its sd says

    @property
    def known(self) -> Testbed:
        """Return the testbed with the truth for its body."""
        truth = self.platform
        return replace(self.testbed, body=MassProperties(truth.mass, truth.com, truth.inertia_P))

    @property
    def minutes(self) -> tuple[Recording, Recording]:
        """Return the two minutes, each a record of its own."""
        return (window(self.record, 0.0, MINUTE), window(self.record, MINUTE, 2 * MINUTE))


def body(rng: np.random.Generator, spin: float) -> oracle.Platform:
    """Return a platform that spins at ``spin`` (rad/s)."""
    upper = np.triu(rng.uniform(-PRODUCT, PRODUCT, (3, 3)), 1)
    inertia = np.diag(MOMENTS * rng.uniform(0.95, 1.05, 3)) + upper + upper.T
    com = np.array([*rng.uniform(-2e-6, 2e-6, 2), -rng.uniform(20e-6, 200e-6)])
    way, heading = rng.uniform(0, 2 * np.pi, 2)
    tilt = np.radians(rng.uniform(0.5, 2.0))
    lean = oracle.rotation(tilt * np.array([np.cos(way), np.sin(way), 0.0]))
    q = oracle.product(lean, oracle.rotation(np.array([0.0, 0.0, heading])))
    swing = np.radians(rng.uniform(-0.3, 0.3, 2))
    rate = oracle.matrix(q).T @ np.array([*swing, spin])
    return oracle.Platform(2.7, inertia, com, (), 9.81, q, rate)


def guess(rng: np.random.Generator, platform: oracle.Platform, sd: float) -> MassProperties:
    """Return an inertia that errs as a prior of this relative sd says, centred."""
    six = pack_symmetric(platform.inertia_P)
    for _ in range(1000):
        drawn = six + sd * element_sizes(platform.inertia_P) * rng.normal(size=6)
        found = MassProperties(platform.mass, np.zeros(3), unpack_symmetric(drawn))
        if is_possible(found):
            return found
    raise RuntimeError("no possible inertia drawn")


def leaning(record: Recording, lean: np.ndarray) -> Recording:
    """Return a record as a camera shows it whose vertical leans by a rotation vector (rad)."""
    attitude = record.attitude
    turned = oracle.product(oracle.rotation(lean), attitude.values)
    return replace(record, attitude=Samples(attitude.t, turned))


def wandering(seed: int, size: float) -> np.ndarray:
    """Return a torque in laboratory axes, N m, of this rms and ``MEMORY``, at every step."""
    steps, keep = len(oracle.middles(2 * MINUTE, STEP)), np.exp(-STEP / MEMORY)
    white = np.random.default_rng([36, seed]).normal(0.0, size, (steps, 3))
    return lfilter([np.sqrt(1 - keep**2)], [1.0, -keep], white, axis=0)


def quiet(
    seed: int,
    spin_deg_s: float | None = None,
    inertia_sd: float = 0.05,
    drag: float = 0.0,
    torque: float = 0.0,
) -> Quiet:
    """Return two minutes of a camera of 10 Hz and 0.05 deg; spin of 10 to 60 deg/s unless given.

    With drag (N m s, about each axis) and a torque that wanders (N m, rms).
    """
    rng = np.random.default_rng([35, seed])
    drawn = rng.choice([-1.0, 1.0]) * rng.uniform(10.0, 60.0)
    platform = body(rng, np.radians(drawn if spin_deg_s is None else spin_deg_s))
    platform = replace(platform, viscous=np.full(3, drag))
    wander = wandering(seed, torque)
    run = oracle.driven(platform, np.zeros((len(wander), 0)), wander, STEP)
    camera = AttitudeSensor(10.0, np.radians(0.05))
    record = oracle.sensor_log(run, rng, camera.rate, camera.noise)
    record = replace(record, masses=None, mass_names=())
    if seed % 2:
        record = leaning(record, np.array([*rng.normal(0.0, LEAN, 2), 0.0]))
    testbed = replace(
        oracle.testbed_for(platform, rng, inertia_sd, camera),
        body=guess(rng, platform, inertia_sd),
    )
    return Quiet(platform, record, testbed)


def lowered(record: Recording, testbed: Testbed, options: AssessOptions) -> Fit:
    """Return the fit of a record with its centre of mass a fifth lower: wrong, and not said."""
    estimate, (parameters, covariance) = fit_of(record, testbed, options)
    standing = estimate.standing[2]
    lower = tuple(replace(p, value=1.2 * p.value) if p.name == standing else p for p in parameters)
    return replace(estimate, parameters=lower, covariance=covariance), (lower, covariance)
