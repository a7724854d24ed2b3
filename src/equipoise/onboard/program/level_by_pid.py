"""The law ``pid`` row by row, with the calculated gains: it has no relay experiment.

    settle    damp, while masses lower the centre of mass
    level     the PID, until tilt, rate and shift are quiet
    swing     a known shift sets the platform swinging; the method's filter goes on meanwhile
    last      the height is known: a last shift to the target, and the end

Between swing and level the platform is raised, as ``height_adjustment`` says. Each step is the
library's own function of numbers. The estimate is that of the board's method since its first row,
not a fit of one swing; its sd is taken for the height's as it stands.

A micro-controller has no relay experiment, for the gains that it would measure lie within the
margin with which the calculated ones are checked (``laws.pid``, MARGIN).
"""

from typing import NamedTuple

import numpy as np

from equipoise.control.elements.height_adjustment import (
    ARRIVED,
    DURATION,
    PATIENCE,
    SWING,
    TINY,
    height_search,
)
from equipoise.control.elements.height_step import along_for, depth_for, is_known, last_shift
from equipoise.control.elements.tilt_pid import Gains, Integral, damped, pid_step, shift_at
from equipoise.control.laws.pid import begin, both
from equipoise.control.plant.moving_means import (
    Bounds,
    at_depth,
    begin_means,
    follow_means,
    is_still,
)
from equipoise.control.plant.pendulum import tilt_axes, triple
from equipoise.control.plant.settling import PERIOD
from equipoise.control.plant.tilt_axes import (
    Pair,
    TiltAxes,
    rate_along,
    shift_with,
    tilt_along,
    turned_along,
)
from equipoise.dynamics.rigid_body import gravity_of
from equipoise.model.arrays import Bools, Floats, Ints, Triple, Vector3
from equipoise.model.testbed import Testbed
from equipoise.onboard.program.request import Request

SETTLE, LEVEL, WAY, RECORD, LAST = 0, 1, 2, 3, 4  # phases
EARLY = 1e-3  # s, chosen: rounding of a sensor's times, by which no sample is early


class Pid(NamedTuple):
    """What does not change."""

    axes: TiltAxes
    up: Triple
    target: Triple  # m
    gravity: float  # m/s^2
    gains: Gains
    depth: float  # m, the first
    along: float  # m, the shift along u that makes it
    reach: float  # m
    slew: float  # m/s
    near: float  # m, from its goal a shift has arrived
    calm: Bounds
    rough: Bounds
    quiet: Bounds


class Memory(NamedTuple):
    """Where it stands."""

    means: Floats  # (10,), see ``moving_means``
    integral: Floats  # (2,) m
    level: Floats  # (3,) m, the mean shift that last levelled the platform
    depth: Floats  # (1,) m
    along: Floats  # (1,) m
    due: Floats  # (1,) s, of the next sample
    since: Floats  # (1,) s, all within its bounds
    until: Floats  # (1,) s, of a way or a record
    phase: Ints  # (1,)
    measurements: Ints  # (1,)
    begun: Bools  # (1,)
    fresh: Bools  # (1,) the means begin with the next sample
    still: Bools  # (1,) all is within its bounds
    known: Bools  # (1,) the height


def put_shift(out: Request, shift: Triple) -> None:
    """Write the shift that is wanted."""
    for k in range(3):
        out.shift[k] = shift[k]


def wanted(out: Request) -> Triple:
    """Return the shift that is wanted."""
    return (out.shift[0], out.shift[1], out.shift[2])


def is_quiet(
    memory: Memory, t: float, tilt: Pair, rate: Pair, shift: Triple, bounds: Bounds, level: bool
) -> bool:
    """Say whether all has been within the bounds for long enough."""
    if memory.fresh[0]:
        begin_means(memory.means, tilt, rate, shift)
        memory.fresh[0], memory.still[0] = False, False
        return False
    follow_means(memory.means, PERIOD / bounds.memory, tilt, rate, shift)
    still = is_still(memory.means, tilt, rate, bounds, level)
    if still and not memory.still[0]:
        memory.since[0] = t
    memory.still[0] = still
    return still and t - memory.since[0] >= bounds.memory


def go(own: Pid, memory: Memory, t: float, shift: Triple, out: Request, phase: int) -> None:
    """Send the masses on a way that ends at the latest after twice its time."""
    square = 0.0
    for k in range(3):
        off = shift[k] - out.shift[k]
        square += off * off
    memory.until[0] = t + 2.0 * square**0.5 / own.slew + PATIENCE
    memory.phase[0] = phase
    put_shift(out, shift)


def has_arrived(own: Pid, memory: Memory, t: float, shift: Triple, out: Request) -> bool:
    """Say whether the masses are where they were sent, or should long be."""
    square = 0.0
    for k in range(3):
        off = shift[k] - out.shift[k]
        square += off * off
    return square**0.5 <= own.near or t >= memory.until[0]


