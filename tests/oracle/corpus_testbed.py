"""What a laboratory states of a platform of the corpus: every input off by a draw of its sd."""

from dataclasses import replace

import numpy as np

from equipoise.maths.linalg import pack_symmetric, unpack_symmetric
from equipoise.model.mass_properties import MassProperties, is_possible
from equipoise.model.testbed import AttitudeSensor, Gyro, SlidingMass, Testbed
from tests.oracle import mujoco_bench as oracle
from tests.oracle.corpus_choices import Choices, MassLog, Sensors, stream

GRAVITY = 9.81
SERVO = 100.0  # rad/s
QUANTUM = 2e-3  # m, of a log in steps
LIMIT = 0.06  # m, travel of a mass
MASS_SD, SLIDER_SD, GRAVITY_SD, CLOCK_SD = 0.01, 0.01, 5e-4, 5e-4  # relative
PLUMB_SD, BIAS_SD = np.radians(0.1), np.radians(0.5)  # rad; rad/s
INERTIA_SD, COM_SD = 0.15, 0.3  # relative


def _slider(drawn: Choices, slide: oracle.Slide) -> SlidingMass:
    """Return what is stated of a mass: how a log in its way may be off, one sd each."""
    step = QUANTUM if drawn.log is MassLog.STEPS else 0.0
    hangs = GRAVITY / SERVO**2 if drawn.log is MassLog.COMMAND else 0.0
    lag = {MassLog.LATE: 0.06, MassLog.COMMAND: 0.03}.get(drawn.log, 0.0)
    return SlidingMass(
        slide.name, slide.mass, slide.home, slide.axis, (-LIMIT, LIMIT), step, 0.3 * step, 0.0,
        drawn.speed, lag, hangs, mass_sd=SLIDER_SD,
    )  # fmt: skip


def exact_testbed(drawn: Choices, platform: oracle.Platform) -> Testbed:
    """Return the testbed with all values true."""
    camera = AttitudeSensor(
        drawn.camera_hz, float(np.radians(drawn.camera_deg)), clock_sd=CLOCK_SD, plumb_sd=PLUMB_SD
    )
    gyro = Gyro(drawn.gyro_hz, float(np.radians(drawn.gyro_deg_s)), BIAS_SD, clock_sd=CLOCK_SD)
    return Testbed(
        "corpus",
        MassProperties(platform.mass, platform.com, platform.inertia_P),
        INERTIA_SD,
        np.full(3, COM_SD * float(np.linalg.norm(platform.com))),
        np.array([0.0, 0.0, 1.0]),
        float(np.radians(60.0)),
        platform.gravity,
        tuple(_slider(drawn, slide) for slide in platform.slides),
        None if drawn.sensors is Sensors.GYRO else camera,
        None if drawn.sensors is Sensors.CAMERA else gyro,
        ("viscous_x", "viscous_y", "viscous_z") if drawn.drag else (),
        mass_sd=MASS_SD,
        gravity_sd=GRAVITY_SD,
    )


def stated_body(rng: np.random.Generator, exact: Testbed) -> MassProperties:
    """Return a possible body that errs as the testbed's sd say."""
    true = exact.body
    moments = np.diag(true.inertia_P)
    sizes = np.sqrt(pack_symmetric(np.outer(moments, moments)))
    for _ in range(10_000):
        six = pack_symmetric(true.inertia_P) + INERTIA_SD * sizes * rng.normal(size=6)
        mass = true.mass * (1 + MASS_SD * rng.normal())
        com = true.com + exact.com_sd * rng.normal(size=3)
        found = MassProperties(mass, com, unpack_symmetric(six))
        if is_possible(found):
            return found
    raise RuntimeError(f"no possible body within {INERTIA_SD:.0%} of {moments} kg m^2")


def stated_testbed(drawn: Choices, exact: Testbed) -> Testbed:
    """Return the testbed as the laboratory has it: every input off by a draw of its sd."""
    rng = stream(drawn.seed, 7)
    masses = tuple(replace(m, mass=m.mass * (1 + SLIDER_SD * rng.normal())) for m in exact.masses)
    return replace(exact, body=stated_body(rng, exact), gravity=GRAVITY, masses=masses)
