"""A platform with wheels and control moment gyros, made of MuJoCo bodies. Development only.

A wheel is a body on a hinge, turned by a motor. A gyro is a gimbal on a hinge, held by a stiff
position servo, that carries a rotor on a hinge of its own, held by a stiff velocity servo. Both
have mass, a place, and inertia across their axes. Nothing here shares code with
``equipoise.dynamics`` or ``equipoise.actuators``: there are no stored momenta here, only bodies.

The platform's mass, centre of mass and inertia count everything that floats: masses at home, rotors
as if locked, gimbals at angle zero. Servos give way; the run holds where gimbals *are* and how fast
rotors *turn*, not what they were told.

A rotor may turn by much of a radian in a step: it is round, so that nothing depends on how far.
"""

from dataclasses import dataclass

import mujoco
import numpy as np
from mujoco import rollout
from numpy.typing import NDArray

from equipoise.model.mass_properties import parallel_axis
from tests.oracle.mujoco_bench import EYE, POINT, Platform

Array = NDArray[np.float64]
SERVO = 60.0  # rad/s, chosen: what a servo is told is held over a step, and a stiff one trembles
HOLD = 300.0  # 1/s, chosen: of a rotor's speed, which is told nothing new


@dataclass(frozen=True, slots=True, eq=False)
class Wheel:
    """A round rotor on the platform; inertias about its centre of mass, which is on its axis."""

    name: str
    place: Array  # m, from P
    axis: Array  # unit vector
    mass: float  # kg
    axial: float  # kg m^2, about the axis
    across: float  # kg m^2
    speed: float = 0.0  # rad/s, at the start


@dataclass(frozen=True, slots=True, eq=False)
class Gyro:
    """A gimbal with a round rotor in it, the centres of mass of both in one place."""

    name: str
    place: Array  # m, from P
    gimbal_axis: Array  # unit vector
    spin_axis: Array  # unit vector, at angle zero
    gimbal_mass: float  # kg
    gimbal_inertia: Array  # kg m^2, along the spin axis, the third, and the gimbal axis
    rotor_mass: float  # kg
    axial: float  # kg m^2, of the rotor
    across: float  # kg m^2, of the rotor
    speed: float  # rad/s, of the rotor in its gimbal
    angle: float = 0.0  # rad, at the start

    @property
    def axes(self) -> Array:
        """Return spin axis, third axis and gimbal axis at angle zero, as rows."""
        third = np.cross(self.gimbal_axis, self.spin_axis)
        return np.array([self.spin_axis, third, self.gimbal_axis])


@dataclass(frozen=True, slots=True, eq=False)
class Driven:
    """A platform with what turns on it, and what each is told over every step."""

    platform: Platform
    wheels: tuple[Wheel, ...] = ()
    gyros: tuple[Gyro, ...] = ()
    dt: float = 1e-3  # s
    torques: Array | None = None  # (n, wheels) N m on the rotors
    angles: Array | None = None  # (n, gyros) rad
    displacements: Array | None = None  # (n, slides) m


@dataclass(frozen=True, slots=True, eq=False)
class Run:
    """What really happened, at every step."""

    t: Array  # s, (n,)
    q: Array  # (n, 4) scalar first, body to laboratory
    rate: Array  # (n, 3) rad/s, body axes
    wheel_speeds: Array  # (n, wheels) rad/s, against the platform
    angles: Array  # (n, gyros) rad
    gimbal_rates: Array  # (n, gyros) rad/s
    rotor_speeds: Array  # (n, gyros) rad/s, against the gimbal
    displacement: Array  # (n, slides) m


def parts_of(given: Driven) -> list[tuple[float, Array, Array]]:
    """Return mass, place and inertia about it, body axes, of all that is not the bare platform."""
    found = [(s.mass, s.home, POINT * EYE) for s in given.platform.slides]
    for w in given.wheels:
        along = np.outer(w.axis, w.axis)
        found.append((w.mass, w.place, w.axial * along + w.across * (EYE - along)))
    for g in given.gyros:
        inertia = g.gimbal_inertia + np.array([g.axial, g.across, g.across])
        found.append((g.gimbal_mass + g.rotor_mass, g.place, g.axes.T @ np.diag(inertia) @ g.axes))
    return found


def bare_body(given: Driven) -> tuple[float, Array, Array]:
    """Return mass, centre of mass and inertia about it of the platform without these."""
    platform, parts = given.platform, parts_of(given)
    mass = platform.mass - sum(m for m, _, _ in parts)
    com = (platform.mass * platform.com - sum((m * r for m, r, _ in parts), np.zeros(3))) / mass
    rest = sum((inertia + parallel_axis(m, r) for m, r, inertia in parts), np.zeros((3, 3)))
    return mass, com, platform.inertia_P - rest - parallel_axis(mass, com)


def _text(values: Array) -> str:
    return " ".join(f"{v:.17g}" for v in np.atleast_1d(values))


def _body(place: Array, turn: str, joint: str, mass: float, diagonal: Array) -> str:
    """Return a body's text up to its children; inertia along its own axes."""
    return (
        f'<body pos="{_text(place)}" {turn}>{joint}<inertial pos="0 0 0" mass="{mass:.17g}" '
        f'diaginertia="{_text(diagonal)}"/>'
    )


