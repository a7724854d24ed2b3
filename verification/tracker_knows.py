"""What the tracker says of what it does not know: inertia, contacts, gaps, noise. Case S."""

from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from equipoise.estimation.tracker import tracker
from equipoise.model.estimate import NORMAL_95
from equipoise.model.recording import Recording, Samples, window
from equipoise.model.testbed import Testbed
from verification import case_s, case_s_mujoco
from verification.chance import RARE, fewest, nees_band, share_band
from verification.result import Result, Row, Spread, at_least, at_most, between, in_turn, triple

COVER = (0.90, 0.99)  # share of 95 % intervals that hold the truth
EXCESS = 1.25  # of the NEES, which rare runs far off dominate
BEFORE, AT = 55.0, 95.0  # s: before the move; an event after it
STILL = 1e-10  # m/sqrt(s) and N m sqrt(s): nothing walks in these runs
DOUBTS = (0.02, 0.2)  # of the size of an element of J, one sd
HIT, STRONG = 2e-3, 1.2e-3  # N m s, by MuJoCo: of one contact; of those that must be noticed
AFTERWARDS = 15.0  # s in which a contact is reported
SIZES = (0.7, 2.0, 20.0)  # mN m s
STEPS = (5.0, 20.0)  # um
CAUGHT = 0.85  # chosen: of strong contacts at any time, also while J is learnt
NAMED = 0.85  # chosen: small steps look like impulses for some seconds
AFTER_EVENT = 0.85  # chosen: of the intervals 25 s after a contact, whose kind may be mistaken
GAP, LOUDER = (70.0, 98.0), 3.0  # s; of the stated noise
Array = NDArray[np.float64]
NOWHERE = np.zeros(3)


class Run(NamedTuple):
    """One record tracked."""

    error: Array  # (9,) of r and J at the end
    sd: Array
    nees: float
    contacts: tuple[tracker.Contact, ...]
    noise: float  # of the camera, times what is stated


def tracked(recording: Recording, seed: int, doubt: float, shift: Array = NOWHERE) -> Run:
    """Track one record, whose centre of mass shifts by what nobody knows (m), to its end."""
    true = np.concatenate([case_s.COM + shift, case_s.case(seed).inertia])
    return tracked_by(recording, case_s.testbed(seed, doubt), true)


def tracked_by(recording: Recording, testbed: Testbed, true: Array) -> Run:
    """Track a record to its end, where r and J are in truth these nine."""
    assert recording.attitude is not None
    first = tracker.first_state(0.0, recording.attitude.values[0], testbed)
    track = tracker.track(recording, testbed, tracker.Params("fed", STILL, STILL), first)
    error = np.concatenate([track.com[-1], track.inertia[-1]]) - true
    covariance = track.end.posterior.covariance
    nees = float(error @ np.linalg.solve(covariance, error))
    noise = float(track.end.noise_levels[0])
    return Run(error, np.sqrt(np.diag(covariance)), nees, track.contacts, noise)


def doubted(doubt: float, until: float, seed: int) -> Run:
    """Track a record from an inertia that is wrong by as much as is said."""
    return tracked(window(case_s.run(seed), 0.0, until), seed, doubt)


def knocked(size: float, seed: int) -> Run:
    """Track a record with an impulse (N m s)."""
    event = case_s.Event(AT + seed % 7 / 7, size * case_s.way(seed), NOWHERE)
    return tracked(case_s.run(seed, event), seed, 0.02)


def stepped(size: float, seed: int) -> Run:
    """Track a record whose centre of mass steps (m)."""
    shift = size * case_s.way(seed)
    event = case_s.Event(AT + seed % 7 / 7, NOWHERE, shift)
    return tracked(case_s.run(seed, event), seed, 0.02, shift)


def gapped(gap: tuple[float, float], seed: int) -> Run:
    """Track a record with a gap."""
    record = case_s.run(seed)
    keep = (record.attitude.t <= gap[0]) | (record.attitude.t >= gap[1])
    attitude = Samples(record.attitude.t[keep], record.attitude.values[keep])
    return tracked(replace(record, attitude=attitude), seed, 0.2)


def loud(doubt: float, seed: int) -> Run:
    """Track a record that is noisier than stated."""
    return tracked(case_s.run(seed, None, LOUDER), seed, doubt)


def by_mujoco(one: case_s_mujoco.Sample, seed: int, doubt: float) -> Run:
    """Track a record that MuJoCo made."""
    true = np.concatenate([one.logged.truth.com, one.inertia])
    testbed = case_s_mujoco.testbed(one, seed, doubt)
    return tracked_by(one.logged.recording, testbed, true)


def untouched(seed: int) -> tuple[Run, ...]:
    """Track what MuJoCo made of one seed from each doubt about the inertia."""
    one = case_s_mujoco.untouched(seed)
    return tuple(by_mujoco(one, seed, doubt) for doubt in DOUBTS)


def touched_once(seed: int) -> Run:
    """Track the same with one contact."""
    event = case_s.Event(AT + seed % 7 / 7, HIT * case_s.way(seed), NOWHERE)
    return by_mujoco(case_s_mujoco.touched_once(seed, event), seed, DOUBTS[0])


def touched(seed: int) -> tuple[bool, ...]:
    """Track the same with contacts as drawn; say of the strong ones whether they were noticed."""
    one = case_s_mujoco.touched(seed)
    run = by_mujoco(one, seed, DOUBTS[0])
    times = case_s_mujoco.strong(one, STRONG, case_s.SECONDS - AFTERWARDS)
    return tuple(reported(run, t) for t in times)


def inside(runs: Sequence[Run]) -> float:
    """Return the share of 95 % intervals that hold the truth."""
    return float(np.mean([np.abs(run.error) < NORMAL_95 * run.sd for run in runs]))


