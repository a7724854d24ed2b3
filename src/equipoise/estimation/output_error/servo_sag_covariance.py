"""What masses that hang on soft drives add to the covariance of a fit.

A drive that gives way by s under its mass's weight, and follows tau late, lets it stand off by

    s u.n(t - tau) = s u.(n + tau w x n),        n = g_B / g,  n' = n x w

A command does not show s, and the motion hardly does: it is not sought but carried (as a
"considered" parameter; Schmidt 1966). With A the information of the fit and b the descent of its
cost, masses that hang by one sd move the optimum by

    dx = A^-1 db/ds s,        covariance + dx dx^T

Of the first moment m s u (u.n), the part parallel to gravity makes no torque; it is all there is
for equal masses on three orthogonal rails. What others make is elastic sag: near level that of a
centre of mass as much higher or lower, s (m_z - m_x) / m of a platform's mass m. It is taken up
where that is sought by its own name. The part with tau damps the motion (it is where a damper takes
its energy):

    tau_B = m s tau g (u.(w x n)) u x n = -m s tau g (n x u)(n x u)^T w

b(s) has the inertia, the momentum and the moment of masses that hang, and this damping. Where sag
is sought, their first moment is taken back by rails beside theirs that have nothing else.

Where no mass travels, com is that of the platform as its masses hang: there dx of com is another
com, not an error of it. dx of J counts.

All masses are taken to hang alike, each in proportion to its ``sag_sd``. Cannot see which part of
a lag is the log's and not the drive's: all of it counts, and intervals are then too wide.
"""

from dataclasses import replace

import numpy as np

from equipoise.actuators.drive_errors import rails_of
from equipoise.actuators.lags import LAG
from equipoise.actuators.sliding_masses import MassMaps
from equipoise.dynamics.rigid_body import KNOWN_D
from equipoise.estimation.output_error.input_errors import STEP
from equipoise.estimation.output_error.problem import Problem
from equipoise.estimation.output_error.solution import Fitted, evaluate
from equipoise.estimation.parameters.fit_parameters import R
from equipoise.maths.attitude import to_matrix
from equipoise.maths.linalg import inverse_where
from equipoise.model.arrays import Floats, Series1, Series3, Square, Vector3
from equipoise.model.torque_terms import GROUPS, TERMS

VISCOUS = GROUPS["viscous"]
INDEX = [TERMS.index(term) for term in VISCOUS]


def downward(fitted: Fitted) -> Series3:
    """Return n at the nodes: by the camera, straight between rows; without one, as it began.

    Behind a camera's own errors it is off by less than a degree, which is nothing here.
    """
    line, measurements = fitted.problem.line, fitted.problem.observed
    if not len(measurements.attitude):
        return np.tile(-to_matrix(fitted.point.q0)[2], (len(line.t), 1))
    step = np.append(np.diff(line.t), 0.0)
    t: Series1 = (
        line.t[measurements.attitude_node]
        + measurements.attitude_share * step[measurements.attitude_node]
    )
    down = -to_matrix(measurements.attitude)[:, 2, :]
    columns: list[Series1] = [np.interp(line.t, t, component) for component in down.T]
    return np.column_stack(columns)


def hanging_in(problem: Problem, hanging: Floats) -> Problem:
    """Return the problem of masses displaced by ``hanging`` (m, (n, k)).

    Where elastic sag is sought it takes up their first moment: that is taken back.
    """
    maps, line = problem.maps, problem.line
    first, d, response = np.split(line.known, [KNOWN_D, KNOWN_D + len(maps.momentum)], axis=1)
    if not set(GROUPS["sag"]) <= set(problem.layout.terms):
        known = np.hstack([first, d + hanging, response])
        return replace(problem, line=line._replace(known=known))
    beside = MassMaps(maps.first_moment, *(np.zeros_like(m) for m in maps[1:]))
    both = MassMaps(*(np.vstack(pair) for pair in zip(maps, beside, strict=True)))
    known = np.hstack([first, d + hanging, -hanging, response])
    return replace(problem, maps=both, line=line._replace(known=known))


def lateness(fitted: Fitted, covariance: Square) -> Floats:
    """Return the rms of how late each mass may be, s, (k,): as stated where no lag is sought."""
    errors, layout = fitted.problem.errors, fitted.problem.layout
    late = np.array([rail.lag_sd for rail in rails_of(fitted.problem.testbed.masses)])
    for mass, j in errors.owner:
        if errors.names[j].startswith(LAG):
            at = layout.mass_errors.start + j
            late[mass] = np.hypot(fitted.point.error[j], np.sqrt(covariance[at, at]))
    return late


def damping(problem: Problem, n: Vector3, sag: Floats, late: Floats) -> Vector3:
    """Return the coefficients of damping about the body's axes, N m s."""
    moment = problem.maps.first_moment
    size = np.linalg.norm(moment, axis=1)
    across = np.cross(n, moment / size[:, None])
    return problem.gravity * (size * sag * late) @ across**2


def descent_by_damping(fitted: Fitted, more: Vector3) -> tuple[Floats, Vector3]:
    """Return what ``more`` damping changes of b, and the part of it that no unknown takes up.

    Damping that is sought moves by -``more`` itself, so b by its columns of A. A difference of b
    would not do: damping may be known far worse than it is beside all else.
    """
    layout, prior = fitted.problem.layout, fitted.problem.prior
    columns = [layout.torques.start + k for k, t in enumerate(layout.terms) if t in VISCOUS]
    sought = np.array([term in layout.terms for term in VISCOUS])
    observed = fitted.at.normal - np.diag(np.where(prior.held, 0.0, prior.weight))
    return -observed[:, columns] @ more[sought], np.where(sought, 0.0, more)


def descent_by_sag(fitted: Fitted, covariance: Square) -> Floats | None:
    """Return db/ds of one sd of sag; None where no mass sags."""
    problem, sag = fitted.problem, fitted.problem.errors.sag
    if not np.any(sag):
        return None
    n, moment = downward(fitted), problem.maps.first_moment
    axes = moment / np.linalg.norm(moment, axis=1, keepdims=True)
    more = damping(problem, n.mean(axis=0), sag, lateness(fitted, covariance))
    taken_up, rest = descent_by_damping(fitted, more)
    hanging = n @ axes.T * sag

    torque = fitted.point.torque.copy()
    torque[INDEX] += STEP * rest
    point = replace(fitted.point, torque=torque)
    hung = evaluate(hanging_in(problem, STEP * hanging), point, fitted.jumps)
    return taken_up + (hung.descent - fitted.at.descent) / STEP


def by_sag(fitted: Fitted, covariance: Square) -> Square:
    """Return what one sd of sag adds to a covariance in physical coordinates.

    b is the sum of large parts that cancel, by the inverse of A itself alone: not by a covariance
    without its anchors and what is not observable.
    """
    moved = descent_by_sag(fitted, covariance)
    if moved is None:
        return np.zeros_like(covariance)
    shift = inverse_where(fitted.at.normal, ~fitted.problem.prior.held) @ moved
    if fitted.problem.errors.at_rest:
        shift[R] = 0.0
    return np.outer(shift, shift)
