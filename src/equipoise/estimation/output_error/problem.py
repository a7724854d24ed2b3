"""A recording as a least-squares problem: residuals in units of their noise, and priors."""

from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from equipoise.actuators.drive_errors import on_rails, rails_of
from equipoise.actuators.lags import LAG
from equipoise.actuators.mass_errors import MassErrors, mass_errors
from equipoise.actuators.sliding_masses import MassMaps, mass_maps
from equipoise.actuators.stops import changing_rows
from equipoise.dynamics import sensitivities
from equipoise.dynamics.lamp_warmth import temperature_of
from equipoise.dynamics.modal_inputs import ModalInputs, summed
from equipoise.dynamics.propagation import stacked
from equipoise.dynamics.sensitivities import Columns
from equipoise.dynamics.timeline import TURN_PER_STEP, Timeline, place, timeline
from equipoise.estimation.motion.observed_vectors import bias_at, mounting_at, observed
from equipoise.estimation.output_error.kernels.normal_equations import Measurements
from equipoise.estimation.output_error.kernels.parts import parts_of
from equipoise.estimation.output_error.kernels.record_pass import Posed
from equipoise.estimation.output_error.kernels.vector_rows import Vectors
from equipoise.estimation.output_error.segment_jumps import UNCUT, Jump, cuts_of, inside
from equipoise.estimation.parameters.fit_parameters import (
    CORE,
    JP,
    TURN,
    Layout,
    R,
    core_of,
    sensor_sizes,
    term_sizes,
)
from equipoise.estimation.search_budget import UNLIMITED, Budget
from equipoise.maths.linalg import element_sizes, inverse_spd
from equipoise.model.arrays import Floats, Ints, Series1, Square, Vector3
from equipoise.model.recording import Recording, Samples
from equipoise.model.sensor_terms import GYRO_CLOCK
from equipoise.model.testbed import Testbed
from equipoise.model.torque_terms import GROUPS
from equipoise.sensors.timing import measured_at, spread_of

COARSE = 1e-4  # rad: what a camera of 0.2 deg makes of a thousand rows
FINEST = 0.02  # rad
LONGEST_STEP = 1.0  # s, chosen: a thirtieth of the shortest swing worth fitting
KNOWN, KNOWN_COM = 1e-6, 1e-9  # of J, and m, chosen: what a stated sd of 0 is taken for
ANCHOR = 10.0  # chosen: natural sizes by which what the data leave open may stray from the guess
SHOWN = 1e-9  # m s, chosen: com off by so much for so long turns a cubesat's rate by 4e-6 rad/s
THERMAL = GROUPS["thermal"]
NOTHING = Samples(np.zeros(0), np.zeros((0, 1)))


def uncoupled() -> Square:
    """Return the coupling of priors that are independent."""
    return np.zeros((0, 0))


@dataclass(frozen=True, slots=True, eq=False)
class Prior:
    """Normal priors in physical coordinates; weight 0 means none.

    They are independent, but for those of inertia and com where these are coupled. The anchor is a
    prior so wide that it only decides what the data leave open. It keeps the search from wandering,
    and is taken out of the information again before that is judged.
    """

    mean: Floats
    weight: Floats  # 1 / sd^2
    anchor: Floats  # 1 / sd^2, part of ``weight``
    held: NDArray[np.bool_]  # coordinates that do not move
    coupling: Square = field(default_factory=uncoupled)  # of CORE, beside ``weight``; (0, 0): none


@dataclass(frozen=True, slots=True, eq=False)
class Problem:
    """Everything that does not change while the unknowns are sought."""

    mass: float
    gravity: float
    maps: MassMaps
    errors: MassErrors
    line: Timeline
    observed: Measurements
    layout: Layout
    columns: Columns
    prior: Prior
    limit: float  # Huber's, in sd; 0: none
    scale_open: bool  # nothing known changes: one moment of inertia is held for the search
    recording: Recording  # of which it is the problem, arranged as the testbed has its masses
    testbed: Testbed
    longest: float  # s, of a step of integration
    jumps: tuple[Jump, ...] = UNCUT
    budget: Budget = UNLIMITED  # of its descents
    modal: ModalInputs | None = None  # of modes, as a fit before had them


