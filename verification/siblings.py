"""A corpus that judges: records over the whole space, and their halves, which must agree.

One record for each seed (``tests.oracle.corpus``), with every input wrong within its stated sd,
is identified by the reference method, as are its two halves; quiet minutes of one platform and
windows of the real record are siblings too. A number counts when the estimate calls itself usable
and states a finite sd for it: centre of mass and inertia, or ratios where the scale is open.

    refused   not usable; in vain: although the Cramer-Rao bound at the truth is below a tenth of
              each moment of inertia
    wrong     a value over 5 sd off, usable
    lost      crash, or no end within the limit of processor time

Siblings share what the laboratory states. Where an input gives the scale, both err alike, and their
difference is less than the sd say: agreement cannot show a wrong input, the truth does.
"""

from collections.abc import Iterator, Sequence
from functools import partial
from itertools import combinations
from typing import NamedTuple

import numpy as np

from equipoise.estimation.information.fisher_information import information_by
from equipoise.estimation.output_error.trajectory import Params
from equipoise.io.recording.recording_file import read_recording
from equipoise.io.testbed.testbed_file import read_testbed
from equipoise.model.estimate import NORMAL_95, Estimate, Parameter, normalised_difference
from equipoise.model.outcome import Trust
from equipoise.model.recording import Recording, Samples, window
from equipoise.model.testbed import Testbed
from equipoise.procedure.identification.identify import IdentifyOptions, identify
from equipoise.procedure.steps.clean_record import sound
from tests.oracle.corpus import CorpusRecord, corpus_record
from tests.support.quiet_records import quiet
from verification import real_record
from verification.limited import limited
from verification.result import Result, Row, Spread, at_least, at_most, in_turn
from verification.stated_errors import NAMES, true_values

LIMIT = 60.0  # s of processor time for a record, chosen: what a person waits for
WRONG, APART = 5.0, 3.0  # sd, of the truth and of siblings
COVERED = (0.92, 0.98)  # of 95 % intervals told as trustworthy
SHOWN, IN_VAIN = 0.10, 0.05  # bound over each moment; share of records refused although shown
USABLE_QUIET = 0.90
MOMENTS = ("inertia_P_xx", "inertia_P_yy", "inertia_P_zz")
THINNED = (1, 2, 5)  # one row of the real record in so many
STATED = 300
RELIED_ON = (Trust.TRUSTWORTHY, Trust.WIDENED)


class Told(NamedTuple):
    """What identification made of a record."""

    usable: bool
    relied_on: bool  # intervals hold, by what the outcome says
    sentence: str
    firm: tuple[Parameter, ...]  # those with a finite sd; none when not usable


class Judged(NamedTuple):
    """A record that was tried."""

    name: str
    told: Told | None  # None: lost
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
        return self.told is not None and not self.told.usable


def told(estimate: Estimate, held: tuple[str, ...] = ()) -> Told:
    """Return what an estimate states firmly."""
    outcome = estimate.outcome
    every = (*estimate.parameters, *estimate.ratios)
    core = [p for p in every if p.name.split("/")[0] in NAMES and p.name not in held]
    firm = tuple(p for p in core if np.isfinite(p.sd) and p.sd > 0) if outcome.usable else ()
    return Told(outcome.usable, outcome.trust in RELIED_ON, outcome.sentence, firm)


def reference(recording: Recording, testbed: Testbed, held: tuple[str, ...] = ()) -> Told:
    """Identify by the reference method."""
    *_, last = identify(recording, testbed, IdentifyOptions("trajectory", hold=held))
    assert last.estimate is not None
    return told(last.estimate, held)


def errors(said: Told, record: CorpusRecord) -> dict[str, float]:
    """Return the errors of what is stated, in its sd."""
    true = dict(zip(NAMES, true_values(record.truth), strict=True))

    def of(name: str) -> float:
        above, *below = name.split("/")
        return true[above] / true[below[0]] if below else true[above]

    return {p.name: float((p.value - of(p.name)) / p.sd) for p in said.firm}


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
    """Yield when the record is made; what is told, and its errors; if refused, if J is shown."""
    seed, part = item
    record = corpus_record(seed)
    recording = part_of(record.recording, part)
    yield record.choices.label
    said = reference(recording, record.testbed)
    yield said, errors(said, record)
    if not said.usable:
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


def quiet_minute(item: tuple[int, int]) -> Iterator[Told]:
    """Yield what is told of one of two minutes of a platform that hardly moves."""
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


def real_window(item: tuple[int, int]) -> Iterator[Told]:
    """Yield what is told of a window of the real record, of one row in so many."""
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


