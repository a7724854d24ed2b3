"""How far masses in any layout can shift the centre of mass from where it is with them at home.

    s(d) = sum_i g_i d_i,     g_i = (m_i / M) u_i,     low_i <= d_i <= high_i

is a zonotope: a box in projection. Its support function and its facets are exact:

    h(n)      = n.c + sum_i |n.e_i|,     c = sum g_i (low + high) / 2,  e_i = g_i (high - low) / 2
    facets    n of every pair of rails, +-(e_i x e_j), at h(n)
    volume    8 sum over i < j < k of |det(e_i, e_j, e_k)|

(da Silva 2021 Eq. 7 is the case of one rail along each axis, where it is a box of sides m_i d_i / M
with d_i from end to end; counted from the middle of its rail, a mass corrects half of that to
either side.) Where all rails lie in a plane or along a line, it is a polygon or a line segment
there, and nothing can be shifted across it: ``rank`` 2 or 1.

Rails are assumed as the testbed states them; steps of the motors are counted in ``move_error``.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from equipoise.actuators.sliding_masses import mass_maps
from equipoise.model.arrays import Bools, Floats, Matrix3, Series3, Vector3
from equipoise.model.testbed import SlidingMass

FLAT = 1e-9  # of the longest, chosen: what is thinner than this is rounding
HAIR = 1e-12  # m, chosen: a shift that is outside by less is on the surface


@dataclass(frozen=True, slots=True, eq=False)
class Reach:
    """The reachable set, in body axes; shifts are from masses at home."""

    centre: Vector3  # m, of the zonotope
    edges: Series3  # (k, 3) m, half an edge for each mass
    span: Floats  # (3, r) orthonormal directions that can be shifted along
    normals: Series3  # (f, 3) unit vectors out of each facet, within the span
    heights: Floats  # (f,) m, of each facet from home

    @property
    def rank(self) -> int:
        """Return how many directions can be shifted along independently."""
        return self.span.shape[1]


def reach_of(masses: Sequence[SlidingMass], total_mass: float) -> Reach:
    """Return the reachable set on a platform of this mass (kg), the masses included."""
    travel = np.array([mass.travel for mass in masses]).reshape(-1, 2)
    gain = mass_maps(masses).first_moment / total_mass
    centre: Vector3 = 0.5 * travel.sum(axis=1) @ gain
    edges: Series3 = 0.5 * (travel[:, 1] - travel[:, 0])[:, None] * gain
    span = span_of(edges)
    inside = edges @ span
    outward = facet_directions(inside) @ span.T
    normals: Series3 = np.vstack([outward, -outward])
    heights: Floats = normals @ centre + np.abs(normals @ edges.T).sum(axis=1)
    return Reach(centre, edges, span, normals, heights)


def span_of(edges: Series3) -> Floats:
    """Return an orthonormal basis of the span of vectors, one column a direction."""
    _, sizes, rows = np.linalg.svd(edges, full_matrices=False)
    return rows[sizes > FLAT * max(sizes.max(initial=0.0), HAIR)].T


def facet_directions(edges: Floats) -> Floats:
    """Return the unit normals of the facets, in the coordinates (r) of the span, one way out."""
    rank = edges.shape[1]
    if rank < 2:
        return np.ones((rank, rank))
    first, second = np.triu_indices(len(edges), 1)
    pairs = edges[:, ::-1] * [1.0, -1.0] if rank == 2 else np.cross(edges[first], edges[second])
    size = np.linalg.norm(pairs, axis=1)
    stands = size > FLAT * size.max()
    return distinct(pairs[stands] / size[stands, None])


def distinct(directions: Floats) -> Floats:
    """Return unit vectors without those that are parallel to an earlier one."""
    parallel = np.abs(np.abs(directions @ directions.T) - 1.0) < FLAT
    return directions[~np.any(np.tril(parallel, -1), axis=1)]


def contains(reach: Reach, shifts: Series3) -> Bools:
    """Say of each shift (m) whether it can be reached; what lies across the span cannot."""
    across = shifts - shifts @ reach.span @ reach.span.T
    in_span = np.linalg.norm(across, axis=1) <= HAIR
    inside: Bools = np.all(shifts @ reach.normals.T <= reach.heights + HAIR, axis=1)
    return inside & in_span


def furthest(reach: Reach, direction: Vector3) -> float:
    """Return how far (m) the centre of mass can be shifted straight along a unit vector."""
    if np.linalg.norm(direction - reach.span @ (reach.span.T @ direction)) >= FLAT:
        return 0.0
    towards = reach.normals @ direction
    out = towards > FLAT
    return float(np.min(reach.heights[out] / towards[out]))


def box_about_home(reach: Reach) -> Vector3:
    """Return half the sides (m) of a box about home that can be reached whole, in body axes.

        s = l min over facets  h / (|n| . l)

    Its sides are in proportion to l, the lesser reach either way along each axis; along an axis
    outside the span it has none.
    """
    length = np.array([min(furthest(reach, axis), furthest(reach, -axis)) for axis in np.eye(3)])
    corner = np.abs(reach.normals) @ length
    out = corner > FLAT * length.max()
    return length * float(np.min(reach.heights[out] / corner[out], initial=1.0))


def tolerance(reach: Reach) -> float:
    """Return the largest offset (m) that can be corrected whatever its direction in the span."""
    return float(np.min(reach.heights)) if reach.rank else 0.0


def weakest(reach: Reach) -> Vector3:
    """Return the unit vector of the span with the least correctable offset."""
    return reach.normals[int(np.argmin(reach.heights))]


def unreachable(reach: Reach) -> Floats:
    """Return orthonormal directions along which nothing can be shifted, (3, 3 - r)."""
    across: Matrix3 = np.eye(3) - reach.span @ reach.span.T
    return np.linalg.svd(across)[0][:, : 3 - reach.rank]


def volume(reach: Reach) -> float:
    """Return the volume (m^3) of the reachable set; 0 where that is flat."""
    triples = combinations(reach.edges, 3)
    return 8.0 * float(sum(abs(np.linalg.det(np.array(three))) for three in triples))


def outline(reach: Reach, plane: tuple[int, int]) -> Floats:
    """Return the corners (n, 2) m of the reachable set, projected along the third axis, in order.

    The shadow of a zonotope is a zonogon: its edges, sorted by direction.
    """
    edges = reach.edges[:, plane]
    edges = np.where(edges[:, :1] + FLAT * edges[:, 1:] < 0, -1.0, 1.0) * edges
    edges = edges[np.argsort(np.arctan2(edges[:, 1], edges[:, 0]))]
    start = reach.centre[list(plane)] - edges.sum(axis=0)
    way = 2.0 * np.cumsum(np.vstack([edges, -edges]), axis=0)
    return start + np.vstack([np.zeros((1, 2)), way[:-1]])
