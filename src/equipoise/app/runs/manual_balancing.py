"""One balancing by hand: simulated from end to end, or a person's as far as it has come."""

import shlex
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from equipoise.app.arguments.inputs import fitting_recording_of
from equipoise.app.arguments.options import Reading
from equipoise.app.console.terminal import watched
from equipoise.app.runs.balancing import Balancing, Goal
from equipoise.app.runs.waiting import shown
from equipoise.app.text.com_estimate import ComEstimate
from equipoise.io.documents.manual_session import Piles, Round, Session
from equipoise.io.toml.write_toml import as_written
from equipoise.model.arrays import Ints
from equipoise.model.errors import InputError
from equipoise.model.hands import Awaited, Hands
from equipoise.model.mass_properties import MassProperties
from equipoise.model.placing import Placing
from equipoise.model.recording import Recording
from equipoise.model.step import Step
from equipoise.model.testbed import Testbed
from equipoise.model.units import UM
from equipoise.model.verdict import Verdict
from equipoise.procedure.balancing.balance_manually import HandOptions, balance_by_hand
from equipoise.simulation.hands import SimulatedHands

Show = Callable[[Step], None] | None
Procedure = Callable[[Hands, HandOptions], Iterator[Step]]
LET_GO = (
    "Hold the platform still and nearly level, start recording, release it, and catch "
    "it at the tilt limit or after one minute. Cut off the handling (--from-s, "
    "--to-s). Then:"
)


@dataclass(frozen=True, slots=True, eq=False)
class Filed:
    """A person's session, with what its names stand for."""

    session: Session
    testbed: Testbed
    recordings: Sequence[Recording]
    placed: Sequence[Ints | None]


class FiledHands:
    """The verbs of ``model.hands.Hands``, played back; a placing not filed yet is as requested."""

    def __init__(
        self, testbed: Testbed, recordings: Sequence[Recording], placed: Sequence[Ints | None]
    ) -> None:
        self.testbed = testbed  # as stated, without any weights
        self._recordings, self._filed = recordings, placed
        self.placed: list[Ints] = []
        self.swings = 0

    @property
    def time(self) -> float:
        """Time recorded so far, s."""
        spans = [recording.span for recording in self._recordings[: self.swings]]
        return sum(end - start for start, end in spans)

    def swing(self) -> Recording:
        """Return the next recording."""
        if self.swings == len(self._recordings):
            raise Awaited
        self.swings += 1
        return self._recordings[self.swings - 1]

    def place(self, wanted: Ints) -> Ints:
        """Return how the platform was loaded after the last recording."""
        filed = self._filed[len(self.placed)] if len(self.placed) < len(self._filed) else None
        self.placed.append(wanted if filed is None else filed)
        return self.placed[-1]


@dataclass(frozen=True, slots=True, eq=False)
class ByHand:
    """What was done so far."""

    balancing: Balancing
    placings: Sequence[Placing]
    recorded: float  # s
    ended: bool

    @property
    def verdict(self) -> Verdict | None:
        """Return the last word, if it has been said."""
        return self.balancing.verdict if self.ended else None


def options_of(goal: Goal, rounds: int) -> HandOptions:
    """Return the options of the procedure."""
    return HandOptions(goal.target, goal.tolerance, rounds)


def run(
    hands: SimulatedHands,
    goal: Goal,
    rounds: int,
    show: Show,
    procedure: Procedure = balance_by_hand,
) -> ByHand:
    """Balance a simulated platform, show each step as it comes."""
    before, truths = hands.truth(), list[MassProperties]()
    steps: list[Step] = []
    awaited = watched(procedure(hands, options_of(goal, rounds)), "balancing")
    for step in shown(awaited, show):
        steps.append(step)
        truths.append(hands.truth())
    return summary(hands, goal, steps, before, truths)


def resume(
    filed: Filed, goal: Goal, show: Show, procedure: Procedure = balance_by_hand
) -> tuple[ByHand, list[Ints]]:
    """Play a session back as far as it has come; return it, and what lies where since."""
    hands = FiledHands(filed.testbed, filed.recordings, filed.placed)
    awaited = procedure(hands, options_of(goal, filed.session.max_rounds))
    steps = list(shown(until_awaited(watched(awaited, "balancing")), show))
    if hands.swings < len(filed.recordings):
        wanted = f"no recording after the verdict, which followed recording {hands.swings}"
        raise InputError("--recording", f"number {len(filed.recordings)}", wanted)
    return summary(hands, goal, steps, None, ()), hands.placed


