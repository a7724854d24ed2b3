"""A whole recording of a simulated bench whose masses move and devices work at given times.

A planned manoeuvre starts with a hand that lets go nearly as planned:

    tilt    the planned lean, with a normal error about each level axis; any heading
    rate    the planned one, with a normal error of each component

The stop lets no hand lean the platform beyond its limit.

What the platform is like is drawn as without a plan; only its start is the plan's.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from equipoise.actuators.square_waves import inputs_along
from equipoise.maths.attitude import (
    exponential,
    leaning,
    multiply,
    tilted_at_most,
    to_euler321,
)
from equipoise.model.arrays import Quaternion, Vector3
from equipoise.model.bench import Bench
from equipoise.model.errors import InputError
from equipoise.model.manoeuvre import Manoeuvre
from equipoise.model.recording import Recording, join
from equipoise.model.testbed import Testbed
from equipoise.simulation.bench import SimulatedBench
from equipoise.simulation.draw_truth import own_truth
from equipoise.simulation.free_start import freely
from equipoise.simulation.planar.planar_bench import PlanarBench

HAND = 9  # chosen: sets the hand's draws apart from the bench's own, which spawn from the seed
MadeBench = SimulatedBench | PlanarBench
Moves = Sequence[tuple[float, Mapping[str, float]]]


class Command(NamedTuple):
    """What a bench is commanded at a time (s): targets of masses (m), inputs of devices."""

    t: float
    targets: Mapping[str, float]
    inputs: Mapping[str, float]


def met_start(
    up: Vector3, manoeuvre: Manoeuvre, rng: np.random.Generator
) -> tuple[Quaternion, Vector3]:
    """Return attitude and rate (rad/s) with which a hand that tries to meet the plan lets go."""
    error = manoeuvre.tilt_sd * rng.standard_normal(3)
    level_error = error - (error @ up) * up
    heading = exponential(np.array([0.0, 0.0, rng.uniform(-np.pi, np.pi)]))
    q = multiply(leaning(up, manoeuvre.low_side, manoeuvre.tilt), exponential(level_error))
    return multiply(heading, q), manoeuvre.rate + manoeuvre.rate_sd * rng.standard_normal(3)


def let_go(testbed: Testbed, manoeuvre: Manoeuvre, seed: int) -> Testbed:
    """Return the testbed whose truth starts as a hand meets the plan."""
    rng = np.random.default_rng([seed, HAND])
    q, rate = met_start(testbed.up, manoeuvre, rng)
    q = tilted_at_most(q, testbed.up, testbed.tilt_limit)
    attitude = np.array([float(angle) for angle in to_euler321(q)])
    truth = replace(testbed.truth or own_truth(testbed), attitude=attitude, rate=rate)
    return replace(testbed, truth=truth)


def bench_for(testbed: Testbed, manoeuvre: Manoeuvre | None, seed: int) -> SimulatedBench:
    """Return a bench whose platform is let go as planned, if there is a plan."""
    if manoeuvre is None:
        return SimulatedBench(testbed, seed)
    return SimulatedBench(let_go(testbed, manoeuvre, seed), seed, manoeuvre.standing)


def planar_bench_for(testbed: Testbed, manoeuvre: Manoeuvre | None, seed: int) -> PlanarBench:
    """Return the same of a platform whose bearing floats over a table."""
    if manoeuvre is None:
        return PlanarBench(testbed, seed)
    return PlanarBench(let_go(testbed, manoeuvre, seed), seed, manoeuvre.standing)


def commands_of(manoeuvre: Manoeuvre) -> list[Command]:
    """Return all commands to a bench, in order of time."""
    moves = [Command(t, targets, {}) for t, targets in manoeuvre.moves]
    drives = [Command(t, {}, inputs)
              for t, inputs in inputs_along(manoeuvre.waves, manoeuvre.duration)]  # fmt: skip
    return sorted([*moves, *drives], key=lambda command: command.t)


def performed(
    testbed: Testbed, seed: int, manoeuvre: Manoeuvre | None, duration: float, moves: Moves = ()
) -> tuple[MadeBench, Recording]:
    """Return a simulated bench and what it records: of a manoeuvre, else of ``duration`` seconds.

    The latter with masses sent to targets (m) at times (s) in order; the platform is let go so that
    it meets no stop, where it can be.
    """
    if testbed.table is not None:
        floating = planar_bench_for(testbed, manoeuvre, seed)
        return floating, (
            recorded(floating, duration, moves)
            if manoeuvre is None
            else carried_out(floating, manoeuvre)
        )
    if manoeuvre is None:
        return freely(testbed, seed, lambda bench: recorded(bench, duration, moves))
    bench = bench_for(testbed, manoeuvre, seed)
    return bench, carried_out(bench, manoeuvre)


def simulated(testbed: Testbed, manoeuvre: Manoeuvre, seed: int) -> Recording:
    """Return what a simulated bench records of a manoeuvre."""
    return performed(testbed, seed, manoeuvre, manoeuvre.duration)[1]


def carried_out(bench: Bench, manoeuvre: Manoeuvre) -> Recording:
    """Return what a fresh bench records of a manoeuvre."""
    return commanded(bench, manoeuvre.duration, commands_of(manoeuvre))


def record(testbed: Testbed, duration: float, moves: Moves, seed: int) -> Recording:
    """Return the recording of a simulated bench without a manoeuvre (``performed``)."""
    return performed(testbed, seed, None, duration, moves)[1]


def recorded(bench: Bench, duration: float, moves: Moves) -> Recording:
    """Return the same of a bench that has not been read yet."""
    return commanded(bench, duration, [Command(t, targets, {}) for t, targets in moves])


def commanded(bench: Bench, duration: float, commands: Sequence[Command]) -> Recording:
    """Return ``duration`` seconds of a fresh bench that gets these commands in order."""
    recording = bench.read(0.0)
    for command in commands:
        if not bench.time <= command.t <= duration:
            wanted = f"times in order, from 0 to {duration:g} s"
            raise InputError("moves", f"one at {command.t:g} s", wanted)
        recording = join(recording, bench.read(command.t - bench.time))
        if command.targets:
            bench.move(command.targets)
        if command.inputs:
            bench.drive(command.inputs)
    return join(recording, bench.read(duration - bench.time))
