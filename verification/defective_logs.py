"""Known defects in records made by MuJoCo: what of them is noticed, and honest fits despite them.

The floor of an event is stated, not chosen afterwards. Its size in sd is the root of what twice the
cost rises by without it, from a fit that knows all moments, kinds and terms of the sensors, when
all others move to where they are then best. It must exceed the threshold of the test, itself a
number of sd, by three more (``FLOOR``); events below are not put into the record. (With the
threshold alone every second one is seen, at three sd hardly one; of two that are near, one that
moves a little may stand for both.)
"""

from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from equipoise.estimation.events.event_search import without
from equipoise.estimation.events.jump_test import threshold
from equipoise.estimation.events.record_model import Happening, RecordModel, farther, refitted
from equipoise.estimation.model_selection import reference_fit
from equipoise.estimation.model_selection.survey import cut_times
from equipoise.estimation.output_error.trajectory import Params, fit
from equipoise.model import sensor_terms
from equipoise.model.estimate import NORMAL_95
from equipoise.model.event import Event
from equipoise.model.recording import Recording, Samples
from equipoise.procedure.steps.clean_record import sound
from tests.oracle import cases
from tests.oracle.defects import (
    AVERAGING,
    BAD_ROWS,
    COM_STEPS,
    CONTACTS,
    DELAY,
    GYRO,
    HEADING,
    LAST_ROW,
    PLUMB,
    QUANTUM,
    ComStep,
    Contact,
    Defects,
)
from verification.chance import fewest, share_band
from verification.result import Result, Row, Spread, at_least, at_most, between, in_turn
from verification.stated_errors import stated_errors

COVER = (0.90, 0.99)  # share of 95 % intervals that hold the truth
DETECTED = 0.95
SPACING = 0.4  # s between the cuts of these records
FLOOR = float(np.sqrt(threshold(SPACING))) + 3.0  # sd
NEAR, SURE = 2.0, 3.0  # s, and stated sd of the moment: an event is found within the greater
ALONE: dict[str, tuple[str, ...]] = {
    "nothing": (), "contacts": (CONTACTS,), "steps of com": (COM_STEPS,),
    "bad rows": (BAD_ROWS,), "averaged rows": (AVERAGING,), "a last row of one frame": (LAST_ROW,),
    "gravity tilted": (PLUMB,), "heading errors": (HEADING,), "camera late": (DELAY,),
}  # fmt: skip
WITH_GYRO: dict[str, tuple[str, ...]] = {
    "gyro scale, cross and bias": (GYRO,), "gyro in steps of 1/16 deg/s": (QUANTUM,),
    "camera late beside a gyro": (DELAY,),
}  # fmt: skip
TOGETHER = (CONTACTS, BAD_ROWS, AVERAGING, PLUMB, DELAY)
Array = NDArray[np.float64]
Happened = Contact | ComStep


class Log(NamedTuple):
    """What became of one record."""

    off: Array  # (9,) error of com and J in stated sd; 0 where nothing is stated
    true: tuple[Happened, ...]
    found: tuple[Event, ...]
    bad: int  # rows put in
    missed: int  # of them not left out
    usable: bool
    seconds: float


def middle(event: Happened) -> float:
    """Return when an event happened, s."""
    return event.time + 0.5 * event.duration


def with_lengths(logged: cases.Logged) -> Recording:
    """Return the record with the lengths of its mean quaternions, if rows are means."""
    attitude = logged.recording.attitude
    assert attitude is not None
    if logged.defects.frames == 1:
        return logged.recording
    lengths = Samples(attitude.t, logged.length[:, None])
    return replace(logged.recording, attitude_norm=lengths)


def sensor_terms_of(defects: Defects) -> tuple[str, ...]:
    """Return the terms of the sensors without which no fit is right."""
    groups = ["plumb", *(f"heading{harmonic.order}" for harmonic in defects.heading)]
    groups += ["camera_delay"] if defects.camera_delay else []
    groups += ["gyro_scale", "gyro_cross"] if defects.gyro_matrix.any() else []
    return sensor_terms.among(term for group in groups for term in sensor_terms.GROUPS[group])


def sizes(logged: cases.Logged) -> list[tuple[Happened, float]]:
    """Return each event with its size in sd."""
    true = sorted((*logged.defects.contacts, *logged.defects.com_steps), key=middle)
    if not true:
        return []
    recording, testbed = sound(with_lengths(logged), logged.testbed)
    kinds = ("impulse" if isinstance(event, Contact) else "com_step" for event in true)
    events = tuple(Happening(middle(e), kind) for e, kind in zip(true, kinds, strict=True))
    params, cuts = Params(sensor=sensor_terms_of(logged.defects)), cut_times(recording)
    known = replace(params, jumps=tuple(event.jump for event in events))
    first = fit(recording, testbed, known)
    posterior = refitted(
        RecordModel(recording, testbed, params, cuts, np.zeros(3), events, first, testbed)
    )
    rises = [max(farther(without(posterior, k), posterior), 0.0) for k in range(len(events))]
    return list(zip(true, np.sqrt(rises).tolist(), strict=True))


