"""What inputs that were stated or reported, not measured in the record, add to the covariance.

A platform's mass, momenta and mountings of wheels and gyros, gravity, clocks: each is off by some
sd. One that gives the scale, alone, shows in no residual, so it is not sought but carried (a
"considered" parameter; Schmidt 1966). With A the information of the fit and b the descent of its
cost, an input p off by one sd s moves the optimum by

    dx = A^-1 db/dp s,         covariance + sum over inputs of dx dx^T

db/dp is the difference quotient of b at the optimum, in so small a step that curvature is nothing:
that would shift what is known far worse than all else, such as a scale. What follows from the
estimate and the input together (the centre of mass at the end, masses where they stand) takes both
ways.

Masses that travel on rails are sought instead, each with its sd as prior (``drive_errors``): three
of them contradict each other. One that stands still off home is carried.

A mass that is measured in steps stands between these, at home, too: all its rows are off by as much
as it stops inaccurately. It may sway there, by gravity or spin, and no row says so.

Each device turns its own part h of the known momentum, or torque:

    gain      dh = s h              mounting      dh = s e_i x h,   i = x, y, z

A clock that is slow stretches time from the beginning of the record: that of the camera, or of a
gyro alone, all channels; that of a gyro beside a camera its own rows, unless a survey found it.

Cannot see errors of inputs within the record, such as a wheel's friction; nor that two inputs that
are carried contradict each other, which would tell more of either: intervals are then too wide.
"""

from collections.abc import Iterator
from dataclasses import replace
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from equipoise.actuators.drive_errors import drive_names
from equipoise.actuators.stops import changing_rows, is_logged_in_steps
from equipoise.actuators.stored_momentum import known_torque, stored_momentum
from equipoise.estimation.output_error.problem import Problem, reposed
from equipoise.estimation.output_error.solution import Fitted, evaluate
from equipoise.estimation.parameters.fit_parameters import physical
from equipoise.maths.linalg import inverse_where
from equipoise.model import sensor_terms
from equipoise.model.arrays import Floats, Matrix3
from equipoise.model.devices import Device
from equipoise.model.recording import Recording, Samples
from equipoise.model.testbed import SlidingMass, Testbed
from equipoise.sensors.vector_sensors import CHANNELS as VECTORS

STEP = 1e-6  # sd, chosen: curvature of b counts for nothing, and rounding does not yet
AXES = np.eye(3)
GYRO_CLOCK = "gyro clock"


class Varied(NamedTuple):
    """What is given when one input is off by a part of its sd."""

    name: str
    sd: float
    recording: Recording
    testbed: Testbed
    axis: str = ""  # about which it turns, of a mounting


class InputEffect(NamedTuple):
    """What an input that is off by one sd changes at an optimum."""

    name: str
    axis: str
    descent: Floats  # (n,) of the cost, in physical coordinates
    direct: Floats  # (n,) the point itself in physical coordinates: J_P of a heavier body
    varied: Fitted  # the same point, the input off by ``STEP``


class InputShift(NamedTuple):
    """How an input that is off by one sd moves the optimum."""

    name: str
    shift: Floats  # (n,) in physical coordinates
    varied: Fitted


def with_scaled(recording: Recording, name: str, share: float) -> Recording:
    """Return the recording with the values of a channel a share larger, if it has that channel."""
    channel: Samples | None = getattr(recording, name)
    if channel is None:
        return recording
    return replace(recording, **{name: replace(channel, values=channel.values * (1 + share))})


def stretched(channel: Samples | None, start: float, share: float) -> Samples | None:
    """Return a channel whose clock was slower by a share since ``start`` (s)."""
    return (
        None if channel is None else replace(channel, t=start + (channel.t - start) * (1 + share))
    )


def weight_of(mass: SlidingMass) -> str:
    """Return the name of a mass on a rail as an input."""
    return f"mass {mass.name}"


def sought_weights(problem: Problem) -> dict[str, int]:
    """Return the inputs that are unknowns of the fit, each with its coordinate in the layout."""
    names = [(weight_of(mass), drive_names(mass.name).gain) for mass in problem.testbed.masses]
    errors, first = problem.layout.errors, problem.layout.mass_errors.start
    found = {name: first + errors.index(gain) for name, gain in names if gain in errors}
    if sensor_terms.GYRO_CLOCK in problem.layout.sensor:
        found[GYRO_CLOCK] = problem.layout.names.index(sensor_terms.GYRO_CLOCK)
    return found


