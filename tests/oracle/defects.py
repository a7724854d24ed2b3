"""Known defects of a record: what is wrong, by how much and when, drawn from a seed. Development.

    contact     the platform touches something: an impulse of angular momentum about P
    com step    a part slips: the whole centre of mass goes elsewhere
    bad row     one row of the camera is another attitude
    last row    the last row is one frame and not a mean
    averaging   each row is the normalised mean of frames
    plumb       the camera's laboratory leans:        measured = exp((a_x, a_y, 0)) (x) true
    heading     an error that turns with the heading:
                measured = true (x) exp(sum_k c_k cos(k psi) + s_k sin(k psi))
    gyro        w_measured = (E + M) w + b
    quantum     the gyro's rates are whole multiples of one
    delay       the camera's row t shows what was at t - delay, on the clock of gyro and masses

Rotation vectors on the left are in laboratory axes, on the right in body axes. The heading psi is
atan2 of the laboratory's y and x components of *body x*, which is perpendicular to up on every
platform here (up is body z or body y).

Each kind has a stream of its own: a kind is the same alone or with others.
"""

from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Range = tuple[float, float]

CONTACTS, COM_STEPS, BAD_ROWS, LAST_ROW, AVERAGING, PLUMB, HEADING, GYRO, QUANTUM, DELAY = KINDS = (
    "contacts", "com_steps", "bad_rows", "last_row", "averaging",
    "plumb", "heading", "gyro", "quantum", "delay",
)  # fmt: skip
FRAMES, FRAME_GAP = 4, 0.025  # -, s: as the published motion capture record shows them
SIXTEENTH = float(np.deg2rad(1 / 16))  # rad/s, a usual last digit of low-cost gyros
MARGIN = 0.04  # of the record at either end is left alone, chosen: a defect there says nothing


@dataclass(frozen=True, slots=True, eq=False)
class Contact:
    """A torque pulse: constant for its duration."""

    time: float  # s, where it begins
    duration: float  # s
    impulse: Array  # N m s, about P, laboratory axes


@dataclass(frozen=True, slots=True, eq=False)
class ComStep:
    """A part that goes elsewhere along the smooth ramp."""

    time: float  # s, where it begins
    duration: float  # s
    shift: Array  # m, of the total centre of mass, body axes


@dataclass(frozen=True, slots=True, eq=False)
class BadRow:
    """A row of the camera that is an outlier."""

    time: float  # s, the row's stamp
    turn: Array  # rad, body axes


@dataclass(frozen=True, slots=True, eq=False)
class Harmonic:
    """One harmonic of the heading in the camera's error."""

    order: int
    cosine: Array  # rad, laboratory axes
    sine: Array  # rad, laboratory axes


@dataclass(frozen=True, slots=True, eq=False)
class Defects:
    """What is wrong with a record; nothing by default."""

    contacts: tuple[Contact, ...] = ()
    com_steps: tuple[ComStep, ...] = ()
    bad_rows: tuple[BadRow, ...] = ()
    last_row_single: bool = False  # the first frame of the last mean stands for it
    frames: int = 1  # in a row
    frame_gap: float = FRAME_GAP  # s
    plumb: Array = field(default_factory=lambda: np.zeros(2))  # rad, a_x and a_y
    heading: tuple[Harmonic, ...] = ()
    gyro_matrix: Array = field(default_factory=lambda: np.zeros((3, 3)))  # M
    gyro_bias: Array = field(default_factory=lambda: np.zeros(3))  # rad/s
    gyro_quantum: float = 0.0  # rad/s, 0: none
    camera_delay: float = 0.0  # s

    def com_shift(self, t: float) -> Array:
        """Return by how much the centre of mass has stepped away before ``t`` (s), m."""
        return sum((s.shift for s in self.com_steps if s.time <= t), np.zeros(3))


@dataclass(frozen=True, slots=True)
class Ranges:
    """How large defects are drawn, and how many."""

    contacts: tuple[int, int] = (1, 4)
    impulse: Range = (0.2e-3, 2e-3)  # N m s
    pulse: Range = (0.010, 0.050)  # s
    com_steps: tuple[int, int] = (1, 2)
    shift: Range = (1e-6, 5e-6)  # m
    slip: float = 0.050  # s
    bad_share: float = 0.01  # of the rows
    bad_turn: Range = (np.deg2rad(1.0), np.deg2rad(20.0))
    plumb: Range = (np.deg2rad(0.1), np.deg2rad(0.5))
    orders: tuple[int, ...] = (2, 3)
    heading: Range = (np.deg2rad(0.05), np.deg2rad(0.15))
    scale: float = 0.01  # sd of a gyro's scale error
    misalignment: float = np.deg2rad(0.3)  # sd of the gyro's turn about each axis
    bias: float = np.deg2rad(0.1)  # rad/s, sd
    quantum: float = SIXTEENTH
    delay: Range = (0.010, 0.060)  # s