def honest_rows(what: str, runs: Sequence[Run], excess: float = EXCESS) -> tuple[Row, ...]:
    """Return the rows on intervals and NEES."""
    n = len(runs)
    limit = max(excess * 9, nees_band(9, n, 1 - RARE)[1])
    rms = 1e6 * np.sqrt(np.mean([run.error[:3] ** 2 for run in runs], axis=0))
    return (
        between(f"{what}: 95 % intervals hold r and J", inside(runs),
                share_band(COVER, 0.95, n, 3), ".1%"),
        at_most(f"the same: mean NEES, 9 unknowns; RMSE of r {triple(rms, '.3f')} um",
                float(np.mean([run.nees for run in runs])), limit),
    )  # fmt: skip


def noticed(run: Run) -> bool:
    """Say whether the event was reported."""
    return reported(run, AT)


def reported(run: Run, t: float) -> bool:
    """Say whether an event at a time (s) was reported."""
    return any(t - 6 < contact.t < t + AFTERWARDS for contact in run.contacts)


def named(run: Run, kind: str) -> bool:
    """Say whether it was given the kind, or none."""
    kinds = [contact.kind for contact in run.contacts if AT - 6 < contact.t < AT + 15]
    return bool(kinds) and kinds[0] in (kind, "either")


def event_rows(what: str, kind: str, runs: Sequence[Run]) -> tuple[Row, ...]:
    """Return the rows on one size of event."""
    n = len(runs)
    band = share_band((AFTER_EVENT, 1.0), 0.95, n, 3)
    return (
        at_least(f"{what}: noticed", float(np.mean([noticed(run) for run in runs])),
                 fewest(0.95, n), ".1%"),
        at_least(f"the same: called {kind} or left open",
                 float(np.mean([named(run, kind) for run in runs])), fewest(NAMED, n), ".1%"),
        between("the same: 95 % intervals hold r and J at the end", inside(runs), band, ".1%"),
    )  # fmt: skip


def doubt_rows(seeds: Sequence[int], spread: Spread) -> tuple[Row, ...]:
    """Return the rows on a doubtful inertia, and how often nothing was called a contact."""
    rows: list[Row] = []
    for doubt in DOUBTS:
        before = spread(partial(doubted, doubt, BEFORE), seeds)
        end = spread(partial(doubted, doubt, case_s.SECONDS), seeds)
        rows += honest_rows(f"J wrong by {doubt:.0%}, before the move", before)
        rows += honest_rows(f"J wrong by {doubt:.0%}, at the end", end)
        false = sum(len(run.contacts) for run in end) / (len(seeds) * case_s.SECONDS / 600)
        rows.append(at_most(f"J wrong by {doubt:.0%}: contacts called falsely in 10 min", false,
                            max(1.0, 6.0 / np.sqrt(len(seeds)))))  # fmt: skip
    return tuple(rows)


def other_rows(seeds: Sequence[int], spread: Spread) -> tuple[Row, ...]:
    """Return the rows on contacts, a gap and loud noise."""
    rows: list[Row] = []
    for size in SIZES:
        runs = spread(partial(knocked, 1e-3 * size), seeds)
        rows += event_rows(f"impulse of {size:g} mN m s", "impulse", runs)
    for size in STEPS:
        rows += event_rows(f"step of {size:g} um", "step",
                           spread(partial(stepped, 1e-6 * size), seeds))  # fmt: skip
    rows += honest_rows(f"gap of {GAP[1] - GAP[0]:g} s, J wrong by 20 %",
                        spread(partial(gapped, GAP), seeds))  # fmt: skip
    noisy = spread(partial(loud, 0.02), seeds)
    rows += honest_rows(f"noise {LOUDER:g} times as stated, J wrong by 2 %", noisy, 1.4)
    mean = float(np.mean([run.noise for run in noisy]))
    rows.append(between("the same: noise found, times as stated", mean, (2.8, 3.2)))
    return tuple(rows)


def mujoco_rows(seeds: Sequence[int], spread: Spread) -> tuple[Row, ...]:
    """Return the rows on records from an engine that shares nothing with the tracker."""
    rows: list[Row] = []
    for doubt, runs in zip(DOUBTS, zip(*spread(untouched, seeds), strict=True), strict=True):
        rows += honest_rows(f"MuJoCo, J wrong by {doubt:.0%}, at the end", runs)
    hit = spread(touched_once, seeds)
    rows += event_rows(f"MuJoCo, impulse of {1e3 * HIT:g} mN m s", "impulse", hit)
    observed = np.concatenate(spread(touched, seeds))
    rows.append(at_least(f"MuJoCo, 1 to 4 contacts at any time, J wrong by 2 %: noticed, of "
                         f"{len(observed)} beyond {1e3 * STRONG:g} mN m s",
                         float(np.mean(observed)), fewest(CAUGHT, len(observed)),
                         ".1%"))  # fmt: skip
    return tuple(rows)


def measure(seeds: Sequence[int], spread: Spread = in_turn) -> Result:
    """Track Case S with what goes wrong, one record of each kind for each seed."""
    claim = (
        f"Over {len(seeds)} platforms of Case S (120 s, 5 Hz, 0.2 deg, no gyro; a move at 60 s), "
        "in one pass: intervals are honest from an inertia that is 2 % or 20 % wrong, before and "
        "after the move that shows the scale; impulses and steps of the centre of mass (at 95 s, J "
        "2 % wrong) are noticed and survived, and so are a gap and noise three times as stated."
    )
    rows = (*doubt_rows(seeds, spread), *other_rows(seeds, spread), *mujoco_rows(seeds, spread))
    return Result("tracker_knows", claim, rows)