def platform_varied(recording: Recording, testbed: Testbed) -> Iterator[Varied]:
    """Yield mass, gravity, masses on rails, and momentum and torque that no device explains."""
    body, masses = testbed.body, testbed.masses
    heavier = replace(body, mass=body.mass * (1 + STEP * testbed.mass_sd))
    yield Varied("platform mass", testbed.mass_sd, recording, replace(testbed, body=heavier))
    stronger = testbed.gravity * (1 + STEP * testbed.gravity_sd)
    yield Varied("gravity", testbed.gravity_sd, recording, replace(testbed, gravity=stronger))
    for i, mass in enumerate(masses):
        if not mass.mass_sd > 0:
            continue
        other = replace(mass, mass=mass.mass * (1 + STEP * mass.mass_sd))
        rest = replace(testbed, masses=(*masses[:i], other, *masses[i + 1 :]))
        yield Varied(weight_of(mass), mass.mass_sd, recording, rest)
    if recording.devices is None:
        for name, sd in (("momentum", testbed.momentum_sd), ("torque", testbed.torque_sd)):
            yield Varied(name, sd, with_scaled(recording, name, STEP * sd), testbed)


def places_varied(recording: Recording, testbed: Testbed) -> Iterator[Varied]:
    """Yield where masses stand that are logged in steps, home among them: between these."""
    rows = recording.masses
    if rows is None:
        return
    for i in logged_in_steps(changing_rows(rows), testbed.masses):
        mass = testbed.masses[i]
        aside = rows.values + STEP * mass.accuracy * np.eye(len(testbed.masses))[i]
        other = replace(recording, masses=Samples(rows.t, aside))
        yield Varied(f"position of mass {mass.name}", mass.accuracy, other, testbed)


@lru_cache(maxsize=2)  # asked to either side; by identity
def logged_in_steps(rows: Samples, masses: tuple[SlidingMass, ...]) -> tuple[int, ...]:
    """Return which masses are logged in steps."""
    columns = zip(rows.values.T, masses, strict=True)
    return tuple(i for i, (d, mass) in enumerate(columns) if is_logged_in_steps(rows.t, d, mass))


def by_gyros_clock(recording: Recording, share: float) -> Recording:
    """Return the recording with the clock of gyro and sensors of vectors slower by a share."""
    start, _ = recording.span
    names = ("rate", *VECTORS)
    late = {name: stretched(getattr(recording, name), start, share) for name in names}
    return replace(recording, **late)


def clocks_varied(recording: Recording, testbed: Testbed) -> Iterator[Varied]:
    """Yield the record's clock, and that of a gyro beside a camera; vectors are on the gyro's."""
    start, _ = recording.span
    camera = recording.attitude
    first = testbed.gyro if camera is None else testbed.attitude
    if first is not None:
        share = -STEP * first.clock_sd  # a gyro's row at a corner stays behind it, where it counts
        kept = recording if camera is not None else by_gyros_clock(recording, share)
        yield Varied("clock", first.clock_sd, replace(
            kept,
            attitude=stretched(camera, start, share),
            masses=stretched(recording.masses, start, share),
            momentum=stretched(recording.momentum, start, share),
            torque=stretched(recording.torque, start, share),
        ), testbed)  # fmt: skip
    if camera is not None and testbed.gyro is not None:
        gyro_clock = testbed.gyro.clock_sd
        yield Varied(GYRO_CLOCK, gyro_clock, by_gyros_clock(recording, STEP * gyro_clock), testbed)


def alone(testbed: Testbed, device: Device) -> Testbed:
    """Return the testbed with one of its devices only."""
    return replace(
        testbed,
        wheels=tuple(each for each in testbed.wheels if each is device),
        cmgs=tuple(each for each in testbed.cmgs if each is device),
        magnetorquers=tuple(each for each in testbed.magnetorquers if each is device),
        jets=tuple(each for each in testbed.jets if each is device),
    )


def turned_by(part: Samples | None, whole: Samples | None, matrix: Matrix3) -> Samples | None:
    """Return a known input with M h more, h the part of it that one device gives."""
    if part is None or whole is None:
        return whole
    return replace(whole, values=whole.values + part.values @ matrix.T)


