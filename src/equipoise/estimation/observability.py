"""What data can and cannot see, from the information matrix in physical coordinates.

Each coordinate is measured in a size natural to it (a moment of inertia in its own mean size, a
centre of mass in its own distance, ...). A direction along which one sd exceeds half of that size
is not seen; every parameter with a part in such a direction has an infinite interval.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from equipoise.estimation.unknowns import FIXED, JP, RATE, TURN, Layout, R, Unknowns
from equipoise.maths.linalg import symmetrise
from equipoise.model.arrays import Floats, Square

SEEN = 4.0  # 1 / (half a natural size)^2
PART = 1e-3  # chosen: a smaller component of an unseen direction is rounding
DISTANCE = 1e-5  # m, a centre of mass that is not worth calling an offset
SCALE = "the common scale of inertia and centre of mass"


@dataclass(frozen=True, slots=True, eq=False)
class Visibility:
    """Covariance of what is seen, and which parameters have a part in what is not."""

    covariance: Square  # over the seen directions alone
    hidden: NDArray[np.bool_]
    sentences: tuple[str, ...]
    scale_open: bool


def natural_sizes(point: Unknowns, mass: float, layout: Layout) -> Floats:
    """Return the size in which each coordinate is measured."""
    size = np.ones(layout.size)
    inertia = float(np.trace(point.body(mass).inertia_P)) / 3
    distance = max(float(np.linalg.norm(point.com)), DISTANCE)
    weight = mass * 9.81 * DISTANCE
    size[TURN], size[RATE], size[JP], size[R] = 1.0, 0.1, inertia, distance
    by_group = {"viscous": 0.1 * inertia, "quadratic": inertia, "sag": DISTANCE, "drift": 1e-6}
    n = len(layout.terms)
    for k, term in enumerate(layout.terms):
        size[FIXED + k] = by_group.get(term.split("_")[0], weight)
    size[FIXED + n : FIXED + n + len(layout.errors)] = 1e-3
    if layout.bias:
        size[-3:] = 0.1
    return size


def is_scale(direction: Floats, physical: Floats) -> bool:
    """Say whether a direction stretches J and r alike (in natural sizes)."""
    stretched = np.zeros_like(direction)
    stretched[JP], stretched[R] = physical[JP], physical[R]
    cosine = abs(float(direction @ stretched)) / float(np.linalg.norm(stretched))
    return cosine > 0.9


def describe(direction: Floats, layout: Layout) -> str:
    """Name the parameters that an unseen direction mixes."""
    weight = np.abs(direction)
    chosen = [layout.names[k] for k in np.argsort(-weight) if weight[k] > 0.3 * weight.max()]
    return "the data cannot tell " + ", ".join(chosen) + (" apart" if len(chosen) > 1 else "")


def examine(information: Square, physical: Floats, size: Floats, layout: Layout) -> Visibility:
    """Return covariance, visibility and the sentences about what is not seen."""
    values, vectors = np.linalg.eigh(symmetrise(information * size[:, None] * size))
    unseen = values < SEEN
    good = vectors[:, ~unseen]
    covariance = (good / values[~unseen]) @ good.T * size[:, None] * size
    hidden = np.any(np.abs(vectors[:, unseen]) > PART, axis=1)
    scale_open, sentences = False, []
    for direction in vectors[:, unseen].T:
        if is_scale(direction, physical / size):
            scale_open = True
            sentences.append(
                f"{SCALE}: motion without a known move or momentum shows ratios only; "
                "move a mass, or hold one value that is known"
            )
        else:
            sentences.append(describe(direction, layout))
    return Visibility(covariance, hidden, tuple(sentences), scale_open)