def columns_of(layout: Layout) -> Columns:
    """Return the propagator's columns for a layout (the bias has none)."""
    fixed = [(sensitivities.TURN, 3), (sensitivities.RATE, 3), (sensitivities.INERTIA, 6)]
    pairs = [(kind, k) for kind, n in [*fixed, (sensitivities.MOMENT, 3)] for k in range(n)]
    pairs += [(sensitivities.TORQUE, k) for k in layout.torque_index]
    pairs += [(sensitivities.ERROR, k) for k in range(len(layout.errors))]
    table = np.array(pairs, dtype=np.int64)
    return Columns(table[:, 0].copy(), table[:, 1].copy())


def prior_of(
    testbed: Testbed,
    errors: MassErrors,
    layout: Layout,
    inertia_and_com: bool,
    hold: tuple[str, ...],
    torque_anchor: float = ANCHOR,
) -> Prior:
    """Return the priors: masses' errors and bias always, the body when asked."""
    names = layout.names
    mean, sd = np.zeros(layout.size), np.full(layout.size, np.inf)
    mean[CORE] = core_of(testbed.body)
    if inertia_and_com:
        sd[JP] = max(testbed.inertia_sd, KNOWN) * element_sizes(testbed.body.inertia_P)
        sd[R] = np.maximum(testbed.com_sd, KNOWN_COM)
    sd[layout.mass_errors] = errors.sd
    mean -= counted_by_timing(layout, testbed)
    sd[layout.sensors] = sensor_sizes(layout.sensor, testbed)
    if layout.bias and testbed.gyro is not None and testbed.gyro.bias_sd > 0:
        sd[layout.gyro_bias] = testbed.gyro.bias_sd
    anchor = anchors(testbed, layout, torque_anchor)
    held = np.array([name in hold for name in names])
    return Prior(mean, sd**-2 + anchor, anchor, held)


def with_body_covariance(prior: Prior, covariance: Square) -> Prior:
    """Return a prior whose inertia and com have this covariance P, and are coupled by it.

    Its information P^-1 is ``weight`` on the diagonal, less the anchor, and ``coupling`` beside it.
    """
    information, weight = inverse_spd(covariance), prior.weight.copy()
    weight[CORE] = prior.anchor[CORE] + np.diag(information)
    return replace(prior, weight=weight, coupling=information - np.diag(np.diag(information)))


def with_torque_sds(prior: Prior, layout: Layout, sds: Iterable[tuple[str, float]]) -> Prior:
    """Return a prior that also knows how large some torques are: their sd about zero, SI."""
    weight, sd = prior.weight.copy(), dict(sds)
    weight[layout.torques] += [sd.get(term, np.inf) ** -2.0 for term in layout.terms]
    return replace(prior, weight=weight)


def anchors(testbed: Testbed, layout: Layout, torque_anchor: float) -> Floats:
    """Return weights of the anchor.

    Inertia within its own size, com within ten sd, torques within ``torque_anchor`` natural sizes.
    """
    weight = np.zeros(layout.size)
    inertia = testbed.body.mean_moment
    weight[TURN] = 1.0  # a step of 1 rad: without a camera nothing else ends a turn in heading
    weight[JP], weight[R] = inertia**-2, (ANCHOR * testbed.com_sd) ** -2
    size = term_sizes(layout.terms, inertia, testbed.weight)
    weight[layout.torques] = (torque_anchor * size) ** -2
    return weight


def quickest_swing(testbed: Testbed, aside: float = 0.0) -> float:
    """Return the fastest swing (rad/s) as a pendulum that the testbed's description allows.

    With the centre of mass another ``aside`` metres off, by the masses.
    """
    body = testbed.body
    lever = float(np.linalg.norm(body.com) + 2 * np.max(testbed.com_sd)) + aside
    stiffness = testbed.weight * lever / float(np.linalg.eigvalsh(body.inertia_P)[0])
    return float(np.sqrt(stiffness))


