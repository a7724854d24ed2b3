"""Where to level next, in numbers alone: a micro-controller runs the same.

    depth = max(SURE sd, SHALLOW);  SHALLOW once the sd is below CLOSE, or measured often enough
    along = target.u - r_home.u - depth
    last shift = sideways part of (level + target), and along + depth along u

(``height_adjustment`` says what it is for.)
"""

from equipoise.control.plant.tilt_axes import inner
from equipoise.model.arrays import Triple

SURE = 3.0  # sds, chosen
SHALLOW = 1e-5  # m, chosen: a swing of a minute or two
CLOSE = 1e-6  # m, chosen: one sd of the height that needs no further measurement
MOST_MEASUREMENTS = 4  # chosen: a measurement reduces the sd to a third or less


def is_known(sd: float, measurements: int) -> bool:
    """Say whether the height is known to CLOSE, or as well as it will be."""
    return sd <= CLOSE or measurements >= MOST_MEASUREMENTS


def depth_for(sd: float, known: bool) -> float:
    """Return how deep (m) to hang next."""
    return SHALLOW if known else max(SURE * sd, SHALLOW)


def along_for(up: Triple, target: Triple, com: Triple, depth: float) -> float:
    """Return the shift along u (m) at which the platform hangs so deep (m)."""
    return inner(up, target) - inner(up, com) - depth


def last_shift(up: Triple, level: Triple, target: Triple, along: float) -> Triple:
    """Return the shift (m) to the target from one that levels; ``along`` u it is given."""
    x, y, z = level[0] + target[0], level[1] + target[1], level[2] + target[2]
    rise = along - inner(up, (x, y, z))
    return (x + rise * up[0], y + rise * up[1], z + rise * up[2])
