"""A platform that hangs from its bearing, as the plant of a law that moves masses.

With u the body axis that points up when level and n = -g_B / g the vertical in body axes,

    theta = n x u                       tilt, the small turn that led from level (rad)
    J theta'' = m g (r.u) theta + m g u x (r + s)                       s: shift by the masses
    theta'' = -w0^2 theta + a (c + v),     a = m g / J,  w0^2 = -a (r.u),  c = u x r,  v = u x s

for tilt and rate along two horizontal body axes; their moments differ, products couple them weakly
and are left out. A wanted v (m) is the shift s = v x u. From m r x g_B with u = z: weight at +y
turns about -x, and c = (-r_y, r_x).

A demand v = -(p theta + d rate) that is faster than masses go would be delivered late, by up to 90
degrees of the swing, and a proportional part that is late drives it. Through a swing at w0 the
demand has the greatest slope |w0 (p theta + d rate) + j (p rate - d w0^2 theta)|; it is scaled down
to what masses can follow, in phase with the swing (``spared``).

It hangs where r.u < 0. Masses first lower the centre of mass until the nominal one is SURE sds
below P, and until the sideways offset tilts the platform by a part of the limit only. Rotation
about the vertical is not modelled: the yaw rate is assumed to be far below w0.
"""

from typing import NamedTuple

import numpy as np

from equipoise.control.law import Sample
from equipoise.control.plant.actuator_limits import filling_time, greatest_shift, greatest_slew
from equipoise.control.plant.tilt_axes import (
    Feedback,
    Pair,
    TiltAxes,
    followed_share,
    rate_along,
    shift_with,
    tilt_along,
    turned_along,
)
from equipoise.maths.axes_across import axes_across
from equipoise.maths.linalg import cross
from equipoise.model.arrays import Floats, Series, Triple, Vector3
from equipoise.model.errors import InputError
from equipoise.model.testbed import Testbed
from equipoise.model.units import UM
from equipoise.sensors.timing import lateness

SURE = 3.0  # sds of the height, chosen
LIKELY = 2.0  # sds of the sideways offset, chosen
SHARE = 0.7  # of the tilt limit, chosen: where it then rests; let go level it swings to twice that
ALONG = 0.5  # cosine, chosen: a rail nearer than 60 degrees counts for an axis
SHALLOWEST = 1e-4  # m, chosen: a swing of half a minute


class Hanging(NamedTuple):
    """The platform about two horizontal body axes, by its nominal values."""

    up: Vector3  # unit vector u
    axes: Series  # (2, 3) horizontal unit vectors
    gain: Floats  # (2,) a, rad/s^2 per m
    depth: float  # m, -r.u once masses have lowered it
    lowered: float  # m, the shift along u that does it
    depth_sd: float  # m
    slew: float  # m/s, of a shift by the masses
    reach: float  # m
    step: float  # m, the finest that masses can shift it sideways
    delay: float  # s, of the sensors
    filling: float  # s, that fine masses take over half a step of coarse ones
    still: tuple[str, ...] = ()  # torques that a measurement holds at none: drift

    @property
    def frequency(self) -> Floats:
        """The swing's w0 about both axes, rad/s."""
        return np.sqrt(self.gain * self.depth)


def triple(vector: Vector3) -> Triple:
    """Return a vector as three numbers."""
    return float(vector[0]), float(vector[1]), float(vector[2])


def pair(values: Floats) -> Pair:
    """Return what belongs to both axes as two numbers."""
    return float(values[0]), float(values[1])


def tilt_axes(plant: Hanging) -> TiltAxes:
    """Return the axes as numbers."""
    first, second = plant.axes
    return TiltAxes(triple(first), triple(second), triple(cross(plant.up, first)),
                    triple(cross(plant.up, second)))  # fmt: skip


def tilt_of(plant: Hanging, sample: Sample) -> Floats:
    """Return the tilt theta about both axes, rad."""
    return np.array(tilt_along(tilt_axes(plant), triple(sample.gravity)))


def rate_of(plant: Hanging, sample: Sample) -> Floats:
    """Return the rate about both axes, rad/s."""
    return np.array(rate_along(tilt_axes(plant), triple(sample.rate)))


def shift_for(plant: Hanging, v: Floats) -> Vector3:
    """Return the horizontal shift (m) whose u x s is v along the axes."""
    return np.array(shift_with(tilt_axes(plant), pair(v)))


def turned(plant: Hanging, shift: Vector3) -> Floats:
    """Return v = u x s along the axes, m: the way back from ``shift_for``."""
    return np.array(turned_along(tilt_axes(plant), triple(shift)))


def spared(plant: Hanging, p: Floats, d: Floats, tilt: Floats, rate: Floats) -> float:
    """Return how much of v = -(p tilt + d rate) the masses can follow through a swing, 0 to 1."""
    feedback = Feedback(pair(p), pair(d), pair(plant.frequency), plant.slew)
    return followed_share(feedback, pair(tilt), pair(rate))


def sensor_delay(testbed: Testbed) -> float:
    """Return by how much the later of camera and gyro is late, s."""
    seeing = [s for s in (testbed.attitude, testbed.gyro) if s is not None]
    return max((lateness(s) for s in seeing), default=0.0)


def finest_step(testbed: Testbed, axes: Series) -> float:
    """Return the coarser of the finest shifts (m) along two axes; 0: any shift."""
    steps = [
        [m.mass * m.resolution for m in testbed.masses if abs(float(axis @ m.axis)) > ALONG]
        for axis in axes
    ]
    return max(min(each, default=0.0) for each in steps) / testbed.body.mass


def wanted_depth(testbed: Testbed) -> float:
    """Return how deep (m) the nominal centre of mass is to hang."""
    up, sd = testbed.up, testbed.com_sd
    sideways: Vector3 = testbed.body.com - up * (up @ testbed.body.com)
    off = float(np.linalg.norm(sideways)) + LIKELY * float(np.linalg.norm(sd - up * (up @ sd)))
    return max(SHALLOWEST, SURE * float(np.abs(up) @ sd), off / (SHARE * testbed.tilt_limit))


def hanging(testbed: Testbed) -> Hanging:
    """Return the platform as it hangs; InputError where masses cannot make it hang."""
    body, up = testbed.body, testbed.up
    depth, height = wanted_depth(testbed), float(up @ body.com)
    reach = greatest_shift(testbed)
    lowered = min(-depth - height, 0.0)
    if reach < -lowered or reach == 0:
        wanted = f"masses that shift it by {(depth + height) / UM:.3g} um, whatever the direction"
        raise InputError("balancing law", f"masses that shift it by {reach / UM:.3g} um", wanted)
    axes = axes_across(up)
    moments = np.einsum("ij,jk,ik->i", axes, body.inertia_P, axes)
    return Hanging(
        up, axes, testbed.weight / moments, -height - lowered, lowered,
        float(np.abs(up) @ testbed.com_sd), greatest_slew(testbed), reach,
        finest_step(testbed, axes), sensor_delay(testbed), filling_time(testbed),
        testbed.in_group("drift"),
    )  # fmt: skip