def longest_step(testbed: Testbed, fastest: float, rows: int) -> float:
    """Return the integration step (s).

    Within it the motion turns, or swings as a pendulum of the testbed's description, by ``turn``
    radians at most.
    Runge-Kutta's phase error over a record grows as turn^4; a tenth of a radian makes it some
    2e-6 rad in a swing of 0.1 rad. Sensors that together see less than COARSE get shorter steps.
    """
    sharpest = min(s.noise for s in (testbed.attitude, testbed.gyro) if s is not None)
    turn = TURN_PER_STEP * (sharpest / np.sqrt(rows) / COARSE) ** 0.25
    turn = float(np.clip(turn, FINEST, TURN_PER_STEP))
    return min(LONGEST_STEP, turn / max(fastest, quickest_swing(testbed)))


def forward_of(up: Vector3) -> tuple[float, float, float]:
    """Return the body axis whose heading counts: the one of x, y, z farthest from vertical.

    Of two alike the first; made level by taking out what points along ``up``.
    """
    axis = np.eye(3)[int(np.argmin(np.abs(up)))]
    level = axis - float(axis @ up) * up
    x, y, z = level / np.linalg.norm(level)
    return float(x), float(y), float(z)


def counted_by_timing(layout: Layout, testbed: Testbed) -> Floats:
    """Return how much of each unknown the times of rows count already: lags, the gyro's clock."""
    counted = np.zeros(layout.size)
    for k, name in enumerate(layout.names):
        if name == GYRO_CLOCK and testbed.gyro is not None:
            counted[k] = testbed.gyro.clock
        elif name.startswith(LAG):
            counted[k] = testbed.masses[0].lag
    return counted


@lru_cache(maxsize=4)  # by identity, as ``mass_errors``
def delayed(track: Samples, lag: float) -> Samples:
    """Return a track that is later by ``lag`` (s)."""
    return Samples(track.t + lag, track.values)


def track_of(recording: Recording, testbed: Testbed) -> Samples | None:
    """Return where the masses were, as late as they were found to be."""
    track, lag = recording.masses, testbed.masses[0].lag if testbed.masses else 0.0
    return delayed(track, lag) if track is not None and lag else track


def on_the_cameras_clock(t: Series1, testbed: Testbed, start: float) -> Series1:
    """Return times (s) stamped by the gyro's clock, which is as fast as was found since a start."""
    fast = testbed.gyro.clock if testbed.gyro else 0.0
    return t - fast * (t - start) if fast else t


def vector_moments(recording: Recording, testbed: Testbed, t: Series1) -> tuple[Ints, Series1]:
    """Return the rows of all sensors of vectors, one sensor behind the other, in order of time.

    And when each was measured, s. They are on the gyro's clock: one computer on board stamps both.
    Rows outside the span of camera and gyro, whose nodes are ``t`` (s), are left out: the motion
    begins and ends with these.
    """
    found, start = observed(recording, testbed), recording.span[0]
    late = np.concatenate([np.zeros(0), *(rows.t - each.delay for each, rows in found)])
    times = on_the_cameras_clock(late, testbed, start)
    order = np.argsort(times, kind="stable")
    order = order[(times[order] >= t[0]) & (times[order] <= t[-1])]
    return order.astype(np.int64), times[order]


def vectors_of(recording: Recording, testbed: Testbed, t: Series1) -> Vectors:
    """Return the rows of sensors of vectors in order of time; ``t`` are the nodes (s)."""
    found = observed(recording, testbed)
    values = np.vstack([np.zeros((0, 3)), *(rows.values for _, rows in found)])
    of = np.repeat(np.arange(len(found)), [len(rows) for _, rows in found])
    order, times = vector_moments(recording, testbed, t)
    sensors = [each for each, _ in found]
    return Vectors(
        np.ascontiguousarray(values[order]),
        *place(t, times),
        of[order].astype(np.int64),
        rows_of_three([each.vector_N for each in sensors]),
        rows_of_three([each.place for each in sensors]),
        np.array([each.noise for each in sensors], dtype=np.float64),
        np.array([bias_at(each) for each in sensors], dtype=np.int64),
        np.array([mounting_at(each) for each in sensors], dtype=np.int64),
    )


