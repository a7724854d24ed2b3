"""What camera and gyro get wrong beside noise and bias.

    camera   measured = exp(plumb) (x) true (x) exp(c cos 2 psi + s sin 2 psi)
             plumb in laboratory axes, c and s in body axes
             a bad row is turned by a fixed angle about any body axis
    gyro     w_measured = (1 + scale) R(turn)^T w
    quantum  roll, pitch and yaw (3-2-1), or rates, to the nearest whole multiple

The heading psi is the direction in the laboratory's horizontal plane, atan2(y, x), of the body axis
that lies along laboratory x when the platform stands level (``maths.attitude.level``): body x when
body z or body y points up.
"""

import numpy as np

from equipoise.maths.attitude import (
    exponential,
    from_euler321,
    level,
    multiply,
    to_euler321,
    to_matrix,
)
from equipoise.model.arrays import Bools, Floats, Series4, Vector3
from equipoise.model.defects import CameraErrors, GyroErrors


def heading(q: Floats, up: Vector3) -> Floats:
    """Return the heading of attitudes, rad."""
    axis = to_matrix(level(up))[0]
    pointing = to_matrix(q) @ axis
    return np.arctan2(pointing[..., 1], pointing[..., 0])


def misread(q: Floats, errors: CameraErrors, up: Vector3) -> Floats:
    """Return attitudes from a camera whose laboratory leans and whose error turns with heading."""
    plumb, c, s = errors.plumb, errors.heading_cos, errors.heading_sin
    if not np.any([plumb, c, s]):
        return q
    twice = 2 * heading(q, up)[..., None]
    turning = exponential(np.cos(twice) * c + np.sin(twice) * s)
    return multiply(exponential(plumb), multiply(q, turning))


def with_bad_rows(
    q: Series4, errors: CameraErrors, rng: np.random.Generator
) -> tuple[Series4, Bools]:
    """Return the rows with outliers among them, and which these are."""
    if errors.bad_share == 0:
        return q, np.zeros(len(q), dtype=bool)
    share, height, way = rng.random((len(q), 3)).T
    bad = share < errors.bad_share
    z, flat = 2 * height - 1, 2 * np.sqrt(height * (1 - height))
    axis = np.column_stack([flat * np.cos(2 * np.pi * way), flat * np.sin(2 * np.pi * way), z])
    return multiply(q, exponential(errors.bad_turn * bad[:, None] * axis)), bad


def misfelt(w: Floats, errors: GyroErrors) -> Floats:
    """Return rates (rad/s) in a gyro's own axes, wrongly scaled."""
    return (1 + errors.scale) * (w @ to_matrix(exponential(errors.turn)))


def whole_angles(q: Series4, quantum: float) -> Series4:
    """Return attitudes whose roll, pitch and yaw are multiples of a quantum (rad, 0: any)."""
    if quantum == 0:
        return q
    return from_euler321(*(whole(angle, quantum) for angle in to_euler321(q)))


def whole(values: Floats, quantum: float) -> Floats:
    """Return values as multiples of a quantum (0: any)."""
    return values if quantum == 0 else quantum * np.round(values / quantum) + 0.0  # no -0.0