def above_floor(seed: int, kinds: tuple[str, ...], with_gyro: bool) -> cases.Logged:
    """Return a record whose events are all above the floor: those below are taken out again."""
    make = cases.case_i if with_gyro else cases.case_s
    logged = make(seed, kinds)
    while True:
        weak = [event for event, size in sizes(logged) if size < FLOOR]
        if not weak:
            return logged
        logged = make(seed, (), cleared(logged.defects, weak))


def cleared(defects: Defects, weak: Sequence[Happened]) -> Defects:
    """Return the defects without some events."""
    return replace(
        defects,
        contacts=tuple(event for event in defects.contacts if event not in weak),
        com_steps=tuple(event for event in defects.com_steps if event not in weak),
    )


def identified(kinds: tuple[str, ...], with_gyro: bool, seed: int) -> Log:
    """Return what became of one record."""
    logged = above_floor(seed, kinds, with_gyro)
    recording, testbed = sound(with_lengths(logged), logged.testbed)
    estimate = reference_fit.estimate(recording, testbed, Params())
    kept = recording.attitude
    assert kept is not None
    bad = np.array([row.time for row in logged.defects.bad_rows])
    known = np.isin(np.round(kept.t, 6), np.round(bad, 6))
    return Log(
        stated_errors(estimate, logged.truth),
        (*logged.defects.contacts, *logged.defects.com_steps), estimate.events,
        len(bad), int(known.sum()), estimate.outcome.usable,
        logged.case.duration,
    )  # fmt: skip


def is_near(event: Event, true: Happened) -> bool:
    """Say whether an event that was found is this one."""
    return abs(event.t - middle(true)) < max(NEAR, SURE * event.t_sd)


def is_named(event: Event, true: Happened) -> bool:
    """Say whether an event is told as what it is, or left open."""
    return event.unclear or (event.kind == "impulse") == isinstance(true, Contact)


def found_shares(logs: Sequence[Log]) -> tuple[float, float, float]:
    """Return shares of events found and told as what they are, and false ones in ten minutes."""
    pairs = [(true, log) for log in logs for true in log.true]
    near = [[event for event in log.found if is_near(event, true)] for true, log in pairs]
    named = [
        any(is_named(event, true) for event in one)
        for (true, _), one in zip(pairs, near, strict=True)
        if one
    ]
    false = sum(
        not any(is_near(event, true) for true in log.true) for log in logs for event in log.found
    )
    minutes = sum(log.seconds for log in logs) / 600.0
    return float(np.mean([len(one) > 0 for one in near])), float(np.mean(named)), false / minutes


def rows_for(what: str, logs: Sequence[Log]) -> tuple[Row, ...]:
    """Return the rows on one set of defects."""
    n, rows = len(logs), list[Row]()
    inside = float(np.mean([np.abs(log.off) < NORMAL_95 for log in logs]))
    worst = float(np.max([np.abs(log.off) for log in logs]))
    rows.append(between(f"{what}: 95 % intervals hold com and J (farthest {worst:.1f} sd)", inside,
                        share_band(COVER, 0.95, n, 3), ".1%"))  # fmt: skip
    if any(log.true for log in logs):
        found, named, false = found_shares(logs)
        count = sum(len(log.true) for log in logs)
        rows += [
            at_least(f"the same: of {count} events found", found, fewest(DETECTED, n), ".1%"),
            at_least("the same: of those, told as what they are or left open", named,
                     fewest(DETECTED, n), ".1%"),
        ]  # fmt: skip
    else:
        false = sum(len(log.found) for log in logs) * 600.0 / sum(log.seconds for log in logs)
    rows.append(at_most("the same: false events in 10 min", false, max(1.0, 6.0 / n**0.5)))
    if bad := sum(log.bad for log in logs):
        left_out = 1.0 - sum(log.missed for log in logs) / bad
        rows.append(at_least(f"the same: of {bad} bad rows left out", left_out,
                             fewest(DETECTED, n), ".1%"))  # fmt: skip
    rows.append(at_least("the same: usable", float(np.mean([log.usable for log in logs])),
                         fewest(DETECTED, n), ".1%"))  # fmt: skip
    return tuple(rows)


def measure(seeds: Sequence[int] = range(200), spread: Spread = in_turn) -> Result:
    """Return the result for records with each defect alone, and with most of them together."""
    rows: list[Row] = []
    for what, kinds in ALONE.items():
        rows += rows_for(what, spread(partial(identified, kinds, False), seeds))
    for what, kinds in WITH_GYRO.items():
        rows += rows_for(what, spread(partial(identified, kinds, True), seeds))
    together = f"{len(TOGETHER)} defects together ({', '.join(TOGETHER)})"
    rows += rows_for(together, spread(partial(identified, TOGETHER, False), seeds))
    return Result(
        "defective_logs",
        f"{len(seeds)} records a defect, 120 s by MuJoCo with camera at 5 Hz and 0.2 deg (Case S), "
        f"contacts of 0.2 to 2 mN m s and steps of com of 1 to 5 um, all of {FLOOR:.1f} sd and "
        "above: with nothing told to the estimator, defects are found or do no harm.",
        tuple(rows),
    )
