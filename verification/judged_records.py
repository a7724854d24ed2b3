"""Records that are tried within a limit of processor time, and what comes of them.

Of the corpus the truth is known, and the Cramer-Rao bound at the truth; quiet minutes and windows
of the real record are judged by their siblings alone.
"""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from equipoise.app.arguments.options import BUDGET_S
from equipoise.app.arguments.search_time import budget_of
from equipoise.estimation.information.fisher_information import information_by
from equipoise.estimation.output_error.trajectory import Params
from equipoise.io.recording.recording_file import read_recording
from equipoise.io.testbed.testbed_file import read_testbed
from equipoise.model.estimate import Estimate, Parameter
from equipoise.model.outcome import Trust
from equipoise.model.recording import Recording, Samples, window
from equipoise.model.testbed import Testbed
from equipoise.procedure.identification.identify import IdentifyOptions, identify
from equipoise.procedure.steps.clean_record import sound
from tests.oracle.corpus import CorpusRecord, corpus_record
from tests.support.quiet_records import quiet
from verification import real_record
from verification.limited import limited
from verification.stated_errors import NAMES, true_values

LIMIT = 2 * BUDGET_S  # s of processor time for a record, chosen: its search and what follows
WRONG = 5.0  # sd
SHOWN = 0.10  # bound over each moment of inertia
MOMENTS = ("inertia_P_xx", "inertia_P_yy", "inertia_P_zz")
THINNED = (1, 2, 5)  # one row of the real record in so many
RELIED_ON = (Trust.TRUSTWORTHY, Trust.WIDENED)


class Conclusion(NamedTuple):
    """What identification made of a record."""

    usable: bool
    relied_on: bool  # intervals hold, by what the outcome says
    sentence: str
    firm: tuple[Parameter, ...]  # those with a finite sd; none when not usable


class Judged(NamedTuple):
    """A record that was tried."""

    name: str
    conclusion: Conclusion | None  # None: lost
    z: dict[str, float]  # errors in stated sd; empty where the truth is not known
    shown: bool | None  # the bound tells J; None: not refused, or the bound was lost
    seconds: float  # s of processor time
    stopped: str

    @property
    def worst(self) -> tuple[str, float]:
        """Return the parameter that is most sd off, and by how many."""
        return max(self.z.items(), key=lambda item: abs(item[1]), default=("", 0.0))

    @property
    def wrong(self) -> bool:
        """Say whether a usable estimate states a wrong number firmly."""
        return abs(self.worst[1]) > WRONG

    @property
    def refused(self) -> bool:
        """Say whether the estimate calls itself not usable."""
        return self.conclusion is not None and not self.conclusion.usable


def concluded(estimate: Estimate, held: tuple[str, ...] = ()) -> Conclusion:
    """Return what an estimate states firmly."""
    outcome = estimate.outcome
    every = (*estimate.parameters, *estimate.ratios)
    core = [p for p in every if p.name.split("/")[0] in NAMES and p.name not in held]
    firm = tuple(p for p in core if np.isfinite(p.sd) and p.sd > 0) if outcome.usable else ()
    return Conclusion(outcome.usable, outcome.trust in RELIED_ON, outcome.sentence, firm)


def reference(recording: Recording, testbed: Testbed, held: tuple[str, ...] = ()) -> Conclusion:
    """Identify by the reference method, within the budget that a person has."""
    options = IdentifyOptions("trajectory", hold=held, budget=budget_of(BUDGET_S))
    *_, last = identify(recording, testbed, options)
    assert last.estimate is not None
    return concluded(last.estimate, held)


def errors(conclusion: Conclusion, record: CorpusRecord) -> dict[str, float]:
    """Return the errors of what is stated, in its sd."""
    true = dict(zip(NAMES, true_values(record.truth), strict=True))

    def of(name: str) -> float:
        above, *below = name.split("/")
        return true[above] / true[below[0]] if below else true[above]

    return {p.name: float((p.value - of(p.name)) / p.sd) for p in conclusion.firm}


def is_shown(record: CorpusRecord, recording: Recording) -> bool:
    """Say whether the Cramer-Rao bound at the truth is below a tenth of each moment of inertia."""
    clean, testbed = sound(recording, record.exact)
    bounds = information_by(clean, testbed, Params(testbed.disturbances))
    sd = [bounds.sd[bounds.names.index(name)] for name in MOMENTS]
    return bool(np.all(sd < SHOWN * np.diag(record.truth.inertia_P)))


# --- the corpus -----------------------------------------------------------------------------------


def part_of(recording: Recording, part: int) -> Recording:
    """Return the whole record (0), or its first (1) or second half (2)."""
    start, end = recording.span
    middle = 0.5 * (start + end)
    edges = ((start, end), (start, middle), (middle, end))[part]
    return recording if part == 0 else window(recording, *edges)


def trial(item: tuple[int, int]) -> Iterator[object]:
    """Yield when the record is made; the conclusion, and its errors; if refused, if J is shown."""
    seed, part = item
    record = corpus_record(seed)
    recording = part_of(record.recording, part)
    yield record.choices.label
    conclusion = reference(recording, record.testbed)
    yield conclusion, errors(conclusion, record)
    if not conclusion.usable:
        yield is_shown(record, recording)


def judged(item: tuple[int, int], limit: float = LIMIT) -> Judged:
    """Try one record, or a half, within a limit of processor time."""
    tried = limited(trial, item, limit)
    label, found, shown = (*tried.answers, None, None, None)[:3]
    name = f"seed {item[0]}: {label}"
    if found is None:
        return Judged(name, None, {}, None, sum(tried.seconds[1:2]), tried.stopped)
    return Judged(name, *found, shown, tried.seconds[1], tried.stopped)


# --- other siblings -------------------------------------------------------------------------------


def quiet_minute(item: tuple[int, int]) -> Iterator[Conclusion]:
    """Yield the conclusion from one of two minutes of a platform that hardly moves."""
    made = quiet(item[0])
    yield reference(made.minutes[item[1]], made.testbed)


def thinned(recording: Recording, every: int) -> Recording:
    """Return one row of the camera in so many."""
    attitude = recording.attitude
    assert attitude is not None
    rows = Samples(attitude.t[::every], attitude.values[::every])
    norm = recording.attitude_norm
    kept = norm and Samples(norm.t[::every], norm.values[::every])
    return Recording(rows, attitude_norm=kept, source=recording.source)


def real_window(item: tuple[int, int]) -> Iterator[Conclusion]:
    """Yield the conclusion from a window of the real record, of one row in so many."""
    every, place = item
    part = window(read_recording(real_record.RECORD), *real_record.WINDOWS[place])
    yield reference(thinned(part, every), read_testbed(real_record.TESTBED), real_record.HELD)


WORK = {"quiet": quiet_minute, "real": real_window}


def sibling(item: tuple[str, int, int], limit: float = LIMIT) -> Judged:
    """Try a record whose truth is not asked for."""
    kind, first, second = item
    tried = limited(WORK[kind], (first, second), limit)
    name = f"{kind} {first}, {second}"
    if not tried.answers:
        return Judged(name, None, {}, None, tried.seconds[0], tried.stopped)
    return Judged(name, tried.answers[0], {}, None, tried.seconds[0], tried.stopped)
