"""`equipoise plan`: the most informative manoeuvre."""

from pathlib import Path
from typing import TYPE_CHECKING, Literal

from equipoise.app.arguments.options import (
    IN_PAIR,
    NOTHING_STATED,
    WHOLE,
    Json,
    Reading,
    Seeking,
    Spreading,
    Whole,
)
from equipoise.app.console.terminal import announced, show_paths

if TYPE_CHECKING:
    from equipoise.model.manoeuvre import Plan
    from equipoise.model.testbed import Testbed


def plan(
    testbed: str,
    /,
    *,
    duration_s: float = 120.0,
    quantity: Literal["J", "r", "both"] = "both",
    criterion: Literal["A", "D"] = "A",
    moves: Whole = 3,
    max_rate_deg_s: float = 10.0,
    prior_record: Path | None = None,
    reading: Reading = WHOLE,
    seeking: Seeking = NOTHING_STATED,
    trials: Whole = 2400,
    seed: Whole = 1,
    spreading: Spreading = IN_PAIR,
    write: Path | None = None,
    json: Json = False,
    out: Path | None = None,
) -> int:
    """Plan the most informative manoeuvre for a platform.

    Optimises the release (tilt and rate), times and sizes of moves, and square waves of wheels and
    gyros where present. Limits are kept over platforms drawn from the prior, with release errors of
    1 deg and 0.5 deg/s. Predicted sd are those of a fit in the testbed's model. Exit code 1: not
    all of 300 further platforms keep the limits; 2: even the mildest manoeuvres exceed them too
    often.

    Parameters
    ----------
    testbed
        Testbed file, or a preset's name.
    duration_s
        Length of the record.
    quantity
        Quantity to determine: J, the inertia; r, the centre of mass with masses at home; or both.
    criterion
        A: mean square of the sd, in 1 % of a moment and 1 um; D: volume of the ellipsoid.
    moves
        Number of moves of the masses.
    max_rate_deg_s
        Maximum rate of the platform.
    prior_record
        Earlier recording: its information is included, and masses start where it left them.
    trials
        Number of manoeuvres to try.
    seed
        Seed of the search and of the platforms; the same seed gives the same plan.
    write
        Plan file to write; simulate, identify and balance accept it with --plan.
    out
        Folder for report and plan.json.
    """
    from equipoise.app.arguments import checks
    from equipoise.app.arguments.inputs import (
        check_of_recording,
        fitting_recording_of,
        options_of,
        testbed_from,
    )
    from equipoise.app.arguments.many_runs import engine_from
    from equipoise.model.units import DEG, in_si

    bed, requested = announced(testbed_from(testbed)), options_of(seeking)
    duration = checks.duration_of("--duration-s", duration_s, bed)
    rate = in_si(checks.positive("--max-rate-deg-s", max_rate_deg_s), DEG)
    count = int(checks.not_negative("--moves", moves))
    tries, engine = int(checks.positive("--trials", trials)), engine_from(spreading)
    checks.check_outputs(out, write)
    check_of_recording(reading, prior_record, "--prior-record")
    earlier = None if prior_record is None else fitting_recording_of(prior_record, reading, bed)
    from equipoise.app.logbook.output import hand_over
    from equipoise.app.runs.planning import Request, run
    from equipoise.app.runs.terminal_waiting import at_terminal_by
    from equipoise.app.views.plan_views import output_of

    request = Request(
        bed, duration, quantity, criterion, count, rate, requested, earlier, tries,
        checks.seed_of(seed),
    )  # fmt: skip
    with at_terminal_by(engine) as waiting:
        done = run(request, waiting)
    hand_over(output_of(done), json, out)
    _write(done.plan, bed, write, json)
    return 0 if done.planned.keeps else 1


def _write(plan: "Plan", bed: "Testbed", path: Path | None, json: bool) -> None:
    """Write the plan file where there is to be one, and say so."""
    from equipoise.io.documents.plan_file import write_plan

    if path is not None:
        write_plan(plan, bed, path)
        show_paths([path], json)