def apart(one: Judged, other: Judged) -> float | None:
    """Return the greatest difference of two siblings, in its sd; None where one is refused."""
    if not (one.told and one.told.usable and other.told and other.told.usable):
        return None
    of = {p.name: p for p in other.told.firm}
    shared = [normalised_difference(p, of[p.name]) for p in one.told.firm if p.name in of]
    return max(map(abs, shared), default=None)


# --- rows -----------------------------------------------------------------------------------------


def _list(runs: Sequence[Judged]) -> str:
    """Return the names of some runs, to stand behind a quantity."""
    return f" ({'; '.join(run.name for run in runs[:3])})" if runs else ""


def corpus_rows(runs: Sequence[Judged]) -> tuple[Row, ...]:
    """Return the counts over whole records."""
    z = np.array([v for r in runs if r.told and r.told.relied_on for v in r.z.values()])
    wrong, lost = [r for r in runs if r.wrong], [r for r in runs if r.told is None]
    refused, vain = [r for r in runs if r.refused], [r for r in runs if r.refused and r.shown]
    times = [r.seconds for r in runs]
    inside = float(np.mean(np.abs(z) < NORMAL_95)) if len(z) else 1.0
    share = f"{COVERED[0]:.0%} to {COVERED[1]:.0%}"
    return (
        Row(f"95 % intervals, of {len(z)} told as trustworthy, that hold the truth",
            f"{inside:.1%}", share, COVERED[0] <= inside <= COVERED[1]),
        Row("records refused", f"{len(refused)} of {len(runs)}", "any", True),
        at_most(f"the same, though the bound tells J within {SHOWN:.0%}{_list(vain)}",
                len(vain) / len(runs), IN_VAIN, ".1%"),
        at_most(f"wrong: over {WRONG:g} sd and usable{_list(wrong)}", len(wrong), 0, "d"),
        at_most(f"lost: crash or no end{_list(lost)}", len(lost), 0, "d"),
        at_most("processor time, s, median", float(np.median(times)), LIMIT),
        at_most("the same, worst", max(times), LIMIT),
    )  # fmt: skip


def sibling_row(name: str, families: Sequence[Sequence[Judged]]) -> Row:
    """Return how many siblings, both usable, disagree."""
    pairs = [pair for family in families for pair in combinations(family, 2)]
    far = [(a, apart(a, b)) for a, b in pairs]
    known = [(a, distance) for a, distance in far if distance is not None]
    odd = [a for a, distance in known if distance > APART]
    text = f"{name}: pairs, of {len(known)} usable of {len(pairs)}, over {APART:g} sd apart"
    return at_most(text + _list(odd), len(odd), 0, "d")


def quiet_rows(minutes: Sequence[Judged]) -> tuple[Row, ...]:
    """Return the rows of quiet records, two minutes of each."""
    usable = float(np.mean([bool(m.told and m.told.usable) for m in minutes]))
    families = [minutes[k : k + 2] for k in range(0, len(minutes), 2)]
    share = at_least("quiet minutes that are usable", usable, USABLE_QUIET, ".1%")
    return share, sibling_row("minutes of quiet records", families)


def real_rows(spread: Spread) -> tuple[Row, ...]:
    """Return the rows of the real record's windows; none where it is not there."""
    if not real_record.RECORD.exists():
        return ()
    places = range(len(real_record.WINDOWS))
    runs = spread(sibling, [("real", every, k) for every in THINNED for k in places])
    families = [runs[k : k + len(places)] for k in range(0, len(runs), len(places))]
    return (sibling_row("windows of the real record", families),)


def measure(seeds: Sequence[int], spread: Spread = in_turn, limit: float = LIMIT) -> Result:
    """Identify the corpus, its halves, quiet minutes and the real record's windows."""
    tried = spread(partial(judged, limit=limit), [(s, part) for s in seeds for part in range(3)])
    halves = [tried[k + 1 : k + 3] for k in range(0, len(tried), 3)]
    few = seeds[: max(len(seeds) // 10, 1)]
    minutes = spread(partial(sibling, limit=limit), [("quiet", s, k) for s in few for k in (0, 1)])
    claim = (
        f"On {len(seeds)} records over the whole space (0.5 kg to 5 t, com 5 um to 5 mm below and "
        "above, spin to 300 deg/s, tilt to 30 deg, camera and gyro of 1 to 200 Hz, 3 s to 1 h), "
        "with every input wrong within its stated sd, no wrong number is stated firmly, and "
        "siblings agree within 3 sd or are refused."
    )
    rows = (*corpus_rows(tried[::3]), sibling_row("halves of a record", halves),
            *quiet_rows(minutes), *real_rows(spread))  # fmt: skip
    return Result("siblings", claim, rows)
