"""A slew by control moment gyros on a simulated platform, and all measurements of it.

The platform starts at rest at its truth's attitude and is brought to another by quaternion PID
(Lee et al. Eq. 2 with erratum L4, ``control.attitude_pid``); the gimbals are steered by the
singularity-robust inverse. The torque that the law requests and that of the gyros differ in a
singularity: both are kept, and the second, from measured gimbal angles, identifies the platform.
"""

from typing import NamedTuple

import numpy as np

from equipoise.actuators.cmg_steering import limited_rates, singularity_robust
from equipoise.actuators.control_moment_gyros import jacobian, singularity_measure
from equipoise.control.elements.attitude_pid import Gains, Pid, at_rest, torque, unwound
from equipoise.control.law import Sample
from equipoise.model.arrays import Floats, Quaternion, Series1, Series3, Series4
from equipoise.model.recording import Recording, joined
from equipoise.model.testbed import Testbed
from equipoise.procedure.steps.sampler import Eyes, opened, sample_of, sampled
from equipoise.simulation.bench import SimulatedBench

PERIOD = 0.05  # s, chosen: the loop's


class Slew(NamedTuple):
    """What happened, a row for each step of the loop."""

    t: Series1  # s
    q: Series4  # as filtered
    rate: Series3  # rad/s, as filtered
    angles: Floats  # (n, k) rad, of the gimbals, as measured
    rates: Floats  # (n, k) rad/s, commanded to the gimbals
    required: Series3  # N m, requested of the gyros on the platform
    output: Series3  # N m, -D angles', what the rates give
    measure: Series1  # -, 0 in a singularity
    recording: Recording


Row = tuple[float | Floats, ...]  # one step: what ``Slew`` has before its recording, in order


def slewed(testbed: Testbed, target: Quaternion, gains: Gains, duration: float, seed: int) -> Slew:
    """Return a slew to ``target`` of ``duration`` seconds."""
    bench, pid, rows = SimulatedBench(testbed, seed), unwound(), list[Row]()
    fresh = bench.read(PERIOD)
    parts, before = [fresh], opened(testbed)
    eyes = sampled(before, fresh, testbed)
    while bench.time < duration:
        observed = sample_of(before, eyes, fresh, testbed)
        assert observed is not None  # a camera's first row is at time zero
        pid, rates, row = stepped(testbed, eyes, observed, (pid, target, gains))
        rows.append(row)
        named = zip(testbed.cmgs, rates, strict=True)
        bench.drive({cmg.name: float(rate) for cmg, rate in named})
        fresh = bench.read(PERIOD)
        parts.append(fresh)
        before, eyes = eyes, sampled(eyes, fresh, testbed)
    return Slew(*(np.array(column) for column in zip(*rows, strict=True)), recording=joined(parts))


def stepped(
    testbed: Testbed, eyes: Eyes, sample: Sample, law: tuple[Pid, Quaternion, Gains]
) -> tuple[Pid, Floats, Row]:
    """Return the law's state, the gimbal rates (rad/s) and the row of one step."""
    pid, target, gains = law
    pid, required = torque(pid, sample, at_rest(target), gains, np.zeros(3))
    angles = eyes.states[len(testbed.wheels) :][: len(testbed.cmgs)]
    rates = limited_rates(testbed.cmgs, singularity_robust(testbed.cmgs, angles, required))
    output: Floats = -jacobian(testbed.cmgs, angles) @ rates
    measure = singularity_measure(testbed.cmgs, angles)
    row = (sample.t, sample.q, sample.rate, angles, rates, required, output, measure)
    return pid, rates, row
