"""What a fit shows: covariance, what is hidden, and what is so by more than its local model says.

The information at an optimum is that of a plane through it. Where the motion depends on a product,
the plane seems to tell what the curve behind it does not: com and the tilt without a camera.
"""

from dataclasses import replace

import numpy as np

from equipoise.estimation.output_error.servo_sag_covariance import by_sag
from equipoise.estimation.output_error.solution import Fitted
from equipoise.estimation.parameters.fit_parameters import JP, TURN, Layout, R, physical
from equipoise.estimation.parameters.observability import (
    ALONG,
    OPEN,
    Visibility,
    examine_unheld,
    natural_sizes,
    scale_of,
    without_multiples,
)
from equipoise.maths.attitude import to_matrix
from equipoise.model.arrays import Floats, Square
from equipoise.model.estimate import ATTITUDE
from equipoise.model.reasons.data_reasons import Unobservable
from equipoise.model.reasons.reason import Reason

HEADING = Reason(Unobservable.HEADING, ATTITUDE)
TILTED = 0.25  # rad, chosen: com x n is no straight line over more
SHARE = 0.2  # of the tilt, chosen: its inverse is straight within a fifth, to 4 % of com


def without_scale(view: Visibility, layout: Layout) -> Visibility:
    """Return the view of a fit in which one moment of inertia was held only for the search."""
    hidden = view.hidden.copy()
    hidden[JP.start : layout.torques.stop] = True
    return Visibility(view.covariance, hidden, (OPEN, *view.unobservable), True, view.unseen)


def tilt_sd(fitted: Fitted, view: Visibility) -> float:
    """Return how uncertain gravity's direction in the body is at the start, rad, its worst part."""
    n = to_matrix(fitted.point.q0)[2]
    across = np.eye(3) - np.outer(n, n)
    spread = view.covariance[TURN, TURN] + view.unseen[TURN] @ view.unseen[TURN].T
    return float(np.sqrt(np.linalg.eigvalsh(across @ spread @ across)[-1]))


def is_tilt_open(fitted: Fitted, view: Visibility) -> bool:
    """Say whether the tilt is so uncertain that com and tilt show as a product only.

    A camera sees the tilt apart from com; a gyro sees com times the tilt, and the hyperbola on
    which both lie is straight over a small part of either. Of a com that is held one lies on none.
    """
    problem, sd = fitted.problem, tilt_sd(fitted, view)
    if problem.prior.held[R].any():
        return False
    tilt = float(np.linalg.norm(np.cross(problem.testbed.up, to_matrix(fitted.point.q0)[2])))
    return sd > TILTED or (not len(problem.observed.attitude) and sd > SHARE * tilt)


def without_com(view: Visibility, size: Floats) -> Visibility:
    """Return the view of a fit that does not know the tilt.

    Torque is m g com x n. Where n may be anything, com is so, too, though a line through the one
    tilt at which the search ended seems to tell it.
    """
    hidden, directions = view.hidden.copy(), np.diag(size)[:, R]
    hidden[R] = True
    reasons = (*view.unobservable, Reason(Unobservable.TILT))
    return replace(
        view, hidden=hidden, unobservable=reasons, unseen=np.hstack([view.unseen, directions])
    )


def with_heading(fitted: Fitted, view: Visibility, size: Floats) -> Visibility:
    """Return the view in which an unseen turn about the vertical is called what it is.

    It has a part in each number of the attitude, though tilt and rates are known beside it.
    """
    up = np.zeros(len(size))
    up[TURN] = to_matrix(fitted.point.q0)[2]
    cosine = np.abs(up @ (view.unseen / size[:, None]))
    found, others = list[Reason](), iter(cosine)
    for reason in view.unobservable:
        about = 0.0 if reason == OPEN else float(next(others))
        found.append(HEADING if about > ALONG else reason)
    return replace(view, unobservable=tuple(found))


def without_anchor(normal: Square, fitted: Fitted) -> Square:
    """Return information without the prior that only keeps a search from wandering."""
    prior = fitted.problem.prior
    return normal - np.diag(np.where(prior.held, 0.0, prior.anchor))


def visibility_of(fitted: Fitted) -> Visibility:
    """Return covariance and visibility at a fit."""
    problem, layout = fitted.problem, fitted.problem.layout
    values = physical(fitted.point, problem.mass, layout)
    size = natural_sizes(fitted.point, problem.mass, layout)
    information = without_anchor(fitted.at.normal, fitted)
    view = examine_unheld(
        information, scale_of(values, size), size, layout.names, problem.prior.held
    )
    view = without_multiples(view, size)
    view = replace(view, covariance=view.covariance + by_sag(fitted, view.covariance))
    if is_tilt_open(fitted, view):
        view = without_com(view, size)
    else:
        view = with_heading(fitted, view, size)
    return without_scale(view, layout) if problem.scale_open else view