def _hinge(name: str, axis: str) -> str:
    return f'<joint name="{name}" type="hinge" axis="{axis}"/>'


def _wheel(w: Wheel) -> str:
    inertia = np.array([w.across, w.across, w.axial])
    turn = f'zaxis="{_text(w.axis)}"'
    return _body(w.place, turn, _hinge(w.name, "0 0 1"), w.mass, inertia) + "</body>"


def _gyro(g: Gyro) -> str:
    turn = f'xyaxes="{_text(g.axes[:2].ravel())}"'
    rotor = np.array([g.axial, g.across, g.across])
    return (
        _body(g.place, turn, _hinge(g.name, "0 0 1"), g.gimbal_mass, g.gimbal_inertia)
        + _body(np.zeros(3), "", _hinge(g.name + "_rotor", "1 0 0"), g.rotor_mass, rotor)
        + "</body></body>"
    )


def _slides(given: Driven) -> str:
    return "\n".join(
        _body(s.home, "", f'<joint name="{s.name}" type="slide" axis="{_text(s.axis)}"/>', s.mass,
              np.full(3, POINT)) + "</body>"
        for s in given.platform.slides
    )  # fmt: skip


def _servo(joint: str, inertia: float) -> str:
    kp, kv = inertia * SERVO**2, 2 * inertia * SERVO  # critically damped
    return f'<position joint="{joint}" kp="{kp:.17g}" kv="{kv:.17g}"/>'


def _drives(given: Driven) -> str:
    """Return the actuators: wheels, gimbals, rotors, slides."""
    gyros = given.gyros
    return "\n".join(
        [
            *[f'<motor joint="{w.name}"/>' for w in given.wheels],
            *[_servo(g.name, g.gimbal_inertia[2] + g.across) for g in gyros],
            *[f'<velocity joint="{g.name}_rotor" kv="{g.axial * HOLD:.17g}"/>' for g in gyros],
            *[_servo(s.name, s.mass) for s in given.platform.slides],
        ]
    )


def model_text(given: Driven) -> str:
    """Return the MuJoCo model."""
    mass, com, J = bare_body(given)
    inertia = J[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]
    return f"""<mujoco model="platform">
<compiler angle="radian" inertiafromgeom="false"/>
<option timestep="{given.dt:.17g}" gravity="0 0 {-given.platform.gravity:.17g}" integrator="RK4">
<flag contact="disable" constraint="disable"/></option>
<worldbody><body name="platform">
<joint name="bearing" type="ball" damping="0"/>
<inertial pos="{_text(com)}" mass="{mass:.17g}" fullinertia="{_text(inertia)}"/>
{"".join(_wheel(w) for w in given.wheels)}
{"".join(_gyro(g) for g in given.gyros)}
{_slides(given)}
</body></worldbody>
<actuator>{_drives(given)}</actuator>
</mujoco>"""


def _start(given: Driven, model: mujoco.MjModel) -> Array:
    """Return MuJoCo's initial state: rotors at speed, gimbals and slides at rest."""
    data = mujoco.MjData(model)
    data.qpos[:4], data.qvel[:3] = given.platform.q, given.platform.rate
    for w in given.wheels:
        data.joint(w.name).qvel[0] = w.speed
    for g in given.gyros:
        data.joint(g.name).qpos[0] = g.angle
        data.joint(g.name + "_rotor").qvel[0] = g.speed
    state = np.empty(mujoco.mj_stateSize(model, mujoco.mjtState.mjSTATE_FULLPHYSICS))
    mujoco.mj_getState(model, data, state, mujoco.mjtState.mjSTATE_FULLPHYSICS)
    return state


def _control(given: Driven, steps: int) -> Array:
    """Return what the actuators are told over each step, in their order."""
    speeds = np.tile([g.speed for g in given.gyros], (steps, 1))
    rest = np.tile([g.angle for g in given.gyros], (steps, 1))
    torques = np.zeros((steps, len(given.wheels))) if given.torques is None else given.torques
    angles = rest if given.angles is None else given.angles
    home = np.zeros((steps, len(given.platform.slides)))
    slides = home if given.displacements is None else given.displacements
    return np.hstack([torques, angles, speeds, slides])


def simulate(given: Driven, duration: float) -> Run:
    """Run it for ``duration`` seconds; what it is told must be as long."""
    model = mujoco.MjModel.from_xml_string(model_text(given))
    start, steps = _start(given, model), round(duration / given.dt)
    states, _ = rollout.rollout(
        model, mujoco.MjData(model), start[None], _control(given, steps)[None]
    )
    rows = np.vstack([start, states[0]])[:, 1:]
    place, speed = rows[:, : model.nq], rows[:, model.nq : model.nq + model.nv]

    def columns(values: Array, names: list[str], of: str) -> Array:
        return values[:, [getattr(model.joint(name), of)[0] for name in names]]

    gimbals = [g.name for g in given.gyros]
    return Run(
        np.arange(steps + 1) * given.dt,
        place[:, :4],
        speed[:, :3],
        columns(speed, [w.name for w in given.wheels], "dofadr"),
        columns(place, gimbals, "qposadr"),
        columns(speed, gimbals, "dofadr"),
        columns(speed, [name + "_rotor" for name in gimbals], "dofadr"),
        columns(place, [s.name for s in given.platform.slides], "qposadr"),
    )
