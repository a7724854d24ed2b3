"""How `balance --manual --then-masses` is carried out: weights by a person, the rest by masses."""

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from equipoise.app.arguments.options import Searching
from equipoise.app.commands.by_hand import Request, filed_session
from equipoise.app.commands.on_bench import OnBench, let_go, prepare
from equipoise.app.console.terminal import announced, busy
from equipoise.model.errors import InputError

if TYPE_CHECKING:
    from equipoise.app.runs.balancing import Limits
    from equipoise.app.runs.joint_balancing import InTwoLevels
    from equipoise.model.testbed import Testbed


@dataclass(frozen=True, slots=True)
class Masses:
    """How the masses go on."""

    law: str
    until: tuple[int | None, float | None, float]  # moves, s, s of holding
    searching: Searching
    on_bench: OnBench


def balance_then_masses(requested: Request, masses: Masses) -> int:
    """Carry a balancing in two levels out, or one step of it, and return the exit code."""
    from equipoise.app.arguments.checks import check_outputs, positive
    from equipoise.app.arguments.inputs import testbed_from
    from equipoise.procedure.balancing.hands_then_masses import check

    rounds = int(positive("--max-rounds", requested.by.max_rounds))
    _check(requested, masses.on_bench)
    bed = announced(testbed_from(requested.testbed))
    check(bed)
    check_outputs(requested.out)
    limits = _limits(masses, bed)
    if requested.by.session is not None:
        return _a_persons(requested, requested.by.session, bed, rounds, (limits, masses.on_bench))
    with busy("preparing the bench", announce=False):
        from equipoise.app.runs.joint_balancing import run
        from equipoise.app.runs.terminal_waiting import show_step
        from equipoise.simulation.hands import SimulatedHands

        hands = SimulatedHands(bed, requested.seed)
    show = None if requested.json else show_step
    done = run(hands, requested.goal, limits, rounds, show)
    return _code(done, {"testbed": bed.source, "seed": str(requested.seed)}, requested)


def _check(requested: Request, on_bench: OnBench) -> None:
    """Raise InputError for options that do not go together."""
    if on_bench.bench and requested.by.session is None:
        wanted = "the session in which weights were placed, --session FILE"
        raise InputError("--then-masses --bench", "no --session", wanted)
    if on_bench.bench and requested.by.recording is not None:
        raise InputError("--recording", "--bench", "one after the other: first the recording")


def _limits(masses: Masses, bed: "Testbed") -> "Limits":
    """Return the limits of the masses' law; InputError for one that the testbed does not allow."""
    from equipoise.app.arguments.checks import one_of
    from equipoise.app.runs.balancing import Limits
    from equipoise.app.runs.terminal_waiting import budget_at_terminal
    from equipoise.procedure.balancing.catalogue import CARDS
    from equipoise.procedure.balancing.run_law import check

    law = one_of("--law", masses.law, list(CARDS))
    check(CARDS[law], bed)
    return Limits(*masses.until, law, budget=budget_at_terminal(masses.searching))


def _a_persons(
    requested: Request,
    path: Path,
    bed: "Testbed",
    rounds: int,
    masses: "tuple[Limits, OnBench]",
) -> int:
    """Take the next recording of a session, or let the masses go on, and say what to do next."""
    from equipoise.app.console.rich_blocks import show
    from equipoise.app.runs.joint_balancing import and_then, next_deed, resume
    from equipoise.app.runs.manual_balancing import noted
    from equipoise.app.runs.terminal_waiting import show_step
    from equipoise.app.text.blocks import Paragraph
    from equipoise.io.documents.manual_session import write_session

    limits, on_bench = masses
    filed = filed_session(requested, path, bed, rounds)
    shown = None if requested.json else show_step
    done, placed = resume(filed, requested.goal, shown)
    write_session(noted(filed, placed), path)
    deed = next_deed(done, filed, path, len(placed) + 1)
    if on_bench.bench:
        known = done.known
        if known is None:
            found = "a platform that is still out of reach of its masses"
            raise InputError(
                "--bench",
                found,
                deed or "a session whose weights brought the platform within reach",
            )
        prepare(known, requested.goal, limits, on_bench)
        with let_go(known, on_bench) as bench:
            done = and_then(done, bench, limits, shown)
    code = _code(done, {"testbed": bed.source, "session": str(path)}, requested)
    if deed and done.by_masses is None and not requested.json:
        show((Paragraph(deed),))
    return code


def _code(done: "InTwoLevels", of: dict[str, str], requested: Request) -> int:
    """Hand the result over, keep it once the verdict is there, and return the exit code."""
    from equipoise.app.logbook.output import hand_over, keep
    from equipoise.app.views.balancing.joint_views import output_of

    output = output_of(done, of)
    hand_over(output, requested.json, requested.out, below=True)
    if requested.out is None and done.ended:
        keep(output, done.by_hand.balancing.testbed.name)
    if done.by_masses is not None and done.by_masses.stopped_with:
        return done.by_masses.stopped_with
    return 0 if done.verdict is None or done.verdict.passed else 1
