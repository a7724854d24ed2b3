"""Simulate: what the sensors of a simulated platform record."""

from collections.abc import Mapping, Sequence

from equipoise.app.arguments.checks import positive, seed_of
from equipoise.app.arguments.inputs import AnyPlan, AnyTestbed, plan_from, testbed_from
from equipoise.model.errors import InputError
from equipoise.model.recording import Recording
from equipoise.simulation.carried_out import record, simulated

USUAL = 120.0  # s


def simulate(
    testbed: AnyTestbed,
    *,
    duration: float | None = None,
    moves: Sequence[tuple[float, Mapping[str, float]]] = (),
    plan: AnyPlan | None = None,
    seed: int = 1,
) -> Recording:
    """Return the recording of a simulated platform in free motion or in a planned manoeuvre.

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

    Raises
    ------
    InputError
        For files that cannot be read, ``plan`` beside ``moves`` or ``duration``, and times out of
        order.
    MoveRefused
        For a move beyond the travel of a mass.
    """
    bed, drawn = testbed_from(testbed), seed_of(seed)
    if plan is None:
        length = positive("duration", USUAL if duration is None else duration)
        return record(bed, length, moves, drawn)
    if moves or duration is not None:
        raise InputError("plan", "moves or duration beside it", "the plan alone")
    return simulated(bed, plan_from(plan, bed).manoeuvre, drawn)
