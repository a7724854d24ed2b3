"""The platform of ``mujoco_bench`` with contacts, and with a part that slips. Development only.

A contact is a torque in laboratory axes, held over each of MuJoCo's steps, whose sum is the stated
impulse exactly. The part that slips is three equal points at P on rails along the body's axes,
1 % of the platform's mass each: at P they take no part in the momentum while they travel, the
inertia changes by m d^2 alone (4e-8 kg m^2 for 5 um of 14 kg), and the sag of their three equal
servos is parallel to gravity, so that it makes no torque. They lag their ramp by 2 / TIGHT = 3 ms.
"""

from dataclasses import replace

import numpy as np

from tests.oracle import mujoco_bench as oracle
from tests.oracle.defects import Array, ComStep, Contact, Defects

LOOSE = 0.01  # of the platform's mass, each point of the part that slips; chosen
TIGHT = 600.0  # rad/s, chosen: sag that follows gravity late then turns the platform by 1e-6 rad


def torque(contacts: tuple[Contact, ...], duration: float, dt: float) -> Array:
    """Return the contacts' torque in each step, N m, (n, 3), laboratory axes."""
    t = oracle.middles(duration, dt)
    out = np.zeros((len(t), 3))
    for each in contacts:
        steps = (t >= each.time) & (t < each.time + each.duration)
        out[steps] += each.impulse / (dt * np.count_nonzero(steps))
    return out


def slipped(steps: tuple[ComStep, ...], t: Array) -> Array:
    """Return where the centre of mass has been sent by slips, m, (n, 3)."""
    out = np.zeros((len(t), 3))
    for each in steps:
        out += oracle.smooth(np.clip((t - each.time) / each.duration, 0, 1))[:, None] * each.shift
    return out


def with_loose_part(platform: oracle.Platform) -> oracle.Platform:
    """Return the same platform, three points of which can slip; they are its last slides."""
    points = tuple(
        oracle.Slide(f"loose_{letter}", LOOSE * platform.mass, np.zeros(3), axis, TIGHT)
        for letter, axis in zip("xyz", np.eye(3), strict=True)
    )
    return replace(platform, slides=platform.slides + points)


def simulate(
    platform: oracle.Platform,
    schedule: tuple[oracle.Ramp, ...],
    defects: Defects,
    duration: float = 120.0,
    dt: float = 1e-3,
) -> oracle.OracleRun:
    """Run the platform; its centre of mass, in the run, goes with the slips too."""
    t = oracle.middles(duration, dt)
    wanted = oracle.command(platform, schedule, t)
    push = torque(defects.contacts, duration, dt)
    if not defects.com_steps:
        return oracle.driven(platform, wanted, push, dt)
    slip = slipped(defects.com_steps, t) / LOOSE
    run = oracle.driven(with_loose_part(platform), np.hstack([wanted, slip]), push, dt)
    k = len(platform.slides)
    observed = run.displacement[:, :k], run.velocity[:, :k]
    return replace(run, platform=platform, displacement=observed[0], velocity=observed[1])
