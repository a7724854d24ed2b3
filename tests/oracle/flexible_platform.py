"""MuJoCo's platform with parts that oscillate: wheels on torsion springs, or pendulums.

A part is a body of its own on a hinge with a spring and a damper; the platform without parts is
what remains of ``mujoco_bench.Platform``, which has them at rest. Development only.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import reduce
from typing import NamedTuple

import mujoco
import numpy as np
from mujoco import rollout

from equipoise.model.mass_properties import is_possible, parallel_axis
from equipoise.model.modes import FreeMode, Mode, freed
from tests.oracle import mujoco_bench as oracle
from tests.oracle.mujoco_bench import Array

DOWN = np.array([0.0, 0.0, -1.0])
LITTLE = 1e-7  # kg m^2, chosen: of a pendulum's bob


@dataclass(frozen=True, slots=True, eq=False)
class Part:
    """A body on a hinge; the spring is at rest where the part hangs level."""

    mass: float  # kg
    hinge: Array  # m, from P
    axis: Array  # unit vector
    arm: Array  # m, from the hinge to its centre of mass at rest
    inertia: Array  # kg m^2, (3, 3) about its centre of mass
    stiffness: float  # N m/rad
    drag: float  # N m s/rad
    angle: float  # rad, at the beginning

    @property
    def moment(self) -> float:
        """Return its moment of inertia about the hinge, kg m^2."""
        across = np.cross(self.axis, self.arm)
        return float(self.axis @ self.inertia @ self.axis + self.mass * across @ across)


Maker = Callable[[np.random.Generator, oracle.Platform], Part]


class FlexibleRun(NamedTuple):
    """What happened, and the angular velocity of each part against the platform, rad/s."""

    run: oracle.OracleRun
    turning: Array  # (n, parts)


def wheel(rng: np.random.Generator, platform: oracle.Platform) -> Part:
    """Return a disc on a torsion spring: 2 to 8 % of the platform's mean moment, 0.7 to 4 Hz."""
    axis = rng.normal(size=3)
    axis /= np.linalg.norm(axis)
    moment = rng.uniform(0.02, 0.08) * float(np.trace(platform.inertia_P)) / 3
    inertia = moment * (0.6 * np.eye(3) + 0.4 * np.outer(axis, axis))
    W, z = 2 * np.pi * rng.uniform(0.7, 4.0), rng.uniform(0.002, 0.02)
    hinge = rng.uniform(-0.05, 0.05, 3)
    return Part(0.02 * platform.mass, hinge, axis, np.zeros(3), inertia, moment * W**2,
                2 * z * moment * W, 0.0)  # fmt: skip


def pendulum(rng: np.random.Generator, platform: oracle.Platform) -> Part:
    """Return a bob that swings at 1.5 to 4 Hz: some cubic centimetres that slosh.

    As elastic sag it raises com by m g / (W^2 M), by 5 to 25 % of how deep that is: a heavier bob
    would turn the platform over. Its spring is soft where the arm is long enough for gravity alone.
    """
    heading = rng.uniform(0, 2 * np.pi)
    axis = np.array([np.cos(heading), np.sin(heading), 0.0])
    W, z = 2 * np.pi * rng.uniform(1.5, 4.0), rng.uniform(0.002, 0.02)
    sag = rng.uniform(0.05, 0.25) * -float(platform.com[2])
    arm = min(0.1, platform.gravity / (0.9 * W**2)) * DOWN
    mass = sag * platform.mass * W**2 / platform.gravity
    moment = mass * float(arm @ arm) + LITTLE
    hinge = np.array([*rng.uniform(-0.1, 0.1, 2), rng.uniform(0.1, 0.2)]) - 0.5 * arm
    spring = moment * W**2 - mass * platform.gravity * float(np.linalg.norm(arm))
    return Part(mass, hinge, axis, arm, LITTLE * np.eye(3), spring, 2 * z * moment * W,
                rng.uniform(-0.1, 0.1))  # fmt: skip