def until_awaited(steps: Iterator[Step]) -> Iterator[Step]:
    """Yield steps until a person has to do something."""
    try:
        yield from steps
    except Awaited:
        return


def summary(
    hands: SimulatedHands | FiledHands,
    goal: Goal,
    steps: Sequence[Step],
    before: MassProperties | None,
    truths: Sequence[MassProperties],
) -> ByHand:
    """Return what was done."""
    bed = hands.testbed
    known = ComEstimate(bed.body.com, bed.com_sd)
    done = Balancing(bed, goal, steps, None, before, truths, known)
    placings = [step.placing for step in steps if step.placing is not None]
    ended = any(step.verdict is not None for step in steps)
    return ByHand(done, placings, hands.time, ended)


def begun(testbed: str, bed: Testbed, goal: Goal, rounds: int, then_masses: bool) -> Filed:
    """Return a new session."""
    target, tolerance = as_written(goal.target, UM), as_written(goal.tolerance, UM)
    session = Session(testbed=testbed, target_um=target, tolerance_um=tolerance,
                      max_rounds=rounds, then_masses=then_masses, round=[])  # fmt: skip
    return Filed(session, bed, (), ())


def opened(session: Session, bed: Testbed, requested: Session, where: str) -> Filed:
    """Return a session with its recordings; InputError if it was begun with something else."""
    for key in ("testbed", "target_um", "tolerance_um", "max_rounds", "then_masses"):
        was, now = getattr(session, key), getattr(requested, key)
        if was != now:
            raise InputError(f"{where}: {key}", str(now), f"{was}, with which the session started")
    recordings = [recording_of(each, bed, where) for each in session.round]
    piles = Piles(bed)
    placed = [
        None if each.placed is None else piles.loading(each.placed, f"{where}: round[{k}].placed")
        for k, each in enumerate(session.round, 1)
    ]
    return Filed(session, bed, recordings, placed)


def recording_of(each: Round, bed: Testbed, where: str) -> Recording:
    """Return the recording of a round; it must be the one that was used then."""
    reading = Reading(each.from_s, each.to_s, each.dialect, each.columns, tuple(each.topic),
                      each.body, each.instance, each.bad_rows, each.max_memory_mb)  # fmt: skip
    recording = fitting_recording_of(each.recording, reading, bed)
    if each.sha256 and recording.sha256 != each.sha256:
        wanted = "the recording as it was when it was added"
        raise InputError(f"{where}: {each.recording}", "other content", wanted)
    return recording


def with_recording(filed: Filed, file: str, reading: Reading) -> Filed:
    """Return a session with one recording more."""
    added = Round(recording=file, from_s=reading.from_s, to_s=reading.to_s,
                  dialect=reading.dialect, columns=reading.columns, topic=list(reading.topic),
                  body=reading.body, instance=reading.instance, bad_rows=reading.bad_rows,
                  max_memory_mb=reading.max_memory_mb, placed=None)  # fmt: skip
    recording = recording_of(added, filed.testbed, file)
    for k, each in enumerate(filed.recordings, 1):
        if each.sha256 == recording.sha256:
            raise InputError(file, f"the recording of round {k} again", "the next recording")
    added = added.model_copy(update={"sha256": recording.sha256})
    session = filed.session.model_copy(update={"round": [*filed.session.round, added]})
    return Filed(session, filed.testbed, [*filed.recordings, recording], [*filed.placed, None])


def next_deed(filed: Filed, session: Path, number: int) -> str:
    """Return what a person has to do next."""
    return f"{LET_GO}\n  {command_of(filed, session, '--recording', f'run{number}.csv')}"


def command_of(filed: Filed, session: Path, *more: str) -> str:
    """Return the command by which a session goes on."""
    words = ["equipoise", "balance", filed.session.testbed, "--manual"]
    words += ["--then-masses"] * filed.session.then_masses
    return shlex.join([*words, "--session", str(session), *more])


def noted(filed: Filed, placed: Sequence[Ints]) -> Session:
    """Return the session with what lies where since each recording."""
    piles, rounds = Piles(filed.testbed), list(filed.session.round)
    for k, loading in enumerate(placed):
        rounds[k] = rounds[k].model_copy(update={"placed": piles.lines(loading)})
    return filed.session.model_copy(update={"round": rounds})