def rows_of_three(vectors: list[Floats]) -> Floats:
    """Return vectors as the rows of an array, also where there is none."""
    return np.array(vectors, dtype=np.float64).reshape(-1, 3)


def pose(
    recording: Recording,
    testbed: Testbed,
    layout: Layout,
    errors: MassErrors,
    prior: Prior,
    longest: float,
    limit: float,
    scale_open: bool,
    jumps: tuple[Jump, ...] = UNCUT,
    modal: ModalInputs | None = None,
) -> Problem:
    """Return the problem of a recording, integrated in steps of ``longest`` seconds at most."""
    attitude, rate = recording.attitude or NOTHING, recording.rate or NOTHING
    jumps, rails = inside(jumps, *recording.span), rails_of(testbed.masses)
    line = timeline(
        measured_at(attitude.t, testbed.attitude),
        on_the_cameras_clock(measured_at(rate.t, testbed.gyro), testbed, recording.span[0]),
        on_rails(track_of(recording, testbed), len(rails)),
        len(rails),
        longest,
        summed(recording.momentum, modal and modal.momentum),
        summed(recording.torque, modal and modal.torque),
        errors.response,
        errors.owner,
        at_nodes=False,
        cut=np.array([jump.t for jump in jumps]),
        temperature=temperature_of(recording, testbed) if {*THERMAL} & {*layout.terms} else None,
    )
    measurements = Measurements(
        np.ascontiguousarray(attitude.values if len(attitude) else np.zeros((0, 4))),
        line.attitude_node,
        line.attitude_share,
        testbed.attitude.noise if testbed.attitude else 1.0,
        spread_of(testbed.attitude),
        np.ascontiguousarray(rate.values if len(rate) else np.zeros((0, 3))),
        line.rate_node,
        line.rate_share,
        testbed.gyro.noise if testbed.gyro else 1.0,
        spread_of(testbed.gyro),
        forward_of(testbed.up),
        np.array(layout.sensor_index, dtype=np.int64),
        vectors_of(recording, testbed, line.t),
    )
    maps = mass_maps(rails)
    columns = columns_of(layout)
    return Problem(testbed.body.mass, testbed.gravity, maps, errors, line, measurements, layout,
                   columns, prior, limit, scale_open, recording, testbed, longest,
                   jumps, modal=modal)  # fmt: skip


def reposed(problem: Problem, recording: Recording, testbed: Testbed) -> Problem:
    """Return the problem with other inputs: its unknowns, priors and jumps as they are."""
    return pose(recording, testbed, problem.layout, problem.errors, problem.prior, problem.longest,
                problem.limit, problem.scale_open, problem.jumps, problem.modal)  # fmt: skip


@lru_cache(maxsize=1)  # settled, smoothed and judged in turn; by identity
def posed(problem: Problem) -> Posed:
    """Return the problem as the kernel sees it."""
    line, prior = problem.line, problem.prior
    cuts = cuts_of(problem.jumps, line.t, problem.layout)
    return Posed(problem.mass, problem.gravity, stacked(problem.maps), line.t, line.known,
                 line.owners, problem.columns, problem.observed, problem.limit, prior.mean,
                 prior.weight, prior.coupling, prior.held, problem.layout.slots,
                 cuts, parts_of(line, cuts.nodes, problem.columns))  # fmt: skip


def changes(recording: Recording, masses_count: bool = True) -> bool:
    """Say whether anything known changes during a record: masses, stored momentum, torque."""
    masses, others = recording.masses, (recording.momentum, recording.torque)
    moved = masses is not None and bool(np.any(np.ptp(masses.values, axis=0) > 0))
    return (moved and masses_count) or any(c is not None and bool(np.any(c.values)) for c in others)


def errors_of(recording: Recording, testbed: Testbed) -> MassErrors:
    """Return the errors of displacement that this recording can have."""
    track = track_of(recording, testbed)
    rows = None if track is None else changing_rows(track)
    return mass_errors(rows, testbed.masses, SHOWN * testbed.body.mass)
