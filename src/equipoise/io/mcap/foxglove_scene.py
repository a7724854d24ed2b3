"""A bench as Foxglove's 3-D panel shows it: platform, masses, centre of mass, gravity.

The centre of mass with masses displaced by d_i along their axes u_i (model.testbed.SlidingMass):

    com(d) = com(0) + sum_i m_i gain_i d_i u_i / m                              (m, body axes)

Both it and its sd are micrometres beside decimetres, so they are drawn larger, by a factor that a
text states. The ellipsoid's half axes are one sd along each body axis; there is none where an sd
is not known. The disc stands for the whole body, whose shape no testbed states.

Every message holds the whole scene: a player that goes to some moment shows the last one before it.
Entities have no lifetime, and each replaces the one of the same id (public Foxglove schemas:
SceneUpdate, SceneEntity). They are locked to their frames and turn with them.
"""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from equipoise.model.arrays import Vector3
from equipoise.model.recording import CHANNELS, Recording
from equipoise.model.testbed import SlidingMass, Testbed

LABORATORY, BODY = "laboratory", "body"  # frames
# Of the data of an event that states the centre of mass, masses as they stand: three numbers each,
# null where one is not known.
COM_KEY, SD_KEY = "com_m", "sd_m"
SMALLEST = 0.15  # m, chosen: radius of a platform whose masses have no stated places
WIDEST = 0.9  # of the radius, chosen: so large the offset and its sd are drawn at most
KEPT = (0.3, 1.2)  # of the radius, chosen: the factor stays while they are drawn between these
GREY, ORANGE = (0.55, 0.62, 0.70, 0.35), (0.95, 0.55, 0.15, 1.0)  # red, green, blue, opacity
RED, PINK = (0.85, 0.15, 0.20, 1.0), (0.85, 0.15, 0.20, 0.35)
BLUE = (0.20, 0.40, 0.90, 1.0)
UPRIGHT = (1.0, 0.0, 0.0, 0.0)  # quaternion, scalar first: as it is
X_TO_DOWN = (math.sqrt(0.5), 0.0, math.sqrt(0.5), 0.0)  # an arrow lies along x

Update = Callable[[Any], Any]  # a stamp: a SceneUpdate


@dataclass(frozen=True, slots=True, eq=False)
class Standing:
    """What a scene shows."""

    displacements: Mapping[str, float]  # m, of each mass
    com_home: Vector3  # m, masses at home
    sd: Vector3  # m
    factor: float = 0.0  # by which the offset is drawn larger; 0: none yet


class Scene:
    """A bench's scene as rows and estimates come."""

    def __init__(self, testbed: Testbed, messages: Any) -> None:
        """Begin with the masses at home; ``messages`` is Foxglove's library of them."""
        self._bed, self._messages, self._shown = testbed, messages, False
        home = dict.fromkeys(testbed.mass_names, 0.0)
        self._standing = Standing(home, testbed.body.com, testbed.com_sd)

    def moved(self, rows: Recording) -> Iterator[tuple[float, Update]]:
        """Yield the scene whenever a mass stands elsewhere than before, and once at first."""
        begins = [float(c.t[0]) for n in CHANNELS if (c := getattr(rows, n)) is not None and len(c)]
        if begins and not self._shown:
            yield self.now(min(begins))
        if rows.masses is None:
            return
        for t, row in zip(rows.masses.t.tolist(), rows.masses.values.tolist(), strict=True):
            found = dict(zip(rows.mass_names, row, strict=False))
            if any(found.get(name, at) != at for name, at in self._standing.displacements.items()):
                known = {n: found.get(n, at) for n, at in self._standing.displacements.items()}
                self._standing = replace(self._standing, displacements=known)
                yield self.now(t)

    def estimated(self, t: float, data: Mapping[str, Any]) -> Iterator[tuple[float, Update]]:
        """Yield the scene after an event whose data state the centre of mass."""
        com = np.array(data.get(COM_KEY, [None] * 3), float)
        if np.isfinite(com).all():
            home = com - com_shift(self._bed, self._standing.displacements)
            sd = np.array(data.get(SD_KEY, [None] * 3), float)
            self._standing = replace(self._standing, com_home=home, sd=sd)
            yield self.now(t)

    def now(self, t: float) -> tuple[float, Update]:
        """Return the scene as it stands, at a time (s)."""
        self._shown = True
        self._standing = standing = enlarged(self._bed, self._standing)
        return t, lambda stamp: scene_update(self._bed, standing, self._messages, stamp)


