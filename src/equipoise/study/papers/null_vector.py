"""The null state vector of da Silva et al. 2021, section 4.2 with Fig. 3, and the way out of it.

The same platform is balanced twice by the law of Kim and Agrawal (``control.laws.fully_actuated``):

    plain   V = |G|^2 / 2 + r^T Psi^-1 r / 2            G' + K G = -m [g_B x] r
    led     V = |G - G_d|^2 / 2 + r^T Psi^-1 r / 2      Eq. 42, the same with G - G_d

with erratum R24. G = J w is the platform's momentum, G_d leads gravity round a cone. The first ends
where r is parallel to g_B: momentum is conserved and the platform is not balanced.

Devices are ideal here: masses shift at once and weigh nothing beside the platform, gyros give the
requested torque as a stored momentum, nothing is noisy. What is left is the laws' own.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from equipoise.actuators.sliding_masses import mass_maps
from equipoise.control.elements.sweep import Sweep
from equipoise.control.law import Sample
from equipoise.control.laws.fully_actuated import LAW, Params
from equipoise.dynamics.propagation import body_of, stacked
from equipoise.dynamics.rigid_body import Body
from equipoise.maths.attitude import exponential, level, multiply, to_matrix
from equipoise.maths.linalg import pack_symmetric
from equipoise.model.arrays import Floats, Series1, Series3, Vector3
from equipoise.model.reasons.reason import Reason
from equipoise.model.testbed import Testbed
from equipoise.model.units import DEG, UM
from equipoise.simulation.motion import run
from equipoise.study.papers.paper_row import Agreement, PaperRow

OFFSET = np.array([40e-6, -30e-6, -60e-6])  # m, chosen: two sd of the preset's, masses at home
TILT = np.array([0.05, 0.03, 0.0])  # rad, chosen: of the start, at rest
LONGEST = 1800.0  # s, chosen: a law that has not ended by then does not
PLACE = "section 4.2, Fig. 3"


class Now(NamedTuple):
    """The platform at a step."""

    t: float  # s
    y: Floats  # (7,) attitude, then angular momentum with that of the gyros, N m s, body axes
    rate: Vector3  # rad/s
    stored: Vector3  # N m s
    torque: Vector3  # N m, since the last step


@dataclass(frozen=True, slots=True, eq=False)
class Course:
    """One balancing, a row a step."""

    t: Series1  # s
    momentum: Series3  # N m s, G = J w, body axes
    offset: Series3  # m, r with the masses' shift, body axes
    angle: Series1  # rad, between r and g_B
    finished: tuple[Reason, ...]  # why the law ended


@dataclass(frozen=True, slots=True, eq=False)
class NullVector:
    """Both balancings."""

    plain: Course
    led: Course


def null_vector(testbed: Testbed) -> NullVector:
    """Return both balancings of a platform of a testbed that is OFFSET off.

    InputError where the law would not be stable on the testbed.
    """
    assert testbed.gyro is not None
    unknown = replace(testbed.body, com=np.zeros(3))
    prompt = replace(testbed.gyro, rate=1 / LAW.card.period)  # a row a step, as old as the attitude
    bed = replace(testbed, body=unknown, gyro=prompt)
    _, params = LAW.begin(bed, np.zeros(3))
    plain = replace(params, sweep=at_rest(params.sweep))
    return NullVector(balanced(bed, plain), balanced(bed, params))


def at_rest(sweep: Sweep) -> Sweep:
    """Return no trajectory: G_d = 0."""
    return sweep._replace(angle=0.0, hold=0.0)


def balanced(bed: Testbed, params: Params) -> Course:
    """Return the course of a balancing with these parameters."""
    state, finished, rows = LAW.begin(bed, np.zeros(3))[0], (), list[tuple[Floats, ...]]()
    shift, now = np.zeros(3), started(bed)
    while not finished and now.t < LONGEST:
        observed = sample(bed, now, shift)
        state, command = LAW.step(state, observed, params)
        finished = command.finished
        rows.append(row(bed, observed, OFFSET + shift))
        assert command.torque is not None
        assert command.shift is not None
        shift = command.shift
        now = onward(body(bed, OFFSET + shift), now, command.torque, params.period)
    columns = (np.array(column) for column in zip(*rows, strict=True))
    return Course(*columns, finished=finished)


def started(bed: Testbed) -> Now:
    """Return the platform tilted and at rest."""
    none, q = np.zeros(3), multiply(level(bed.up), exponential(TILT))
    return Now(0.0, np.concatenate([q, none]), none, none, none)


def body(bed: Testbed, offset: Vector3) -> Body:
    """Return the platform with the centre of mass at an offset (m)."""
    six = pack_symmetric(bed.body.inertia_P)
    return body_of(bed.body.mass, bed.gravity, six, bed.body.mass * offset)


def sample(bed: Testbed, now: Now, shift: Vector3) -> Sample:
    """Return what the law observes, exactly."""
    none = np.zeros(3)
    gravity = -bed.gravity * to_matrix(now.y[:4])[2, :]
    return Sample(now.t, now.y[:4], now.rate, gravity, shift, now.stored, now.torque, none, None)


def row(bed: Testbed, observed: Sample, offset: Vector3) -> tuple[Floats, ...]:
    """Return time, momentum, offset and angle of a step."""
    sizes = float(np.linalg.norm(offset)) * bed.gravity
    cosine = float(offset @ observed.gravity) / max(sizes, 1e-300)
    angle = np.arccos(np.clip(cosine, -1.0, 1.0))
    return np.array(observed.t), bed.body.inertia_P @ observed.rate, offset, np.array(angle)


def onward(platform: Body, now: Now, torque: Vector3, period: float) -> Now:
    """Return the platform a period later; gyros take up what they give: h' = -torque."""
    t = np.array([0.0, period])
    stored = now.stored - t[:, None] * torque
    known = np.hstack([stored, np.zeros((2, 4))])
    path = run(platform, stacked(mass_maps(())), now.y, t, known)
    return Now(now.t + period, path.y[-1], path.rate[-1], stored[-1], torque)


def paper_rows(found: NullVector) -> tuple[PaperRow, ...]:
    """Return what Fig. 3 and Eq. 42 claim beside both courses."""
    return tuple(rows_of(found))


def rows_of(found: NullVector) -> Iterator[PaperRow]:
    """Yield the rows: the review prints no number."""
    for course, name, why in (
        (found.plain, "plain V", "G' + K G = -m [g_B x] r (R24): r stays along g_B"),
        (found.led, "V of Eq. 42", "G_d leads gravity round a cone, which Eq. 42 leaves open"),
    ):
        start, end = np.linalg.norm(course.offset[[0, -1]], axis=1) / UM
        along = float(course.angle[-1]) / DEG
        for quantity, unit, ours in (
            ("offset at the start and at the end", "um", (float(start), float(end))),
            ("angle between r and g_B at the end", "deg", (min(along, 180.0 - along),)),
            ("momentum J w at the end", "N m s", (float(np.linalg.norm(course.momentum[-1])),)),
            ("time until the law ends", "s", (float(course.t[-1]),)),
        ):
            yield PaperRow(PLACE, f"{name}: {quantity}", unit, (), ours, Agreement.SHOWN, why)
