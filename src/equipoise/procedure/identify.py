"""Identify: from a recording to mass properties, coarse to fine, as Steps.

What the record allows decides: rest positions, if there are any, give a first centre of mass; the
linear momentum integral a first inertia; the trajectory fit, which does not need either, the
answer. A single method can be asked for instead.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from equipoise.actuators.sliding_masses import com_shift, mass_maps
from equipoise.estimation import equilibrium, momentum, reference, tracker, trajectory
from equipoise.maths.linalg import pack_symmetric
from equipoise.model import sensor_terms, torque_terms
from equipoise.model.arrays import Vector3
from equipoise.model.errors import InputError, nearest
from equipoise.model.estimate import COM, END, INERTIA, Estimate, Parameter
from equipoise.model.outcome import Outcome
from equipoise.model.recording import Recording, arranged
from equipoise.model.step import Step
from equipoise.model.testbed import Testbed
from equipoise.procedure.sound_rows import sound


@dataclass(frozen=True, slots=True, eq=False)
class IdentifyOptions:
    """What is asked for."""

    method: str = "auto"
    terms: tuple[str, ...] = ()  # torques to estimate, beside the testbed's own
    hold: tuple[str, ...] = ()  # parameters kept at the testbed's value
    use_prior: bool = False  # the testbed's inertia and centre of mass as priors
    robust: bool = False


Method = Callable[[Recording, Testbed, IdentifyOptions], Estimate]


def terms_of(testbed: Testbed, options: IdentifyOptions) -> tuple[str, ...]:
    """Return the torques to estimate, each once."""
    return tuple(dict.fromkeys((*testbed.disturbances, *options.terms)))


def split(terms: tuple[str, ...]) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Return the torques and the sensors' terms among these, each in the package's order."""
    return torque_terms.among(terms), sensor_terms.among(terms)


def by_trajectory(recording: Recording, testbed: Testbed, options: IdentifyOptions) -> Estimate:
    """Maximum likelihood."""
    torques, sensors = split(terms_of(testbed, options))
    params = trajectory.Params(
        torques, sensors, use_prior=options.use_prior, hold=options.hold, robust=options.robust
    )
    return reference.estimate(recording, testbed, params)


def by_momentum_body(recording: Recording, testbed: Testbed, options: IdentifyOptions) -> Estimate:
    """Momentum integral in body axes."""
    return momentum.estimate(recording, testbed, "body", split(terms_of(testbed, options))[0])


def by_momentum_laboratory(
    recording: Recording, testbed: Testbed, options: IdentifyOptions
) -> Estimate:
    """Momentum integral in laboratory axes."""
    return momentum.estimate(recording, testbed, "laboratory", split(terms_of(testbed, options))[0])


def by_equilibrium(recording: Recording, testbed: Testbed, options: IdentifyOptions) -> Estimate:
    """Rest positions."""
    return equilibrium.estimate(recording, testbed)


def shift_at_end(recording: Recording, testbed: Testbed) -> Vector3:
    """Return what the masses, as they stand at the end, do to the centre of mass (m)."""
    if recording.masses is None:
        return np.zeros(3)
    last = recording.masses.values[-1]
    return com_shift(mass_maps(testbed.masses), testbed.body.mass, last)


def by_tracker(recording: Recording, testbed: Testbed, options: IdentifyOptions) -> Estimate:
    """Kalman filter from what the testbed says; the belief after the last row.

    After a move the centre of mass is that of the masses as they stand: where they really stopped
    is part of it.
    """
    if recording.attitude is None or len(recording.attitude) < 2:
        outcome = Outcome(False, "The tracker needs a camera: the record has no attitude.")
        return Estimate("tracker", outcome, (), np.zeros((0, 0)))
    recording, first = arranged(recording, testbed.mass_names), recording.attitude
    state = tracker.first_state(float(first.t[0]), first.values[0], testbed)
    track = tracker.track(recording, testbed, tracker.Params(), state)
    shift = shift_at_end(recording, testbed)
    belief = track.end.belief
    values = [*(belief.com + shift), *pack_symmetric(belief.inertia_P)]
    sds = np.sqrt(np.diag(belief.covariance))
    names = (*(END if shift.any() else COM), *INERTIA)
    units = ["m"] * len(COM) + ["kg m2"] * len(INERTIA)
    parameters = tuple(
        Parameter(name, unit, float(value), float(sd))
        for name, unit, value, sd in zip(names, units, values, sds, strict=True)
    )
    surprise = float(np.mean(track.surprise[len(track.t) // 4 :])) / 3
    fits = surprise < 1.5
    text = f"Tracked to the last row; innovations are {surprise:.2g} times what they should be"
    ending = "." if fits else ": inertia, noise or model are wrong, do not trust the interval."
    return Estimate("tracker", Outcome(fits, text + ending), parameters, belief.covariance)


METHODS: dict[str, Method] = {
    "trajectory": by_trajectory,
    "momentum_laboratory": by_momentum_laboratory,
    "momentum_body": by_momentum_body,
    "equilibrium": by_equilibrium,
    "tracker": by_tracker,
}
COARSE_TO_FINE = ("equilibrium", "momentum_laboratory", "trajectory")


def step_of(recording: Recording, estimate: Estimate) -> Step:
    """Return the step that reports an estimate."""
    sentence = f"{estimate.method}: {estimate.outcome.sentence}"
    return Step("estimate", recording.span[1], sentence, estimate=estimate)


def identify(recording: Recording, testbed: Testbed, options: IdentifyOptions) -> Iterator[Step]:
    """Yield a look, then one estimate for each method that the record allows; the last counts.

    Raises InputError for a method or a held parameter that does not exist.
    """
    if options.method not in ("auto", *METHODS):
        wanted = nearest(options.method, ["auto", *METHODS])
        raise InputError("method", f"'{options.method}'", wanted)
    start, end = recording.span
    yield Step("look", end, f"Read {end - start:.4g} s of recording.", recording=recording)
    recording, testbed = sound(recording, testbed)
    chosen = COARSE_TO_FINE if options.method == "auto" else (options.method,)
    for name in chosen:
        estimate = METHODS[name](recording, testbed, options)
        if estimate.parameters or name == chosen[-1]:
            yield step_of(recording, estimate)