def mode_of(part: Part, platform: oracle.Platform) -> FreeMode:
    """Return the mode that a part is, as the free platform shows it: d + s x g_0 / W^2."""
    size, place = part.moment**0.5, part.hinge + part.arm
    along = part.mass * np.cross(part.axis, part.arm)  # the momentum of the part at 1 rad/s
    d = (np.cross(place, along) + part.inertia @ part.axis) / size
    s = along / size
    weight = -part.mass * platform.gravity * float(part.arm @ DOWN) * -1.0
    W = ((part.stiffness + weight) / part.moment) ** 0.5
    d = d + np.cross(s, platform.gravity * DOWN) / W**2
    z = part.drag / (2 * part.moment * W)
    return freed(Mode(W / (2 * np.pi), z, d), platform.inertia_P)


def without(platform: oracle.Platform, part: Part) -> oracle.Platform:
    """Return the platform without its part."""
    place = part.hinge + part.arm
    mass = platform.mass - part.mass
    com = (platform.mass * platform.com - part.mass * place) / mass
    inertia = platform.inertia_P - part.inertia - parallel_axis(part.mass, place)
    return replace(platform, mass=mass, com=com, inertia_P=inertia)


def is_sound(platform: oracle.Platform, parts: Sequence[Part]) -> bool:
    """Say whether what remains of the platform without its parts is a body."""
    mass, com, inertia = oracle.bare_body(reduce(without, parts, platform))
    return mass > 0 and is_possible(
        oracle.MassProperties(mass, com, inertia + parallel_axis(mass, com))
    )


def body_text(part: Part, name: str) -> str:
    """Return a part as a body of MuJoCo's model."""
    inertia = part.inertia[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]
    numbers = [oracle._text(v) for v in (part.hinge, part.axis, part.arm, inertia)]
    return (
        f'<body name="{name}" pos="{numbers[0]}"><joint name="hinge {name}" type="hinge" '
        f'axis="{numbers[1]}" stiffness="{part.stiffness:.17g}" damping="{part.drag:.17g}"/>'
        f'<inertial pos="{numbers[2]}" mass="{part.mass:.17g}" fullinertia="{numbers[3]}"/></body>'
    )


def model_text(platform: oracle.Platform, parts: Sequence[Part], dt: float) -> str:
    """Return the MuJoCo model."""
    text = oracle.model_text(reduce(without, parts, platform), dt)
    bodies = "".join(body_text(part, f"part {k}") for k, part in enumerate(parts))
    return text.replace("</body></worldbody>", f"{bodies}</body></worldbody>")


def simulate(
    platform: oracle.Platform, parts: Sequence[Part], schedule: tuple[oracle.Ramp, ...],
    duration: float, dt: float = 1e-3,
) -> FlexibleRun:  # fmt: skip
    """Run the platform with its parts, at rest against it at the beginning but for their angles."""
    model = mujoco.MjModel.from_xml_string(model_text(platform, parts, dt))
    wanted = oracle.command(platform, schedule, oracle.middles(duration, dt))
    k, m = len(platform.slides), len(parts)
    gravity_B = oracle.matrix(platform.q).T @ (platform.gravity * DOWN)
    data = mujoco.MjData(model)
    sag = platform.slide_axes @ gravity_B / platform.servos**2
    data.qpos[:] = np.concatenate([platform.q, sag, [part.angle for part in parts]])
    data.qvel[:] = np.concatenate([platform.rate, np.zeros(k + m)])
    start = np.empty(mujoco.mj_stateSize(model, mujoco.mjtState.mjSTATE_FULLPHYSICS))
    mujoco.mj_getState(model, data, start, mujoco.mjtState.mjSTATE_FULLPHYSICS)
    control = np.hstack([wanted, np.zeros((len(wanted), 3))])[None]
    states, _ = rollout.rollout(model, mujoco.MjData(model), start[None], control)
    rows = np.vstack([start, states[0]])[:, 1:]
    q, d, _, rate, velocity, turning = np.split(
        rows[:, : 7 + 2 * (k + m)], np.cumsum([4, k, m, 3, k]), axis=1
    )
    t = np.arange(len(rows)) * dt
    run = oracle.OracleRun(platform, t, q, rate, d, velocity, platform.com_at(d))
    return FlexibleRun(run, turning)