def once_level(own: Pid, memory: Memory, t: float, out: Request) -> None:
    """Send the masses on the last way, or on one that sets the platform swinging."""
    means, depth = memory.means, memory.depth[0]
    level = (means[4], means[5], means[6])
    for k in range(3):
        memory.level[k] = level[k]
    if memory.known[0]:
        along = memory.along[0] + depth
        go(own, memory, t, last_shift(own.up, level, own.target, along), out, LAST)
        return
    size = SWING * depth / 2.0**0.5
    kick = shift_with(own.axes, (size, size))
    go(own, memory, t, (level[0] + kick[0], level[1] + kick[1], level[2] + kick[2]), out, WAY)


def raise_platform(own: Pid, memory: Memory, out: Request) -> None:
    """Level next at the depth that the estimate allows."""
    sd = 0.0
    for k in range(3):
        sd += abs(own.up[k]) * out.com_sd[k]
    count = memory.measurements[0] + 1
    known = is_known(sd, count)
    depth = depth_for(sd, known)
    com = (out.com[0], out.com[1], out.com[2])
    memory.measurements[0], memory.known[0], memory.depth[0] = count, known, depth
    memory.along[0] = along_for(own.up, own.target, com, depth)
    memory.fresh[0], memory.phase[0] = True, LEVEL
    v = (-memory.integral[0], -memory.integral[1])
    put_shift(out, shift_at(own.axes, own.up, v, own.reach, memory.along[0]))


def level(
    own: Pid, memory: Memory, t: float, tilt: Pair, rate: Pair, shift: Triple, out: Request
) -> None:
    """Take a step of the PID; leave it once all is quiet."""
    requested = wanted(out)
    undelivered = turned_along(
        own.axes, (shift[0] - requested[0], shift[1] - requested[1], shift[2] - requested[2])
    )
    before = Integral((memory.integral[0], memory.integral[1]), undelivered)
    time = PERIOD * (memory.depth[0] / own.depth) ** 0.5
    v, grown = pid_step(own.gains, tilt, rate, before, time)
    memory.integral[0], memory.integral[1] = grown[0], grown[1]
    put_shift(out, shift_at(own.axes, own.up, v, own.reach, memory.along[0]))
    bounds = own.quiet if memory.measurements[0] > 0 else own.rough
    if is_quiet(memory, t, tilt, rate, shift, at_depth(bounds, own.depth, memory.depth[0]), True):
        once_level(own, memory, t, out)


def settle(
    own: Pid, memory: Memory, t: float, tilt: Pair, rate: Pair, shift: Triple, out: Request
) -> None:
    """Damp, until the platform is calm."""
    v = damped(own.gains, rate)
    put_shift(out, shift_at(own.axes, own.up, v, own.reach, memory.along[0]))
    if is_quiet(memory, t, tilt, rate, shift, own.calm, False):
        memory.phase[0], memory.fresh[0] = LEVEL, True


def sampled(own: Pid, memory: Memory, t: float, q: Floats, w: Floats, shift: Triple,
            out: Request) -> None:  # fmt: skip
    """Take the sample of a period."""
    tilt = tilt_along(own.axes, gravity_of(q, own.gravity))
    rate = rate_along(own.axes, (w[0], w[1], w[2]))
    phase = memory.phase[0]
    if phase == SETTLE:
        settle(own, memory, t, tilt, rate, shift, out)
    elif phase == LEVEL:
        level(own, memory, t, tilt, rate, shift, out)
    elif phase == WAY and has_arrived(own, memory, t, shift, out):
        memory.phase[0], memory.until[0] = RECORD, t + DURATION
    elif phase == RECORD and t >= memory.until[0]:
        raise_platform(own, memory, out)
    elif phase == LAST and has_arrived(own, memory, t, shift, out):
        out.finished[0] = True


def step(
    own: Pid, memory: Memory, t: float, q: Floats, rate: Floats, shift: Triple, out: Request
) -> None:
    """Write the shift that is wanted at t s, once a period; the attitude is the method's."""
    if not memory.begun[0]:
        memory.begun[0], memory.due[0] = True, t
        memory.depth[0], memory.along[0], memory.fresh[0] = own.depth, own.along, True
        put_shift(out, shift)
    if t >= memory.due[0] - EARLY:
        late = t - memory.due[0] > PERIOD
        memory.due[0] = (t if late else memory.due[0]) + PERIOD
        sampled(own, memory, t, out.attitude, rate, shift, out)


def pid_on(testbed: Testbed, target: Vector3) -> tuple[Pid, Memory]:
    """Return the law at its beginning; InputError where it would not be stable."""
    _, params = begin(testbed, target)
    plant, height = params.plant, height_search(params.plant, target).height
    own = Pid(
        tilt_axes(plant), triple(plant.up), triple(target), testbed.gravity,
        both(params.gains, plant), plant.depth, height.along, plant.reach, plant.slew,
        ARRIVED * max(plant.step, TINY), params.calm, params.rough, params.quiet,
    )  # fmt: skip
    return own, Memory(
        np.zeros(10), np.zeros(2), np.zeros(3), np.zeros(1), np.zeros(1), np.zeros(1), np.zeros(1),
        np.zeros(1), np.zeros(1, np.int64), np.zeros(1, np.int64), off(), off(), off(), off(),
    )  # fmt: skip


def off() -> Bools:
    """Return a flag that is not set."""
    return np.zeros(1, np.bool_)
