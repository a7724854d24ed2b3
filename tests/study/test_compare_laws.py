"""Laws compared: numbers of made-up runs by hand, refusals reported, nothing left out."""

import numpy as np
import pytest

from equipoise.io.testbed.presets import read_preset
from equipoise.model.errors import InputError
from equipoise.procedure.balancing.balance import BalanceOptions
from equipoise.procedure.balancing.catalogue import CARDS
from equipoise.study import compare_laws
from equipoise.study.compare_laws import Refusal, compared, middle, run_or_refusal, summary
from equipoise.study.law_run import LawRun, Task
from tests.support.outcomes import halted as halted_verdict
from tests.support.outcomes import verdict as verdict_of

UP, NEAR = np.array([0.0, 0.0, 1.0]), np.full(3, 2e-6)


def made_up(law="pid", seed=1, offset=(0.0, 0.0, 0.0), torque=1e-6, verdict=None, **more):
    given = {"torque_before": 1e-3, "time": 100.0, "travel": 0.01, "late": False} | more
    given = {"followed": None} | given
    return LawRun(law=law, seed=seed, offset=np.array(offset), torque=torque, **given,
                  verdict=verdict or verdict_of(False))  # fmt: skip


def task(law="pid", seed=1):
    options = BalanceOptions(np.zeros(3), NEAR)
    return Task(law, read_preset("reference-table"), seed, options, 60.0, 0.3)


def test_the_middle_of_0_to_20_is_10_and_19_of_20_stay_below_19():
    assert middle(np.arange(21.0)) == (10.0, 19.0)


def test_an_offset_is_split_into_height_and_lateral_parts():
    """(3, 4, -12) um: 5 um aside and 12 um of height; with x up 4, 12 and 3 um."""
    run = made_up(offset=(3e-6, 4e-6, -12e-6))
    reported = summary([run], UP, 1e-5, NEAR)
    assert reported.aside.median == pytest.approx(5e-6)
    assert reported.height.median == pytest.approx(12e-6)
    sideways = summary([run], np.array([1.0, 0.0, 0.0]), 1e-5, NEAR)
    assert sideways.aside.median == pytest.approx(np.hypot(4e-6, 12e-6))
    assert sideways.height.median == pytest.approx(3e-6)


def test_runs_count_that_leave_no_more_than_the_required_torque():
    runs = [made_up(torque=t) for t in (0.5e-5, 1e-5, 1.1e-5, 3e-5)]
    reported = summary(runs, UP, 1e-5, NEAR)
    assert (reported.runs, reported.within) == (4, 2)
    assert reported.torque.median == pytest.approx(1.05e-5)


def test_masses_that_follow_count_as_they_follow():
    """12 and 13 uN m standing are 9 and 11 following: one of two within 10."""
    runs = [made_up(torque=12e-6, followed=9e-6), made_up(torque=13e-6, followed=11e-6)]
    reported = summary(runs, UP, 1e-5, NEAR)
    assert reported.within == 1
    assert reported.torque.median == pytest.approx(12.5e-6)
    assert reported.followed.median == pytest.approx(10e-6)
    assert summary([made_up()], UP, 1e-5, NEAR).followed is None


def test_a_pass_is_false_when_the_truth_is_beyond_the_tolerance_on_any_axis():
    passed, failed = verdict_of(True), verdict_of(False)
    runs = [
        made_up(offset=(2.1e-6, 0, 0), verdict=passed),
        made_up(offset=(1.9e-6, 0, 0), verdict=passed),  # within
        made_up(offset=(0, 0, -4.1e-6), verdict=passed),
        made_up(offset=(0, 9e-6, 0), verdict=failed),  # as it says
    ]
    assert summary(runs, UP, 1.0, NEAR).false_passes == 2


def test_halted_and_late_runs_are_counted_once():
    halted = halted_verdict()
    runs = [made_up(verdict=halted), made_up(late=True), made_up(verdict=halted, late=True)]
    reported = summary(runs, UP, 1.0, NEAR)
    assert (reported.halted, reported.late) == (2, 1)


def test_time_and_travel_are_those_of_the_runs():
    runs = [made_up(time=t, travel=t / 1e4) for t in (10.0, 20.0, 60.0)]
    reported = summary(runs, UP, 1.0, NEAR)
    assert reported.time.median == 20.0
    assert reported.travel.median == pytest.approx(2e-3)


def compared_as(found, laws):
    """Compare made-up findings, handed out in the order of the tasks."""
    tasks = [task(each.law, getattr(each, "seed", 1)) for each in found]
    return compared(tasks, [CARDS[law] for law in laws], 1e-5, lambda *_: iter(found))


def test_every_law_has_its_own_runs_in_the_order_of_its_cards():
    found = [made_up(law, seed) for seed in (1, 2, 3) for law in ("pid", "underactuated")]
    reported = compared_as(found, ["underactuated", "pid"])
    assert [law.law for law in reported.laws] == ["underactuated", "pid"]
    assert [law.runs for law in reported.laws] == [3, 3]
    assert list(reported.seeds) == [1, 2, 3]
    assert len(reported.runs) == 6


def test_a_platform_counts_once_before_balancing_however_many_laws_balanced_it():
    """1, 1 and 4 mN m of two platforms: the middle is that of 1 and 4."""
    found = [made_up("pid", 1), made_up("underactuated", 1), made_up("pid", 2, torque_before=4e-3)]
    assert compared_as(found, ["pid", "underactuated"]).before.median == pytest.approx(2.5e-3)


def test_a_refused_law_is_listed_once_and_has_no_numbers():
    found = [made_up("pid", 1), Refusal("fully_actuated", "no"), made_up("pid", 2),
             Refusal("fully_actuated", "no")]  # fmt: skip
    reported = compared_as(found, ["pid", "fully_actuated"])
    assert [law.law for law in reported.laws] == ["pid"]
    assert reported.refusals == (Refusal("fully_actuated", "no"),)


def test_a_refusal_is_the_sentence_of_the_law(monkeypatch):
    def refuse(_):
        raise InputError("here", "this", "that")

    monkeypatch.setattr(compare_laws, "law_run", refuse)
    refused = run_or_refusal(task("pid"))
    assert refused == Refusal("pid", "here: found this; wanted that")


def test_other_errors_are_not_refusals(monkeypatch):
    def fail(_):
        raise ValueError("a fault of ours")

    monkeypatch.setattr(compare_laws, "law_run", fail)
    with pytest.raises(ValueError, match="a fault of ours"):
        run_or_refusal(task("pid"))
