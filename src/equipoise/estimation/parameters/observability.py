"""What data can and cannot show, from the information matrix in physical coordinates.

Each coordinate is measured in a size natural to it (a moment of inertia in its own mean size, a
centre of mass in its own distance, ...). A direction along which one sd exceeds half of that size
is unobservable; every parameter with a part in such a direction has an infinite interval. So has
what is known as a multiple of one that has: a product of inertia of an axis whose moment is not
observable; without any moment, all that makes torque. A line through the place where the search
ended would tell these firmly, as multiples of a number that means nothing.
"""

from dataclasses import dataclass, replace

import numpy as np

from equipoise.actuators.mass_errors import unit_of
from equipoise.estimation.parameters.fit_parameters import (
    JP,
    RATE,
    TURN,
    Layout,
    R,
    Unknowns,
    term_sizes,
)
from equipoise.maths.linalg import eigen_symmetric, symmetrise
from equipoise.model.arrays import Bools, Floats, Square
from equipoise.model.reasons.data_reasons import Unobservable
from equipoise.model.reasons.reason import Reason

OBSERVABLE = 4.0  # 1 / (half a natural size)^2
PART = 1e-3  # chosen: a smaller component of an unseen direction is rounding
LOST = 0.1  # natural sizes, chosen: by so much an unseen direction must move what it hides
DISTANCE = 1e-5  # m, a centre of mass that is not worth calling an offset
ALONG = 0.9  # chosen: cosine beyond which an unseen direction is the scale
PRODUCTS = ((0, 1), (0, 2), (1, 2))  # the axes of xy, xz and yz
OPEN = Reason(Unobservable.SCALE)


@dataclass(frozen=True, slots=True, eq=False)
class Visibility:
    """Covariance of what is observable, and which parameters have a part in what is not."""

    covariance: Square  # of what is not hidden
    hidden: Bools
    unobservable: tuple[Reason, ...]  # directions
    scale_open: bool
    unseen: Floats  # (n, u) directions of natural size, the scale not among them


def natural_sizes(point: Unknowns, mass: float, layout: Layout) -> Floats:
    """Return the size in which each coordinate is measured."""
    size = np.ones(layout.size)
    inertia = point.body(mass).mean_moment
    distance = max(float(np.linalg.norm(point.com)), DISTANCE)
    size[TURN], size[RATE], size[JP], size[R] = 1.0, 0.1, inertia, distance
    size[layout.torques] = term_sizes(layout.terms, inertia, 9.81 * mass)
    # errors of the masses: 1 mm, 1 s of a lag, all of a gain, a radian
    errors = [1e-3 if unit_of(name) == "m" else 1.0 for name in layout.errors]
    size[layout.mass_errors] = errors
    size[layout.gyro_bias] = 0.1
    return size


def scale_of(values: Floats, size: Floats) -> Floats:
    """Return the direction that stretches J and r alike, in natural sizes."""
    stretched = np.zeros_like(values)
    stretched[JP], stretched[R] = values[JP], values[R]
    return stretched / size / float(np.linalg.norm(stretched / size))


def describe(direction: Floats, names: tuple[str, ...]) -> Reason:
    """Name the parameters that an unseen direction mixes."""
    weight = np.abs(direction)
    chosen: list[str] = [names[k] for k in np.argsort(-weight) if weight[k] > 0.3 * weight.max()]
    code = Unobservable.PARAMETER if len(chosen) == 1 else Unobservable.COMBINATION
    return Reason(code, tuple(chosen))


def examine(information: Square, scale: Floats, size: Floats, names: tuple[str, ...]) -> Visibility:
    """Return covariance, visibility and the directions that are not observable."""
    values, vectors = eigen_symmetric(symmetrise(information * size[:, None] * size))
    unseen = values < OBSERVABLE
    good = vectors[:, ~unseen]
    weak, reported = vectors[:, unseen], np.maximum(values[unseen], 1e-30)
    part = np.where(np.abs(weak) > PART, weak, 0.0)
    hidden = np.any(np.abs(part) / np.sqrt(reported) > LOST, axis=1)
    slight = np.where(hidden[:, None], 0.0, part)
    natural = (good / values[~unseen]) @ good.T + (slight / reported) @ slight.T
    covariance = natural * size[:, None] * size
    scale_open = False
    unobservable: list[Reason] = []
    others: list[Floats] = []
    for direction in vectors[:, unseen].T:
        if abs(float(direction @ scale)) > ALONG:
            scale_open = True
            unobservable.append(OPEN)
        else:
            unobservable.append(describe(direction, names))
            others.append(direction * size)
    lost: Floats = np.array(others).reshape(-1, len(size)).T
    return Visibility(covariance, hidden, tuple(unobservable), scale_open, lost)


def without_multiples(view: Visibility, size: Floats, first: int = JP.start) -> Visibility:
    """Return a view in which what is known as a multiple of an unseen moment is hidden, too.

    ``first`` is where the six of J_P begin, the three of com behind them.
    """
    lost = view.hidden[first : first + 3]
    more = np.zeros_like(view.hidden)
    for k, pair in enumerate(PRODUCTS, first + 3):
        more[k] = bool(lost[list(pair)].any())
    if lost.all():
        more[first + 6 : first + 9] = True
    more &= ~view.hidden
    unseen = np.hstack([view.unseen, np.diag(size)[:, more]])
    return replace(view, hidden=view.hidden | more, unseen=unseen)


def examine_unheld(
    information: Square, scale: Floats, size: Floats, names: tuple[str, ...], held: Bools
) -> Visibility:
    """Return the same of information in which some coordinates are held, and so are known.

    They have no part in what the data show of the others. Left among these they would hide it: what
    is known to a billionth of its size, or to nothing at all, rounds off all that is not.
    """
    free = np.flatnonzero(~held)
    loose = examine(
        information[np.ix_(free, free)], scale[free], size[free], tuple(names[k] for k in free)
    )
    covariance, hidden = np.zeros_like(information), np.zeros_like(held)
    unseen = np.zeros((len(size), loose.unseen.shape[1]))
    covariance[held, held] = 1.0 / np.diag(information)[held]
    covariance[np.ix_(free, free)], hidden[free] = loose.covariance, loose.hidden
    unseen[free] = loose.unseen
    return Visibility(covariance, hidden, loose.unobservable, loose.scale_open, unseen)
