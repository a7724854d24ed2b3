"""Masses that follow a platform's tilt and its drift, once a law has found sag and drift.

Masses that stand still leave what no centre of mass trims of the sag (``dynamics.sag_trim``). With
n = g_B / g, masses that shift the centre of mass by

    s(n, t) = s_0 - d (t - t_0) - (E - n n^T) (trim + C n)

leave nothing of it: m g (r + s + C n) x n = m g target x n. What lies along n turns nothing and is
left out, so the shift is the least that does it: 0.17 um at 20 deg for a deck that sinks by 25 um.

Cannot see what C and d were found wrong by; nothing is estimated here.
"""

from dataclasses import dataclass

from equipoise.control.law import Law, LawCard
from equipoise.control.sample import Sample
from equipoise.dynamics.sag_trim import trimming_shift
from equipoise.model.arrays import Vector3
from equipoise.model.command import Command
from equipoise.model.estimate import Estimate
from equipoise.model.following import Following

PERIOD = 0.2  # s, chosen: at 3 deg/s and 20 deg the shift changes by 0.04 um, three fine steps

CARD = LawCard(
    "follow",
    "Moves masses with the tilt and the drift that were found before.",
    "Equipoise; the sag that dynamics.sag_trim cannot trim",
    ("masses", "attitude"),
    "what sag and drift were found wrong by",
    "open loop: always",
    PERIOD,
)


@dataclass(frozen=True, slots=True, eq=False)
class Params:
    """What is followed, and until when (s)."""

    following: Following
    end: float


def shift_at(following: Following, down: Vector3, t: float) -> Vector3:
    """Return the shift (m) that is wanted with gravity along ``down`` (unit, body axes) at t, s."""
    moved: Vector3 = following.shift - following.drift * (t - following.t)
    return moved + trimming_shift(following.sag, following.trim, down)


def step(state: None, seen: Sample | Estimate, params: Params) -> tuple[None, Command]:
    """Return the command: the shift for this attitude and time."""
    assert isinstance(seen, Sample)  # no look is ever asked for
    down: Vector3 = seen.gravity / float((seen.gravity @ seen.gravity) ** 0.5)
    over = "masses followed the tilt" if seen.t >= params.end else ""
    return state, Command(shift=shift_at(params.following, down, seen.t), finished=over)


def following_law(following: Following, end: float) -> Law[None, Params]:
    """Return the law that follows what was found until a time, s."""
    return Law(CARD, lambda _testbed, _target: (None, Params(following, end)), step)