def com_shift(testbed: Testbed, displacements: Mapping[str, float]) -> Vector3:
    """Return by how much masses out of home shift the centre of mass, m."""
    parts = [m.mass * m.gain * displacements[m.name] * m.axis for m in testbed.masses]
    return np.sum([np.zeros(3), *parts], axis=0) / testbed.body.mass


def radius_of(masses: Sequence[SlidingMass]) -> float:
    """Return how far from the centre of rotation masses get, m; the disc is so large."""
    ends = [mass.home + way * mass.axis for mass in masses for way in mass.travel]
    return max([SMALLEST, *(float(np.linalg.norm(end)) for end in ends)])


def enlarged(testbed: Testbed, standing: Standing) -> Standing:
    """Return the same with its factor: 1, 2 or 5 times a power of ten, steady, never below 1."""
    com = standing.com_home + com_shift(testbed, standing.displacements)
    known = standing.sd[np.isfinite(standing.sd)]
    length = float(np.linalg.norm(com)) + float(max([0.0, *known]))
    radius, before = radius_of(testbed.masses), standing.factor
    if not length or (before and KEPT[0] < length * before / radius < KEPT[1]):
        return replace(standing, factor=before or 1.0)
    power = 10.0 ** math.floor(math.log10(WIDEST * radius / length))
    digit = max(d for d in (1, 2, 5) if d * power * length <= WIDEST * radius * (1 + 1e-9))
    return replace(standing, factor=max(1.0, digit * power))


def scene_update(testbed: Testbed, standing: Standing, messages: Any, stamp: Any) -> Any:
    """Return the whole scene as Foxglove's message."""
    draw = _Drawing(messages, stamp, radius_of(testbed.masses))
    entities = [
        _platform(draw, testbed.up), _masses(draw, testbed, standing.displacements),
        _com(draw, testbed, standing), _gravity(draw),
    ]  # fmt: skip
    return messages.SceneUpdate(entities=entities)


@dataclass(frozen=True, slots=True, eq=False)
class _Drawing:
    """Foxglove's parts, made of our numbers."""

    messages: Any
    stamp: Any
    radius: float  # m, of the platform

    def entity(self, name: str, frame: str, **parts: Any) -> Any:
        return self.messages.SceneEntity(
            id=name, frame_id=frame, frame_locked=True, timestamp=self.stamp, **parts
        )

    def pose(self, at: Vector3, turn: Sequence[float] = UPRIGHT) -> Any:
        x, y, z = map(float, at)
        w, i, j, k = turn
        return self.messages.Pose(
            position=self.messages.Vector3(x=x, y=y, z=z),
            orientation=self.messages.Quaternion(x=i, y=j, z=k, w=w),
        )

    def size(self, *lengths: float) -> Any:
        x, y, z = map(float, lengths)
        return self.messages.Vector3(x=x, y=y, z=z)

    def colour(self, of: Sequence[float]) -> Any:
        r, g, b, a = of
        return self.messages.Color(r=r, g=g, b=b, a=a)

    def ball(self, at: Vector3, lengths: Sequence[float], of: Sequence[float]) -> Any:
        return self.messages.SpherePrimitive(
            pose=self.pose(at), size=self.size(*lengths), color=self.colour(of)
        )

    def line(self, points: Sequence[Vector3], of: Sequence[float]) -> Any:
        ends = [self.messages.Point3(x=x, y=y, z=z) for x, y, z in np.array(points).tolist()]
        return self.messages.LinePrimitive(
            type=self.messages.LinePrimitiveLineType.LineList, pose=self.pose(np.zeros(3)),
            thickness=0.01 * self.radius, points=ends, color=self.colour(of),
        )  # fmt: skip

    def text(self, at: Vector3, text: str, of: Sequence[float]) -> Any:
        return self.messages.TextPrimitive(
            pose=self.pose(at), billboard=True, font_size=0.1 * self.radius,
            color=self.colour(of), text=text,
        )  # fmt: skip


