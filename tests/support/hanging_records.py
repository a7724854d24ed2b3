"""A MuJoCo record of a platform with a pendulum, and what is true of it."""

from functools import lru_cache
from typing import NamedTuple

import numpy as np

from equipoise.estimation.events.record_model import RecordModel
from equipoise.estimation.model_selection.survey import cut_times
from equipoise.estimation.output_error.trajectory import Params, fit
from equipoise.model.hanging_mass import HangingMass
from equipoise.model.recording import Recording
from equipoise.model.testbed import AttitudeSensor, Gyro, Testbed
from tests.oracle import flexible_platform as flexible
from tests.oracle import mujoco_bench as oracle


class HangingRecord(NamedTuple):
    """What was recorded, and what is true."""

    recording: Recording
    testbed: Testbed
    platform: oracle.Platform
    mass: HangingMass


@lru_cache(maxsize=2)
def hanging_record(seed: int, span: float = 40.0) -> HangingRecord:
    """Return the record of so many seconds (s) of a platform with a pendulum of 10 um of sag."""
    rng = np.random.default_rng([seed, 51])
    platform = oracle.random_platform(rng, mass=14.0, masses_per_axis=1, tilt=np.radians(12))
    part = flexible.pendulum(rng, platform)
    ramp = oracle.Ramp(15.0, np.full(3, 0.004))
    run = flexible.simulate(platform, [part], (ramp,), span).run
    camera, noise = np.radians(0.02), np.radians(0.01)
    recording = oracle.sensor_log(run, rng, 10.0, camera, 50.0, noise)
    sensors = AttitudeSensor(10.0, camera), Gyro(50.0, noise, np.radians(0.1))
    testbed = oracle.testbed_for(platform, rng, attitude=sensors[0], gyro=sensors[1])
    return HangingRecord(recording, testbed, platform, mass_of(part, platform))


def mass_of(part: flexible.Part, platform: oracle.Platform) -> HangingMass:
    """Return a pendulum as a mass that hangs; its hinge is across the side to which it swings."""
    moment = part.mass * float(np.linalg.norm(part.arm))
    spring = part.stiffness / (part.stiffness + platform.gravity * moment)
    side = np.cross(part.axis, np.array([0.0, 0.0, 1.0]))
    heading = float(np.arctan2(side[1], side[0]))
    return HangingMass(moment / platform.mass * (1 - spring), heading, spring)


def plain_model(recording: Recording, testbed: Testbed) -> RecordModel:
    """Return the plain fit of a record as a model, with cuts."""
    params = Params()
    fitted = fit(recording, testbed, params)
    cuts = cut_times(recording)
    return RecordModel(recording, testbed, params, cuts, np.zeros(3), (), fitted, testbed)
