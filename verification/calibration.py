"""Calibration of masses, gyro and camera: errors in stated sd, simulated and on MuJoCo's records.

Simulated: one rail 3 deg off in any direction with 5 % too much gain, one 1 deg off with 3 % too
little, a trusted one 2 deg off, all with backlash; a leaning camera and, where there is a gyro, one
that is turned. MuJoCo: the same rails as slide joints, the 5 % in the weight of the mass and the
3 % in its steps; a play that waits at each reversal until it is taken up.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from equipoise.estimation.calibration.calibration import CalibrateOptions, calibrate
from equipoise.io.testbed.presets import read_preset
from equipoise.maths.attitude import exponential, to_matrix
from equipoise.model.defects import CameraErrors, GyroErrors
from equipoise.model.estimate import NORMAL_95, Estimate
from equipoise.model.recording import Recording, Samples
from equipoise.model.testbed import AttitudeSensor, Gyro, SlidingMass, Testbed, TrueDrive, Truth
from equipoise.model.units import DEG, MM, PERCENT, UM
from equipoise.procedure.identification.calibrate import calibration_moves
from equipoise.simulation.carried_out import record
from tests.oracle import mujoco_bench as oracle
from verification.chance import nees_band, share_band
from verification.result import Result, Row, Spread, at_most, between, in_turn

Array = NDArray[np.float64]
STATED = 40  # seeds for which the claim is stated
COVER = (0.90, 0.99)
OFF = (3.0, 1.0, 2.0)  # deg
GAIN = (1.05, 0.97, 1.0)
PLUMB = np.array([0.2, -0.1, 0.0]) * DEG
TURN = np.array([1.0, -2.0, 0.5]) * DEG
LOW, HIGH = np.array([-15.0, -15.0, -120.0]) * UM, np.array([15.0, 15.0, -70.0]) * UM


@dataclass(frozen=True, slots=True)
class Bench:
    """A testbed and which of its masses are calibrated; the last is trusted."""

    preset: str
    masses: tuple[str, str, str]
    backlash: float  # m


SPUTNIX = Bench("sputnix", ("x1", "y1", "z1"), 0.6e-3)
UNB = Bench("unb", ("x", "y", "z"), 0.05e-3)


class Found(NamedTuple):
    """One record calibrated."""

    z: Array  # errors in stated sd
    square: float  # NEES of all
    names: tuple[str, ...]
    sd: Array
    usable: bool


def aside(axis: Array, degrees: float, rng: np.random.Generator) -> Array:
    """Return a rail turned in any direction."""
    about = np.cross(axis, rng.normal(size=3))
    return to_matrix(exponential(degrees * DEG * about / np.linalg.norm(about))) @ axis


def wrong_drives(bench: Bench, masses: Sequence[SlidingMass], seed: int) -> tuple[TrueDrive, ...]:
    """Return what the drives really are."""
    rng = np.random.default_rng([seed, 7])
    return tuple(
        TrueDrive(m.name, g, aside(m.axis, off, rng), bench.backlash)
        for m, g, off in zip(masses, GAIN, OFF, strict=True)
    )


def simulated_bench(bench: Bench, seed: int) -> Testbed:
    """Return a testbed whose masses and sensors are not as stated."""
    testbed = read_preset(bench.preset)
    masses = [testbed.mass_named(name) for name in bench.masses]
    assert testbed.truth is not None
    truth: Truth = replace(
        testbed.truth,
        com_low=LOW,
        com_high=HIGH,
        drives=wrong_drives(bench, masses, seed),
        camera=CameraErrors(plumb=PLUMB),
        gyro=GyroErrors(turn=TURN if testbed.gyro else np.zeros(3)),
    )
    return replace(testbed, truth=truth)


def true_values(drives: Sequence[TrueDrive], masses: Sequence[SlidingMass]) -> dict[str, float]:
    """Return what a calibration should say of drives and camera."""
    found: dict[str, float] = {}
    for drive, mass in zip(drives, masses, strict=True):
        assert drive.gain is not None
        assert drive.axis is not None
        assert drive.backlash is not None
        found[f"gain_{mass.name}"] = drive.gain
        found[f"backlash_{mass.name}"] = drive.backlash
        for letter, component in zip("xyz", drive.axis, strict=True):
            found[f"axis_{mass.name}_{letter}"] = component
    return found | {"plumb_x": PLUMB[0], "plumb_y": PLUMB[1]}


def judged(found: Estimate, truth: dict[str, float]) -> Found:
    """Return errors in stated sd; of an axis the two components across it count."""
    names = [name for name in truth if found.has(name) and has_error(found, name)]
    at = [found.index(name) for name in names]
    error = np.array([found.parameters[i].value - truth[n] for i, n in zip(at, names, strict=True)])
    spread = found.covariance[np.ix_(at, at)]
    sd = np.sqrt(np.diag(spread))
    square = float(error @ np.linalg.solve(spread, error))
    return Found(error / sd, square, tuple(names), sd, found.outcome.usable)


def has_error(found: Estimate, name: str) -> bool:
    """Say whether a value was sought, and is not the long component of an axis."""
    parameter = found.parameters[found.index(name)]
    if name.startswith("axis_") and abs(parameter.value) > 0.5:
        return False
    return parameter.observable and parameter.sd > 0


def calibrated(bench: Bench, seed: int) -> Found:
    """Simulate the moves that are recommended, and calibrate by them."""
    testbed = simulated_bench(bench, seed)
    moves, duration = calibration_moves(testbed, bench.masses)
    found = calibrate(record(testbed, duration, moves, seed), testbed,
                      CalibrateOptions(bench.masses[-1:]))  # fmt: skip
    masses = [testbed.mass_named(name) for name in bench.masses]
    truth = true_values(wrong_drives(bench, masses, seed), masses)
    if testbed.gyro is not None:
        truth |= {f"gyro_turn_{a}": v for a, v in zip("xyz", TURN, strict=True)}
    return judged(found, truth)


# --- MuJoCo ---------------------------------------------------------------------------------------

STEPS = (1.0, 0.97, 1.0)  # travel over command: of the 5 % all is weight, of the 3 % all is steps
PLAY = 0.3e-3  # m, of command
ACCURACY = 0.1e-3  # m
CAMERA = AttitudeSensor(10.0, 0.1 * DEG)
GYRO = Gyro(50.0, 0.05 * DEG, 1.0 * DEG)


def with_play(command: Array, play: float) -> Array:
    """Return a column followed with a play, from its middle."""
    held, out = 0.0, np.empty_like(command)
    for i, carriage in enumerate(command):
        held = min(max(held, carriage - play / 2), carriage + play / 2)
        out[i] = held
    return out


def stated_bed(
    platform: oracle.Platform, rng: np.random.Generator
) -> tuple[Testbed, tuple[TrueDrive, ...]]:
    """Return the testbed that is stated of a platform, and what its drives really are."""
    bed = oracle.testbed_for(platform, rng, 0.10, CAMERA, GYRO, ACCURACY)
    masses = tuple(
        replace(m, mass=m.mass * step / gain, axis=aside(m.axis, off, rng), speed=0.01)
        for m, gain, step, off in zip(bed.masses, GAIN, STEPS, OFF, strict=True)
    )
    drives = tuple(
        TrueDrive(m.name, g, m.axis, PLAY) for m, g in zip(bed.masses, GAIN, strict=True)
    )
    return replace(bed, masses=masses), drives


def moved_by_mujoco(
    platform: oracle.Platform, testbed: Testbed, seed: int, among: tuple[str, ...]
) -> Recording:
    """Return the record of the recommended moves, with columns of commands."""
    rng = np.random.default_rng([seed, 9])
    moves, duration = calibration_moves(replace(testbed, tilt_limit=0.5), among)
    goals, ramps = np.zeros(3), list[oracle.Ramp]()
    for t, targets in moves:
        goals = goals.copy()
        for name, goal in targets.items():
            goals[testbed.mass_names.index(name)] = goal
        ramps.append(oracle.Ramp(t, goals, even=True))
    t = oracle.middles(duration, 1e-3)
    command = oracle.command(platform, tuple(ramps), t)
    wanted = np.column_stack([
        step * (with_play(column, PLAY) + stop_errors(column, rng))
        for step, column in zip(STEPS, command.T, strict=True)
    ])  # fmt: skip
    run = oracle.driven(platform, wanted, np.zeros((len(t), 3)))
    observed = oracle.sensor_log(run, rng, CAMERA.rate, CAMERA.noise, GYRO.rate, GYRO.noise)
    assert observed.attitude is not None
    assert observed.rate is not None
    turned = oracle.product(oracle.rotation(PLUMB)[None], observed.attitude.values)
    rows = np.arange(0, len(t), 20)
    return replace(
        observed,
        attitude=Samples(observed.attitude.t, turned),
        rate=Samples(observed.rate.t, observed.rate.values @ oracle.matrix(oracle.rotation(TURN))),
        masses=Samples(rows * 1e-3, oracle.command(platform, tuple(ramps), rows * 1e-3)),
    )


def stop_errors(command: Array, rng: np.random.Generator) -> Array:
    """Return an error of ACCURACY for each stop, one passing into the next with the travel."""
    still = np.append(np.diff(command) == 0, True)
    starts = np.flatnonzero(np.diff(still.astype(int)) != 0) + 1
    knots = np.concatenate([[0], starts, [len(command) - 1]])
    levels = np.zeros(len(knots))
    for k in range(2, len(knots) - 1, 2):
        levels[k : k + 2] = ACCURACY * rng.normal()
    return np.interp(np.arange(len(command)), knots, levels)


def by_mujoco(seed: int, among: tuple[str, ...] = ()) -> Found:
    """Calibrate all masses, or those named, by a record of MuJoCo's."""
    rng = np.random.default_rng([seed, 8])
    platform = oracle.random_platform(rng, 14.0, 1, 5 * DEG)
    testbed, drives = stated_bed(platform, rng)
    recording = moved_by_mujoco(platform, testbed, seed, among)
    found = calibrate(recording, testbed, CalibrateOptions(testbed.mass_names[-1:]))
    truth = true_values(drives, testbed.masses)
    truth |= {f"gyro_turn_{a}": v for a, v in zip("xyz", TURN, strict=True)}
    return judged(found, truth)


