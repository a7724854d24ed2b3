"""A balancing run is judged by the truth: torque over a tilt range, offset and travel by hand."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.dynamics.sag_trim import trimmed_com
from equipoise.io.testbed.presets import read_preset
from equipoise.model.defects import ComStep
from equipoise.model.following import Following
from equipoise.model.mass_properties import MassProperties
from equipoise.model.reasons.reason import one_reason
from equipoise.model.reasons.step_reasons import StepReason
from equipoise.model.recording import Samples
from equipoise.model.step import Step
from equipoise.model.testbed import SlidingMass, Testbed, Truth
from equipoise.procedure.balancing.balance import BalanceOptions
from equipoise.simulation.bench import SimulatedBench
from equipoise.study import law_run as law_run_module
from equipoise.study.law_run import CountedBench, Task, followed_torque, gone, law_run, rms_torque
from tests.support.outcomes import verdict as verdict_of

WEIGHT = 10.0 * 9.81  # N
TARGET, TILT = np.array([0.0, 0.0, -1e-4]), np.radians(20.0)


def bench_of(com, torque=None, masses=None, **of_truth):
    """A platform whose truth is as given; its first guess is not used."""
    zero, J = np.zeros(3), np.diag([1.0, 2.0, 2.5])
    truth = Truth(np.array(com, float), zero, zero, J, 0.0, zero, 0.0, zero, 0.0, torque or {},
                  0.0, 30.0, zero, **of_truth)  # fmt: skip
    rail = SlidingMass("x", 0.5, np.array([0.0, 0.2, 0.0]), np.eye(3)[0], (-0.05, 0.05), 0.0, 0.0,
                       0.0, 0.01, 0.0, 0.0)  # fmt: skip
    bed = Testbed("plain", MassProperties(10.0, zero, J), 0.1, np.full(3, 1e-4), np.eye(3)[2], 0.5,
                  9.81, masses or (rail,), truth=truth)  # fmt: skip
    return CountedBench(bed, 1)


def mean_square_sine(tilt):
    """Over a cap of directions that count alike: int sin^3 / int sin, from 0 to the tilt."""
    c = np.cos(tilt)
    return (2 - 3 * c + c**3) / (3 * (1 - c))


@pytest.mark.parametrize("degrees", [5.0, 20.0, 60.0])
def test_a_height_turns_by_the_sine_of_the_tilt(degrees):
    tilt = np.radians(degrees)
    expected = WEIGHT * 50e-6 * np.sqrt(mean_square_sine(tilt))
    assert rms_torque(bench_of([0, 0, -50e-6]), tilt) == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize("degrees", [5.0, 20.0, 60.0])
def test_an_offset_aside_turns_by_what_is_across_gravity(degrees):
    """|x x n|^2 = 1 - n_x^2, and n_x^2 is half of sin^2 on the mean."""
    tilt = np.radians(degrees)
    expected = WEIGHT * 3e-6 * np.sqrt(1 - mean_square_sine(tilt) / 2)
    assert rms_torque(bench_of([3e-6, 0, 0]), tilt) == pytest.approx(expected, rel=1e-9)


def test_level_alone_it_is_the_weight_times_the_offset_aside():
    assert rms_torque(bench_of([3e-6, -4e-6, 1e-3]), 0.0) == pytest.approx(WEIGHT * 5e-6, rel=1e-9)


def test_sag_counts_with_the_attitude_that_it_belongs_to():
    """A deck that sinks by s along up is, at a tilt, s cos: torque m g s sin cos."""
    s, third, tilt = 30e-6, 10e-6, np.radians(20.0)
    bench = bench_of([0, 0, 0], {"sag_xx": -third, "sag_yy": -third})
    at = np.linspace(0.0, tilt, 20001)
    square = np.trapezoid((np.sin(at) * np.cos(at)) ** 2 * np.sin(at), at) / (1 - np.cos(tilt))
    assert rms_torque(bench, tilt) == pytest.approx(WEIGHT * s * np.sqrt(square), rel=1e-6)


def test_the_torque_is_that_of_the_masses_as_they_stand():
    """0.5 kg by 0.2 mm takes 10 um off; a part that slips puts 4 um back."""
    bench = bench_of([10e-6, 0, 0], com_steps=(ComStep(1.0, np.array([4e-6, 0.0, 0.0])),))
    before = rms_torque(bench, TILT)
    bench.move({"x": -2e-4})
    bench.read(2.0)
    assert rms_torque(bench, TILT) == pytest.approx(0.4 * before, rel=1e-6)


def test_travel_is_the_sum_of_all_ways():
    """1 mm there and 3 mm back of one mass, 2 mm of another."""
    rows = np.array([[0.0, 0.0], [1e-3, 0.0], [1e-3, -2e-3], [-2e-3, -2e-3]])
    assert gone(Samples(np.arange(4.0), rows)) == pytest.approx(6e-3)
    assert gone(None) == 0.0


def test_travel_between_reads_is_counted_exactly_once():
    bench = bench_of([0, 0, 0])
    bench.move({"x": 5e-3})
    for _ in range(4):
        bench.read(0.2)
    bench.move({"x": -1e-3})
    bench.read(0.35)
    bench.read(2.0)
    assert bench.travel == pytest.approx(5e-3 + 6e-3, rel=1e-9)


@pytest.fixture(scope="module")
def run():
    """Twenty seconds of feedback on the reference table, and its proof."""
    bed = read_preset("reference-table")
    options = BalanceOptions(TARGET, np.full(3, 5e-6))
    return law_run(Task("underactuated", bed, 3, options, 60.0, TILT))


def test_a_run_is_repeatable_and_judged_by_the_truth(run):
    """The same seed makes the same platform, whose torque before is that of the bench alone."""
    bed = read_preset("reference-table")
    assert run.torque_before == rms_torque(SimulatedBench(bed, 3), TILT)
    again = law_run(Task("underactuated", bed, 3, BalanceOptions(TARGET, np.full(3, 5e-6)), 60.0,
                         TILT))  # fmt: skip
    np.testing.assert_array_equal(again.offset, run.offset)
    assert (again.torque, again.time, again.travel) == (run.torque, run.time, run.travel)


def test_a_run_records_its_cost_and_its_claims(run):
    assert (run.law, run.seed) == ("underactuated", 3)
    assert 55.0 < run.time < 90.0
    assert run.travel > 1e-3
    assert run.torque > 0
    assert run.verdict.com is not None
    # What the proof found is what the truth says, within what it says of itself.
    off = run.verdict.com - TARGET - run.offset
    assert np.all(np.abs(off) < 5 * run.verdict.sd + 2e-6)


def test_a_platform_that_is_halted_has_its_verdict_and_its_torque(run):
    bed = read_preset("reference-table")
    thrown = replace(bed, truth=replace(bed.truth, attitude=np.zeros(3),
                                        rate=np.array([0.6, 0.0, 0.0])))  # fmt: skip
    halted = law_run(Task("pid", thrown, 3, BalanceOptions(TARGET), 60.0, TILT))
    assert halted.verdict.outcome == "halted"
    assert halted.time < 5.0
    assert halted.torque == pytest.approx(run.torque_before, rel=0.5)


def rails(resolution=0.0):
    return tuple(
        SlidingMass(
            name, 0.02, 0.2 * side, axis, (-0.05, 0.05), resolution, 0.0, 0.0, 0.01, 0.0, 0.0
        )
        for name, axis, side in zip("xyz", np.eye(3), np.roll(np.eye(3), 1, axis=0), strict=True)
    )


def sagging(com, **more):
    """A deck that sinks by 25 um, with rails along all axes, and what masses can follow there."""
    terms = {"sag_xx": -25e-6 / 3, "sag_yy": -25e-6 / 3}
    bench = bench_of(com, terms, **more)
    trim = trimmed_com(bench.sag, np.eye(3)[2], TILT)
    return bench, Following(trim - np.array(com, float), 0.0, np.zeros(3), bench.sag, trim)


def test_masses_that_follow_leave_nothing_of_what_standing_ones_leave():
    bench, following = sagging([1e-6, -2e-6, 3e-6], masses=rails())
    assert followed_torque(bench, following, TILT) < 1e-12
    bench.move({name: float(500 * s) for name, s in zip("xyz", following.shift, strict=True)})
    bench.read(10.0)
    assert rms_torque(bench, TILT) == pytest.approx(WEIGHT * 8.67e-8, rel=0.01)


def test_masses_that_follow_err_by_their_steps():
    """Steps of 0.05 mm of 20 g in 10 kg are 0.1 um: uniform errors of 0.1/sqrt(12) an axis."""
    bench, following = sagging([1e-6, -2e-6, 3e-6], masses=rails(5e-5))
    left = followed_torque(bench, following, TILT)
    assert left == pytest.approx(WEIGHT * 1e-7 / np.sqrt(12) * np.sqrt(2), rel=0.35)


def test_a_wrong_sag_is_left_for_what_it_is_wrong_by():
    """Found 20 % too small, untrimmed alike: a fifth of what standing masses leave is left."""
    bench, following = sagging([0, 0, 0], masses=rails())
    wrong = replace(following, sag=0.8 * following.sag, trim=0.8 * following.trim)
    assert followed_torque(bench, wrong, TILT) == pytest.approx(0.2 * WEIGHT * 8.67e-8, rel=0.01)


def test_the_law_that_follows_is_counted_with_its_masses_following(monkeypatch):
    bench, following = sagging([0, 0, 0], masses=rails())
    last = Step("verify", 1.0, (), verdict=verdict_of(True))
    steps = [Step("control", 1.0, (), following=following), last]
    monkeypatch.setattr(law_run_module, "balanced_by", lambda *_: iter(steps))
    task = Task("pid", bench.testbed, 1, BalanceOptions(TARGET), 60.0, TILT)
    assert law_run(task).left < 1e-12
    monkeypatch.setattr(law_run_module, "balanced_by", lambda *_: iter([last]))
    run = law_run(task)
    assert run.followed is None
    assert run.left == run.torque > 1e-5
    assert not run.late
    ran = one_reason(StepReason.LAW_RAN, "pid", duration=20.0)
    spent = Step("control", 1.0, (*ran, *one_reason(StepReason.TIME_USED_UP)))
    monkeypatch.setattr(law_run_module, "balanced_by", lambda *_: iter([spent, last]))
    assert law_run(task).late
