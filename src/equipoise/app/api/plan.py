"""Plan: the manoeuvre whose recording carries most information."""

import math
from collections.abc import Sequence
from typing import Literal

from equipoise.app.arguments import checks, inputs
from equipoise.app.runs import planning
from equipoise.app.runs.planning import Planning, Request

RATE = math.radians(10.0)


def plan(
    testbed: inputs.AnyTestbed,
    *,
    duration: float = 120.0,
    quantity: Literal["J", "r", "both"] = "both",
    criterion: Literal["A", "D"] = "A",
    moves: int = 3,
    max_rate: float = RATE,
    earlier: inputs.AnyRecording | None = None,
    terms: Sequence[str] = (),
    hold: Sequence[str] = (),
    use_prior: bool = False,
    trials: int = 2400,
    seed: int = 1,
) -> Planning:
    """Choose a start and moves of masses so that the recording carries most information.

    The result has ``usual`` and ``planned``, each with its predicted sd, and ``plan``, which
    ``simulate``, ``identify`` and ``balance`` take. The default number of trials takes
    about a minute.

    Parameters
    ----------
    testbed
        Testbed, its file, or a preset's name.
    duration
        Length of the recording to plan, s.
    quantity
        What is wanted: J, the inertia; r, the centre of mass with masses at home; or both.
    criterion
        A: the mean square of sd, in 1 % of a moment and 1 um; D: the volume of the ellipsoid.
    moves
        How many times masses are moved.
    max_rate
        Greatest rate of the platform, rad/s.
    earlier
        A recording made before, or its file: what it shows is known, masses stand where it ended.
    terms
        Torques to estimate too: viscous, quadratic, constant, swirl, sag or drift.
    hold
        Parameters to keep at the testbed's value, such as inertia_P_zz.
    use_prior
        Use the testbed's inertia and centre of mass with their sd.
    trials
        How many manoeuvres to try.
    seed
        Seed of the search and of the platforms: the same seed plans the same.

    Raises
    ------
    InputError
        For files that cannot be read, unknown names, a testbed without a sensor, an earlier
        recording whose estimate is not usable, and limits that even the mildest manoeuvres pass on
        many platforms.
    """
    bed, requested = inputs.testbed_from(testbed), inputs.options_from(terms, hold, use_prior)
    request = Request(
        bed,
        checks.duration_of("duration", duration, bed),
        quantity,
        criterion,
        int(checks.not_negative("moves", moves)),
        checks.positive("max_rate", max_rate),
        requested,
        None if earlier is None else inputs.recording_from(earlier, bed),
        int(checks.positive("trials", trials)),
        checks.seed_of(seed),
    )
    return planning.run(request)