def _platform(draw: _Drawing, up: Vector3) -> Any:
    r = draw.radius
    disc = draw.messages.CylinderPrimitive(
        pose=draw.pose(np.zeros(3), _z_to(up)), size=draw.size(2 * r, 2 * r, 0.1 * r),
        bottom_scale=1.0, top_scale=1.0, color=draw.colour(GREY),
    )  # fmt: skip
    return draw.entity("platform", BODY, cylinders=[disc])


def _masses(draw: _Drawing, testbed: Testbed, displacements: Mapping[str, float]) -> Any:
    """Return a cube and a name for each mass, on a line as long as its travel."""
    cubes, rails, names = list[Any](), list[Vector3](), list[Any]()
    for mass in testbed.masses:
        at = mass.home + displacements[mass.name] * mass.axis
        cube = draw.messages.CubePrimitive(
            pose=draw.pose(at), size=draw.size(*[0.13 * draw.radius] * 3), color=draw.colour(ORANGE)
        )
        cubes.append(cube)
        rails += [mass.home + way * mass.axis for way in mass.travel]
        names.append(draw.text(at + 0.13 * draw.radius * testbed.up, mass.name, ORANGE))
    lines = [draw.line(rails, ORANGE)] if rails else []
    return draw.entity("masses", BODY, cubes=cubes, lines=lines, texts=names)


def _com(draw: _Drawing, testbed: Testbed, standing: Standing) -> Any:
    """Return the centre of mass, a line to it from the centre of rotation, and the ellipsoid."""
    com = standing.com_home + com_shift(testbed, standing.displacements)
    at, known = com * standing.factor, bool(np.isfinite(standing.sd).all() and standing.sd.any())
    balls = [draw.ball(at, [0.04 * draw.radius] * 3, RED)]
    if known:
        balls.append(draw.ball(at, (2 * standing.factor * standing.sd).tolist(), PINK))
    factor = f"{standing.factor:,.0f}".replace(",", " ")
    text = f"centre of mass x {factor}" + ", ellipsoid 1 sd" * known
    words = draw.text(at + 0.1 * draw.radius * testbed.up, text, RED)
    return draw.entity(
        "centre of mass", BODY, spheres=balls, lines=[draw.line([0 * at, at], RED)], texts=[words]
    )


def _gravity(draw: _Drawing) -> Any:
    r = draw.radius
    arrow = draw.messages.ArrowPrimitive(
        pose=draw.pose(np.zeros(3), X_TO_DOWN), shaft_length=0.4 * r, shaft_diameter=0.03 * r,
        head_length=0.1 * r, head_diameter=0.07 * r, color=draw.colour(BLUE),
    )  # fmt: skip
    word = draw.text(np.array([0.0, 0.0, -0.58 * r]), "g", BLUE)
    return draw.entity("gravity", LABORATORY, arrows=[arrow], texts=[word])


def _z_to(up: Vector3) -> tuple[float, float, float, float]:
    """Return the shortest turn of the axis z to a unit vector; about x where that is down."""
    x, y, z = map(float, up)
    turn = (1.0 + z, -y, x, 0.0)
    length = math.hypot(*turn)
    if length < 1e-9:
        return 0.0, 1.0, 0.0, 0.0
    w, i, j, k = (part / length for part in turn)
    return w, i, j, k
