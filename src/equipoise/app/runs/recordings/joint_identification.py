"""One identification from several recordings: what each holds, its estimate, and that of all."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from equipoise.app.runs.recordings.plausible_record import CLOSED, Gate
from equipoise.app.runs.waiting import QUIET, Waiting
from equipoise.maths.linalg import pack_symmetric
from equipoise.model.arrays import Floats
from equipoise.model.errors import InputError
from equipoise.model.estimate import Estimate
from equipoise.model.finding import Finding
from equipoise.model.joint_estimate import Deviation, JointEstimate
from equipoise.model.presentation import Plotted
from equipoise.model.recording import Recording
from equipoise.model.step import Step
from equipoise.model.testbed import Testbed
from equipoise.model.verdict import Verdict
from equipoise.procedure.identification.identify import IdentifyOptions
from equipoise.procedure.identification.identify_runs import identify_runs, names_of

FEWEST = 2  # recordings


@dataclass(frozen=True, slots=True, eq=False)
class IdentifiedRun:
    """One of several recordings: what it holds and shows by itself."""

    name: str
    recording: Recording
    findings: Sequence[Finding]
    estimate: Estimate
    used: bool  # in the joint fit
    deviation: Deviation | None  # from all runs together


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class JointIdentification(Plotted):
    """What was done with several recordings of one platform; ``estimate`` is that of all."""

    testbed: Testbed
    runs: Sequence[IdentifiedRun]
    steps: Sequence[Step]
    joint: JointEstimate

    @property
    def estimate(self) -> Estimate:
        """Return the joint estimate."""
        return self.joint.estimate

    @property
    def verdict(self) -> Verdict:
        """Return whether the runs agree."""
        return self.joint.verdict

    @property
    def stated(self) -> Floats:
        """Return what the testbed states of the body, SI, in the order of ``BODY``."""
        body = self.testbed.body
        return np.append(pack_symmetric(body.inertia_P), body.com)

    @property
    def used(self) -> list[IdentifiedRun]:
        """Return the runs that the joint estimate is made of."""
        return [run for run in self.runs if run.used]


def run(
    recordings: Sequence[Recording],
    testbed: Testbed,
    options: IdentifyOptions,
    waiting: Waiting = QUIET,
    gate: Gate = CLOSED,
) -> JointIdentification:
    """Identify from recordings that fit the testbed.

    Raises InputError for fewer than two of them, one that is given twice, and another method than
    the trajectory fit; Implausible for one that no estimate can stand, unless it is forced.
    """
    if len(recordings) < FEWEST:
        raise InputError("recordings", f"{len(recordings)}", "two or more for a joint fit")
    with waiting.doing("examining the recordings"):
        held = [gate.findings(each, testbed) for each in recordings]
    ended = list[JointEstimate]()

    def steps() -> Iterator[Step]:
        ended.append((yield from identify_runs(recordings, testbed, options, waiting.spread)))

    done = list(waiting.steps(steps(), f"identifying {len(recordings)} recordings"))
    return JointIdentification(testbed, runs_of(recordings, held, done, ended[0]), done, ended[0])


def runs_of(
    recordings: Sequence[Recording],
    held: Sequence[Sequence[Finding]],
    steps: Sequence[Step],
    joint: JointEstimate,
) -> list[IdentifiedRun]:
    """Return each run with what is known of it."""
    known = iter(() if joint.scatter is None else joint.scatter.deviations)
    found: list[IdentifiedRun] = []
    for k, (name, recording) in enumerate(zip(names_of(recordings), recordings, strict=True)):
        estimate, used = steps[k].estimate, joint.used[k]
        assert estimate is not None
        deviation = next(known, None) if used else None
        found.append(IdentifiedRun(name, recording, held[k], estimate, used, deviation))
    return found