def vector(rng: np.random.Generator, size: Range, length: int = 3) -> Array:
    """Return a vector in a random direction, its length uniform in a range."""
    way = rng.standard_normal(length)
    return rng.uniform(*size) * way / np.linalg.norm(way)


def _times(rng: np.random.Generator, count: tuple[int, int], duration: float) -> Array:
    edge = MARGIN * duration
    n = rng.integers(count[0], count[1], endpoint=True)
    return np.sort(np.round(rng.uniform(edge, duration - edge, n), 3))


def contacts(rng: np.random.Generator, r: Ranges, duration: float) -> tuple[Contact, ...]:
    times = _times(rng, r.contacts, duration)
    return tuple(Contact(t, rng.uniform(*r.pulse), vector(rng, r.impulse)) for t in times)


def com_steps(rng: np.random.Generator, r: Ranges, duration: float) -> tuple[ComStep, ...]:
    times = _times(rng, r.com_steps, duration)
    return tuple(ComStep(t, r.slip, vector(rng, r.shift)) for t in times)


def bad_rows(
    rng: np.random.Generator, r: Ranges, duration: float, rate: float
) -> tuple[BadRow, ...]:
    """Return outliers at stamps of a camera of this rate (Hz), never its first or last."""
    rows = round(duration * rate)
    n = max(1, round(r.bad_share * rows))
    k = np.sort(rng.choice(np.arange(2, rows - 1), n, replace=False))
    return tuple(BadRow(i / rate, vector(rng, r.bad_turn)) for i in k)


def harmonics(rng: np.random.Generator, r: Ranges) -> tuple[Harmonic, ...]:
    return tuple(Harmonic(k, vector(rng, r.heading), vector(rng, r.heading)) for k in r.orders)


def gyro_matrix(rng: np.random.Generator, r: Ranges) -> Array:
    """Return M: scale errors, and w x turn for a gyro that sits turned in the body."""
    x, y, z = rng.normal(0.0, r.misalignment, 3)
    turned = np.array([[0.0, z, -y], [-z, 0.0, x], [y, -x, 0.0]])
    return np.diag(rng.normal(0.0, r.scale, 3)) + turned


def drawn(
    rng: np.random.Generator,
    kinds: tuple[str, ...],
    duration: float,
    camera_rate: float,
    ranges: Ranges | None = None,
) -> Defects:
    """Return defects of these kinds for a record of ``duration`` (s)."""
    r = ranges or Ranges()
    if unknown := set(kinds) - set(KINDS):
        raise ValueError(f"no such kinds of defect: {sorted(unknown)}; there are {KINDS}")
    own = dict(zip(KINDS, rng.spawn(len(KINDS)), strict=True))
    made = {
        CONTACTS: lambda: {"contacts": contacts(own[CONTACTS], r, duration)},
        COM_STEPS: lambda: {"com_steps": com_steps(own[COM_STEPS], r, duration)},
        BAD_ROWS: lambda: {"bad_rows": bad_rows(own[BAD_ROWS], r, duration, camera_rate)},
        LAST_ROW: lambda: {"frames": FRAMES, "last_row_single": True},
        AVERAGING: lambda: {"frames": FRAMES},
        PLUMB: lambda: {"plumb": vector(own[PLUMB], r.plumb, 2)},
        HEADING: lambda: {"heading": harmonics(own[HEADING], r)},
        GYRO: lambda: {
            "gyro_matrix": gyro_matrix(own[GYRO], r),
            "gyro_bias": own[GYRO].normal(0.0, r.bias, 3),
        },
        QUANTUM: lambda: {"gyro_quantum": r.quantum},
        DELAY: lambda: {"camera_delay": own[DELAY].uniform(*r.delay)},
    }
    found = Defects()
    for kind in kinds:
        found = replace(found, **made[kind]())
    return found