def changes_of(gain_sd: float, mounting_sd: float) -> list[tuple[str, float, str, Matrix3]]:
    """Return gain and mounting, each with its sd, an axis, and the matrix M of its change M h."""
    turned = zip("xyz", (np.cross(axis, AXES).T for axis in AXES), strict=True)
    gain = ("gain", gain_sd, "", AXES)
    return [gain, *(("mounting", mounting_sd, axis, turn) for axis, turn in turned)]


def devices_varied(recording: Recording, testbed: Testbed) -> Iterator[Varied]:
    """Yield gain and mounting of each device, by its part of the known momentum and torque."""
    if recording.devices is None:
        return
    for device in (*testbed.wheels, *testbed.cmgs, *testbed.magnetorquers, *testbed.jets):
        single = alone(testbed, device)
        h, tau = stored_momentum(recording, single), known_torque(recording, single)
        for what, sd, axis, matrix in changes_of(device.gain_sd, device.mounting_sd):
            momentum = turned_by(h, recording.momentum, STEP * sd * matrix)
            torque = turned_by(tau, recording.torque, STEP * sd * matrix)
            driven = replace(recording, momentum=momentum, torque=torque)
            yield Varied(f"{what} of {device.name}", sd, driven, testbed, axis)


def cage_varied(recording: Recording, testbed: Testbed) -> Iterator[Varied]:
    """Yield gain and mounting of each coil pair of a cage, by what coils on the platform feel.

    Its field deviates by up to the stated share within the working volume: of one sd, a third of
    that squared (uniform). Where the field was measured, nothing of this counts.
    """
    measured = recording.field is not None and len(recording.field)
    if recording.devices is None or recording.torque is None or measured:
        return
    pairs, stated = testbed.coil_pairs, known_torque(recording, testbed)
    for i, pair in enumerate(pairs):
        gain_sd = float(np.hypot(pair.gain_sd, pair.nonuniformity / 3**0.5))
        for what, sd, axis, matrix in changes_of(gain_sd, pair.mounting_sd):
            other = replace(pair, axis_N=pair.axis_N + STEP * sd * matrix @ pair.axis_N)
            bent = replace(testbed, coil_pairs=(*pairs[:i], other, *pairs[i + 1 :]))
            torque = known_torque(recording, bent)
            if torque is not None and stated is not None:
                more = recording.torque.values + torque.values - stated.values
                driven = replace(recording, torque=replace(recording.torque, values=more))
                yield Varied(f"{what} of {pair.name}", sd, driven, testbed, axis)


def variations(problem: Problem) -> Iterator[Varied]:
    """Yield every input that has an sd and is not sought, off by ``STEP``."""
    recording, testbed, sought = problem.recording, problem.testbed, sought_weights(problem)
    for inputs in (platform_varied, places_varied, clocks_varied, devices_varied, cage_varied):
        for varied in inputs(recording, testbed):
            if varied.sd > 0 and varied.name not in sought:
                yield varied


def input_effects(fitted: Fitted) -> list[InputEffect]:
    """Return what each input changes at a fit; the same inputs in any record of a testbed."""
    problem, layout = fitted.problem, fitted.problem.layout
    values = physical(fitted.point, problem.mass, layout)
    found: list[InputEffect] = []
    for more in variations(problem):
        if more.recording is problem.recording and more.testbed is problem.testbed:
            none = np.zeros(layout.size)  # the record has nothing of it
            found.append(InputEffect(more.name, more.axis, none, none, fitted))
            continue
        other = reposed(problem, more.recording, more.testbed)
        at = replace(fitted, problem=other, at=evaluate(other, fitted.point, fitted.jumps))
        moved = (at.at.descent - fitted.at.descent) / STEP
        direct = (physical(fitted.point, at.problem.mass, layout) - values) / STEP
        found.append(InputEffect(more.name, more.axis, moved, direct, at))
    return found


def input_shifts(fitted: Fitted) -> tuple[InputShift, ...]:
    """Return how each input moves the optimum of a fit, where it does.

    Of the optimum with all priors, the anchor's too: without it what the data leave open would move
    without bound.
    """
    covariance = inverse_where(fitted.at.normal, ~fitted.problem.prior.held)
    every = [
        InputShift(each.name, each.direct + covariance @ each.descent, each.varied)
        for each in input_effects(fitted)
    ]
    return tuple(s for s in every if np.any(s.shift) and np.all(np.isfinite(s.shift)))
