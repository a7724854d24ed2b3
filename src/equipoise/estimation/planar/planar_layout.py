"""The unknowns of a platform on a table: where they stand, their units, priors and natural sizes.

    attitude (turn) | rate | J_P | com | position | velocity | slope | lean | torques | inputs
    | gyro bias | friction at the nodes

``lean`` is how far the attitude's vertical leans from the normal of the table, whose slope is
``slope``: gravity leans by both in the attitude's axes, and by the slope alone in the plane. Inputs
(masses of platform and sled, gravity) are relative errors of what the testbed states. They have
priors, so that all else is as uncertain as they make it.
"""

from dataclasses import dataclass

import numpy as np

from equipoise.maths.linalg import element_sizes
from equipoise.model import torque_terms
from equipoise.model.arrays import Bools, Floats
from equipoise.model.estimate import ATTITUDE, BODY, COM, INERTIA, RATE
from equipoise.model.table_top import PlanarTable
from equipoise.model.testbed import AttitudeSensor, Testbed

POSITION, VELOCITY = ("position_x", "position_y"), ("velocity_x", "velocity_y")
SLOPE, LEAN = ("slope_x", "slope_y"), ("lean_x", "lean_y")
INPUTS = ("mass_error", "sled_mass_error", "gravity_error")
BIAS = ("gyro_bias_x", "gyro_bias_y", "gyro_bias_z")
NODE = "friction"
UNITS: dict[str, str] = {
    **dict.fromkeys(ATTITUDE, "rad"), **dict.fromkeys(RATE, "rad/s"),
    **dict.fromkeys(INERTIA, "kg m2"), **dict.fromkeys(COM, "m"),
    **dict.fromkeys(POSITION, "m"), **dict.fromkeys(VELOCITY, "m/s"),
    **dict.fromkeys((*SLOPE, *LEAN), "rad"), **dict.fromkeys(INPUTS, "1"),
    **dict.fromkeys(BIAS, "rad/s"),
}  # fmt: skip
WIDE = 10.0  # chosen: natural sizes by which what the data leave open may stray in the search
SLOW = 0.1  # chosen: of M / T, a friction that a record of length T shows by a tenth of its speed
DISTANCE = 1e-5  # m, chosen: a centre of mass that is not worth calling an offset


@dataclass(frozen=True, slots=True, eq=False)
class PlanarLayout:
    """Names of the unknowns in order, and the grid of the friction map."""

    names: tuple[str, ...]
    terms: tuple[str, ...]  # torques
    nodes: int  # of the friction map along each axis

    def of(self, *names: str) -> list[int]:
        """Return where unknowns stand."""
        return [self.names.index(name) for name in names]

    @property
    def friction(self) -> slice:
        """Where the nodes of the friction map stand."""
        return slice(len(self.names) - self.nodes**2, len(self.names))

    @property
    def size(self) -> int:
        """Return how many unknowns there are."""
        return len(self.names)

    def unit(self, name: str) -> str:
        """Return the SI unit of an unknown."""
        if name.startswith(NODE):
            return "N s/m"
        return UNITS[name] if name in UNITS else torque_terms.unit_of(name)


FRICTION_MEAN = f"{NODE}_mean"  # over the rows of the position


def node_names(nodes: int) -> tuple[str, ...]:
    """Return the names of the nodes: friction_x1_y1 at the corner of least x and y."""
    counted = range(1, nodes + 1)
    return tuple(f"{NODE}_x{i}_y{j}" for i in counted for j in counted)


def planar_layout(testbed: Testbed, terms: tuple[str, ...], nodes: int) -> PlanarLayout:
    """Return the layout of a testbed with a friction map of ``nodes`` by ``nodes``."""
    bias = BIAS if testbed.gyro is not None else ()
    motion = (*ATTITUDE, *RATE, *BODY, *POSITION, *VELOCITY, *SLOPE, *LEAN)
    names = (*motion, *terms, *INPUTS, *bias, *node_names(nodes))
    return PlanarLayout(names, terms, nodes)


@dataclass(frozen=True, slots=True, eq=False)
class PlanarPrior:
    """Independent normal priors; ``anchor`` is the part that only keeps the search from straying.

    It is taken out of the information again before that is judged.
    """

    mean: Floats
    weight: Floats  # 1 / sd^2, the anchor counted
    anchor: Floats  # 1 / sd^2
    held: Bools


def stated_values(layout: PlanarLayout, testbed: Testbed) -> Floats:
    """Return the testbed's inertia and centre of mass, and zero of all else."""
    values, body = np.zeros(layout.size), testbed.body
    J = body.inertia_P
    values[layout.of(*INERTIA)] = [J[0, 0], J[1, 1], J[2, 2], J[0, 1], J[0, 2], J[1, 2]]
    values[layout.of(*COM)] = body.com
    return values


def stated_sd(
    layout: PlanarLayout, testbed: Testbed, table: PlanarTable, camera: AttitudeSensor
) -> Floats:
    """Return the sd of what the testbed states beside the body; infinite: nothing is stated."""
    sd = np.full(layout.size, np.inf)
    sd[layout.of(*SLOPE)], sd[layout.of(*LEAN)] = table.slope_sd, camera.plumb_sd
    sd[layout.of(*INPUTS)] = testbed.mass_sd, table.sled_mass_sd, testbed.gravity_sd
    sd[layout.of(*layout.terms)] = torque_terms.typical_sizes(layout.terms)
    if testbed.gyro is not None:
        sd[layout.of(*BIAS)] = testbed.gyro.bias_sd
    return sd


def natural_sizes(layout: PlanarLayout, testbed: Testbed, duration: float) -> Floats:
    """Return the size in which each unknown is measured; ``duration`` (s) is the record's."""
    size, body, table = np.ones(layout.size), testbed.body, testbed.table
    assert table is not None
    size[layout.of(*RATE)] = 0.1
    size[layout.of(*INERTIA)] = body.mean_moment
    size[layout.of(*COM)] = max(float(np.linalg.norm(body.com)), DISTANCE)
    size[layout.of(*VELOCITY)] = 0.1
    size[layout.of(*SLOPE, *LEAN)] = 1e-3
    size[layout.of(*INPUTS)] = 0.1
    size[layout.of(*layout.terms)] = torque_terms.typical_sizes(layout.terms)
    size[layout.friction] = SLOW * (body.mass + table.sled_mass) / duration
    return size


def planar_prior(
    layout: PlanarLayout, testbed: Testbed, size: Floats, with_body: bool, hold: tuple[str, ...]
) -> PlanarPrior:
    """Return the priors: what the testbed states, its body too where wanted, and the anchor."""
    table, camera = testbed.table, testbed.attitude
    assert table is not None
    assert camera is not None
    sd = stated_sd(layout, testbed, table, camera)
    if with_body:
        sd[layout.of(*INERTIA)] = testbed.inertia_sd * element_sizes(testbed.body.inertia_P)
        sd[layout.of(*COM)] = testbed.com_sd
    exact = sd == 0.0
    anchor = np.zeros(layout.size)
    anchor[layout.of(*INERTIA)] = (WIDE * size[layout.of(*INERTIA)]) ** -2
    anchor[layout.of(*COM)] = (WIDE * np.maximum(testbed.com_sd, DISTANCE)) ** -2
    anchor[layout.friction] = (WIDE * WIDE * size[layout.friction]) ** -2
    held = exact | np.isin(layout.names, hold)
    weight = np.where(exact, 0.0, np.where(exact, 1.0, sd) ** -2.0)
    return PlanarPrior(stated_values(layout, testbed), weight + anchor, anchor, held)
