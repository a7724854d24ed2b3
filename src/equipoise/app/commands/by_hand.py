"""Options of a balancing by hand, and how `balance --manual` carries it out."""

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from cyclopts import Parameter

from equipoise.app.arguments.options import WHOLE, Flag, Reading, Whole
from equipoise.app.console.terminal import announced, busy

if TYPE_CHECKING:
    from equipoise.app.runs.balancing import Goal
    from equipoise.app.runs.manual_balancing import ByHand, Filed
    from equipoise.model.testbed import Testbed


@Parameter(name="*")
@dataclass(frozen=True, slots=True)
class Manual:
    """Balancing by a person, for platforms without actuators.

    Attributes
    ----------
    manual
        Instruct a person which weights to place where, recording by recording. Without --session
        the person is simulated.
    session
        File of a real balancing by hand; created if it does not exist.
    recording
        Next free swing of that session.
    max_rounds
        Maximum number of placings.
    then_masses
        For a testbed with weights and sliding masses: a person places weights until the masses can
        correct the rest, then --law takes over. In a --session the masses continue with --bench,
        from what its recordings have shown; without one everything is simulated.
    """

    manual: Flag = False
    session: Path | None = None
    recording: str | None = None
    max_rounds: Whole = 4
    then_masses: Flag = False


MOVED = Manual()


@dataclass(frozen=True, slots=True)
class Request:
    """All that was asked."""

    testbed: str
    goal: "Goal"
    seed: int
    by: Manual
    reading: Reading
    json: bool
    out: Path | None


def is_by_hand(by: Manual, reading: Reading) -> bool:
    """Say whether any option is for a balancing by hand."""
    given = by.manual or by.session or by.recording or by.then_masses
    return bool(given or reading != WHOLE)


def check_by_hand(by: Manual, reading: Reading, others: list[str]) -> None:
    """Raise InputError for options that do not go together."""
    from equipoise.model.errors import InputError

    if not by.manual:
        raise InputError("balance", "options of --manual", "--manual with them")
    if by.recording is None and reading != WHOLE:
        raise InputError(
            "balance", "options for reading a recording, but no recording", "--recording FILE"
        )
    if by.recording is not None and by.session is None:
        raise InputError("--recording", "no --session", "the session's file, --session FILE")
    if others and by.then_masses:
        wanted = "one of them: weights are placed by a person first"
        raise InputError(", ".join(others), "--then-masses", wanted)
    if others:
        raise InputError(
            ", ".join(others), "--manual", "one of them: manual balancing moves nothing by itself"
        )


def balance_by_hand(requested: Request) -> int:
    """Carry a balancing by hand out, or one step of it, and return the exit code."""
    from equipoise.app.arguments.checks import check_outputs, positive
    from equipoise.app.arguments.inputs import testbed_from
    from equipoise.procedure.balancing.balance_manually import check

    rounds = int(positive("--max-rounds", requested.by.max_rounds))
    bed = announced(testbed_from(requested.testbed))
    check(bed)
    check_outputs(requested.out)
    if requested.by.session is not None:
        return _a_persons(requested, requested.by.session, bed, rounds)
    with busy("preparing the bench", announce=False):
        from equipoise.app.runs.manual_balancing import run
        from equipoise.app.runs.terminal_waiting import show_step
        from equipoise.simulation.hands import SimulatedHands

        hands = SimulatedHands(bed, requested.seed)
    done = run(hands, requested.goal, rounds, None if requested.json else show_step)
    return _code(done, {"testbed": bed.source, "seed": str(requested.seed)}, requested)


def _a_persons(requested: Request, path: Path, bed: "Testbed", rounds: int) -> int:
    """Take the next recording of a session, and say what to do next."""
    from equipoise.app.console.rich_blocks import show
    from equipoise.app.runs.manual_balancing import next_deed, noted, resume
    from equipoise.app.runs.terminal_waiting import show_step
    from equipoise.app.text.blocks import Paragraph
    from equipoise.io.documents.manual_session import write_session

    filed = filed_session(requested, path, bed, rounds)
    done, placed = resume(filed, requested.goal, None if requested.json else show_step)
    write_session(noted(filed, placed), path)
    code = _code(done, {"testbed": bed.source, "session": str(path)}, requested)
    if not done.ended and not requested.json:
        show((Paragraph(next_deed(filed, path, len(placed) + 1)),))
    return code


def filed_session(requested: Request, path: Path, bed: "Testbed", rounds: int) -> "Filed":
    """Return a session, new or as it is in its file, with the new recording."""
    from equipoise.app.runs.manual_balancing import begun, opened, with_recording
    from equipoise.io.documents.manual_session import read_session
    from equipoise.io.files.atomic_file import check_writable

    check_writable(path)
    by = requested.by
    filed = begun(requested.testbed, bed, requested.goal, rounds, by.then_masses)
    if path.exists():
        filed = opened(read_session(path), bed, filed.session, str(path))
    if by.recording is None:
        return filed
    return with_recording(filed, by.recording, requested.reading)


def _code(done: "ByHand", of: dict[str, str], requested: Request) -> int:
    """Hand the result over, keep it once the verdict is there, and return the exit code."""
    from equipoise.app.logbook.output import hand_over, keep
    from equipoise.app.views.balancing.manual_views import output_of

    output = output_of(done, of)
    hand_over(output, requested.json, requested.out, below=True)
    if requested.out is None and done.ended:
        keep(output, done.balancing.testbed.name)
    return 0 if done.verdict is None or done.verdict.passed else 1