# --- what came of it ------------------------------------------------------------------------------


def rows_of(label: str, found: Sequence[Found]) -> list[Row]:
    """Return the rows of one kind of record."""
    z = np.concatenate([each.z for each in found])
    size = len(found[0].z)
    band = COVER if len(found) >= STATED else share_band(COVER, 0.95, len(found) * 3)
    low, high = nees_band(size, len(found), 0.999)
    nees = float(np.mean([each.square for each in found]))
    n = len(found)
    return [
        between(f"{label}, {n} seeds: 95 % intervals that hold the truth",
                float(np.mean(np.abs(z) < NORMAL_95)), band, ".1%"),
        between(f"{label}: mean NEES / {size}", nees / size, (low / size, high / size), ".2f"),
        at_most(f"{label}: not usable", sum(not each.usable for each in found), 0, "d"),
    ]  # fmt: skip


UNITS = {"gain": (PERCENT, "%"), "axis": (DEG, "deg"), "backlash": (MM, "mm"),
         "plumb": (DEG, "deg"), "gyro": (DEG, "deg")}  # fmt: skip


def sd_note(label: str, found: Sequence[Found]) -> str:
    """Return the sd reached, the median over seeds and parameters of a kind."""
    said: list[str] = []
    for kind, (size, unit) in UNITS.items():
        sd = [s for each in found for name, s in zip(each.names, each.sd, strict=True)
              if name.startswith(kind)]  # fmt: skip
        if sd:
            said.append(f"{kind} {float(np.median(sd)) / size:.2g} {unit}")
    return f"{label}: median sd: {', '.join(said)}."


def measure(seeds: Sequence[int], spread: Spread = in_turn) -> Result:
    """Calibrate by one record for each seed and bench."""
    kinds = {
        "sputnix (camera)": spread(partial(calibrated, SPUTNIX), seeds),
        "unb (camera and gyro)": spread(partial(calibrated, UNB), seeds),
        "MuJoCo (camera and gyro)": spread(by_mujoco, seeds),
    }
    rows = [row for label, found in kinds.items() for row in rows_of(label, found)]
    claim = (
        "From the recommended moves, with one mass trusted: a rail 3 deg off and a gain 5 % off, "
        "two others, backlash, the camera's lean and the gyro's turn are recovered within their "
        "stated intervals."
    )
    notes = tuple(sd_note(label, found) for label, found in kinds.items())
    return Result("calibration", claim, tuple(rows), notes)
