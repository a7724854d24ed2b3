"""Records of a simulated platform with modes, a mass of which moves once."""

from dataclasses import replace

import numpy as np

from equipoise.estimation.events.record_model import RecordModel
from equipoise.estimation.output_error.trajectory import Params, fit
from equipoise.model.mass_properties import MassProperties
from equipoise.model.modes import Mode
from equipoise.model.recording import Recording, joined
from equipoise.model.testbed import AttitudeSensor, Gyro, SlidingMass, Testbed, Truth
from equipoise.simulation.bench import SimulatedBench

INERTIA = np.array([[0.45, 0.01, -0.02], [0.01, 0.5, 0.015], [-0.02, 0.015, 0.62]])
COM = np.array([20e-6, -15e-6, -150e-6])
MOVED = 15.0  # s


def modal_testbed(*modes: Mode) -> Testbed:
    """Return a testbed of 14 kg with one sliding mass, a camera and a gyro."""
    level = np.zeros(3)
    attitude, rate = np.radians([4.0, -2.0, 30.0]), np.radians([0.6, -0.4, 1.2])
    truth = Truth(
        COM, COM, COM, INERTIA, 0.0, attitude, 0.0, rate, 0.0, {}, 0.0, 30.0, level, modes=modes
    )
    guess = MassProperties(14.0, np.array([0.0, 0.0, -1e-4]), np.diag([0.5, 0.5, 0.6]))
    rail = SlidingMass("x", 0.3, np.array([0.0, 0.2, 0.0]), np.array([1.0, 0.0, 0.0]),
                       (-0.05, 0.05), 0.0, 1e-6, 0.0, 0.01)  # fmt: skip
    return Testbed(
        "modal", guess, 0.1, np.full(3, 1e-4), np.array([0.0, 0.0, 1.0]), np.pi, 9.81,
        masses=(rail,), attitude=AttitudeSensor(10.0, np.radians(0.02)),
        gyro=Gyro(50.0, np.radians(0.01), 0.0), truth=truth,
    )  # fmt: skip


def modal_record(
    seed: int, *modes: Mode, span: float = 45.0
) -> tuple[Recording, Testbed, SimulatedBench]:
    """Return a record of so many seconds, its testbed and its bench."""
    testbed = modal_testbed(*modes)
    bench = SimulatedBench(testbed, seed)
    first = bench.read(MOVED)
    bench.move({"x": 0.0006})
    return joined([first, bench.read(span - MOVED)]), replace(testbed, truth=None), bench


def rigid_model(recording: Recording, testbed: Testbed) -> RecordModel:
    """Return the plain fit of a record as a model, without cuts."""
    params = Params()
    fitted = fit(recording, testbed, params)
    return RecordModel(recording, testbed, params, np.zeros(0), np.zeros(3), (), fitted, testbed)
