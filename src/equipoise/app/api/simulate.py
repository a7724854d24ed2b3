"""Simulate: what the sensors of a simulated platform record."""

from collections.abc import Mapping, Sequence
from typing import overload

from equipoise.app.arguments.checks import duration_of, positive, seed_of
from equipoise.app.arguments.inputs import AnyPlan, AnyTestbed, plan_from, testbed_from
from equipoise.model.errors import InputError
from equipoise.model.recording import Recording
from equipoise.simulation.carried_out import performed
from equipoise.simulation.series import seeds_of, with_drawn_platform

USUAL = 120.0  # s


Moves = Sequence[tuple[float, Mapping[str, float]]]


@overload
def simulate(
    testbed: AnyTestbed,
    *,
    duration: float | None = None,
    moves: Moves = (),
    plan: AnyPlan | None = None,
    seed: int = 1,
    series: None = None,
) -> Recording: ...


@overload
def simulate(
    testbed: AnyTestbed,
    *,
    duration: float | None = None,
    moves: Moves = (),
    plan: AnyPlan | None = None,
    seed: int = 1,
    series: int,
) -> list[Recording]: ...


def simulate(
    testbed: AnyTestbed,
    *,
    duration: float | None = None,
    moves: Moves = (),
    plan: AnyPlan | None = None,
    seed: int = 1,
    series: int | None = None,
) -> Recording | list[Recording]:
    """Return the recording of a simulated platform in free motion or in a planned manoeuvre.

    A series is of one platform, each run with a start and noise of its own.

    Parameters
    ----------
    testbed
        Testbed, its file, or a preset's name. Its [truth] says what the platform is like.
    duration
        Length of the recording, s: 120, or as the plan has it.
    moves
        Moves of masses, each a time (s) and displacements from home (m) by mass, in order of time:
        ``[(60.0, {"x1": -0.010})]``.
    plan
        Plan, or its file: how the platform is let go, by a hand that errs, and what follows.
    seed
        Seed of all that is drawn: the same seed gives the same recording.
    series
        Return a list of so many runs of the platform that the seed draws; their seeds follow the
        first. None: one recording.

    Raises
    ------
    InputError
        For files that cannot be read, ``plan`` beside ``moves`` or ``duration``, and times out of
        order.
    MoveRefused
        For a move beyond the travel of a mass.
    """
    bed, drawn = testbed_from(testbed), seed_of(seed)
    if plan is not None and (moves or duration is not None):
        raise InputError("plan", "moves or duration beside it", "the plan alone")
    length = duration_of("duration", USUAL if duration is None else duration, bed)
    manoeuvre = None if plan is None else plan_from(plan, bed).manoeuvre

    if series is None:
        return performed(bed, drawn, manoeuvre, length, moves)[1]
    runs, platform = int(positive("series", series)), with_drawn_platform(bed, drawn)
    seeds = seeds_of(runs, drawn)
    return [performed(platform, each, manoeuvre, length, moves)[1] for each in seeds]
