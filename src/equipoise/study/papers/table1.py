"""Table 1 of da Silva et al. (2021): thirteen testbeds, and how each is balanced here.

Each testbed is a preset, whose platform is drawn anew with each seed. Each is balanced by the
method that the table names, as it is run here, and by the best of ours that its devices allow.

    law           of ``equipoise laws``
    compensation  a swing, an estimate by a printed method, a move by it; again
    placing       weights by hand, where ``balance --manual`` says; without motors there is no other
    feed_forward  no masses: gyros turn the platform, a method finds the centre of mass from that,
                  and their torque holds against it. What is left is the torque of its error.

A preset's numbers are printed in the review where it says so. The others are assumed, such that the
result that is printed is within reach: a row shows what methods do, and not what hardware did.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from equipoise.model.estimate import INERTIA
from equipoise.model.testbed import Testbed

Way = Literal["law", "compensation", "placing", "feed_forward"]
Kind = Literal["torque", "offset"]

TILT = float(np.radians(20.0))  # rad, chosen: of the range over which the torque counts


@dataclass(frozen=True, slots=True)
class Procedure:
    """A way to balance, and which law or method."""

    way: Way
    name: str = ""  # of the law or of the method; empty: there is but one
    hold: tuple[str, ...] = ()  # parameters that the method takes from the testbed


@dataclass(frozen=True, slots=True)
class Reached:
    """What the table prints as the result."""

    kind: Kind
    value: float  # N m or m


@dataclass(frozen=True, slots=True)
class Entry:
    """A row of the table."""

    preset: str
    institution: str
    method: str  # as the table names it
    own: Procedure
    best: Procedure
    reached: Reached | None = None  # None: not printed
    tolerance: tuple[float, float, float] = (2.0, 2.0, 3.0)  # um, that our procedure is asked for
    tilt: float = TILT  # rad
    cause: str = ""  # why its own method, as run here, leaves more than is printed


@dataclass(frozen=True, slots=True, eq=False)
class Trial:
    """One platform of an entry, to be balanced by one procedure."""

    entry: Entry
    procedure: Procedure
    testbed: Testbed
    seed: int


@dataclass(frozen=True, slots=True)
class Left:
    """What one run leaves, by the truth."""

    torque: float  # N m, rms over directions within the entry's tilt of level
    offset: float  # m, of the centre of mass from that of rotation
    before: float  # N m, rms, before the run
    time: float  # s on the bench's clock


LSM = Procedure("compensation", "simplified_increments")
FEW_ROWS = (
    "500 rows show the height of a nearly balanced platform to some um, and it is not "
    "levelled before the next"
)
TWO_STEPS = Procedure("law", "underactuated")
OURS = Procedure("law", "measure_and_move")
PLACING = Procedure("placing")

TABLE1 = (
    Entry("georgia-tech", "Georgia Tech", "recursive LSM, CM compensation",
          Procedure("feed_forward", "momentum_recursive"),
          Procedure("feed_forward", "trajectory")),
    Entry("cubesat-tas", "Naval Postgraduate School", "two-step", TWO_STEPS, OURS),
    Entry("unb", "University of Brasilia", "LSM, iterative CM compensation", LSM, OURS,
          Reached("torque", 3.5e-5), (0.3, 0.3, 0.5), cause=FEW_ROWS),
    Entry("bologna", "University of Bologna", "two-step, iterative CM compensation", TWO_STEPS,
          OURS, Reached("torque", 5e-5), (0.4, 0.4, 0.8)),
    Entry("florida", "University of Florida", "manual", PLACING, PLACING),
    Entry("harbin", "Harbin Institute of Technology", "LSM, iterative CM compensation", LSM, OURS,
          Reached("offset", 5e-6), cause=FEW_ROWS),
    Entry("unam", "UNAM", "LSM", LSM, OURS, Reached("torque", 2e-3)),
    Entry("honeywell", "Honeywell", "LSM", LSM, OURS, Reached("offset", 60.96e-6),
          (25.0, 25.0, 30.0)),
    Entry("knt", "K. N. Toosi University of Technology", "Kalman filter",
          Procedure("compensation", "kf_simplified"), OURS),
    Entry("virginia-tech", "Virginia Tech", "LSM",
          Procedure("compensation", "momentum_body", INERTIA), OURS),
    Entry("vietnam", "Vietnam NSC", "adaptive estimation, L1 adaptive control",
          Procedure("law", "l1_adaptive"), OURS, Reached("offset", 5e-7), (0.3, 0.3, 0.4)),
    Entry("sydney", "University of Sydney", "manual, x and y only", PLACING, PLACING,
          tolerance=(2.0, 2.0, 1e5), tilt=0.0),
    Entry("aalto", "Aalto University", "manual", PLACING, PLACING),
)  # fmt: skip


def trials_of(entry: Entry, testbed: Testbed, seeds: Sequence[int]) -> list[Trial]:
    """Return all platforms of an entry by its own method, then all by ours; by hand these are one.

    ``testbed`` is that of the entry's preset.
    """
    ways = (entry.own, entry.best) if entry.own != entry.best else (entry.best,)
    return [Trial(entry, way, testbed, seed) for way in ways for seed in seeds]
