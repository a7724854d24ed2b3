"""A hold during an experiment: masses stand when it says so, creep otherwise, and it can go on."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.estimation.tracker import tracker
from equipoise.hardware.bench.replayed_bench import ReplayedBench
from equipoise.io.testbed.presets import read_preset
from equipoise.model.errors import InputError
from equipoise.model.permission import Permission
from equipoise.model.units import UM
from equipoise.procedure.balancing.balance import balance
from equipoise.procedure.balancing.hold import HoldOptions, begun, hold
from equipoise.procedure.balancing.hold_resumed import kept_of, resumed, unattended
from equipoise.procedure.balancing.motion_budget import MotionBudget
from equipoise.procedure.balancing.schedule import Schedule
from equipoise.simulation.bench import SimulatedBench
from tests.support import thorough

DRIFT = np.array([3.0, -2.0, 0.5]) * UM / 60  # m/s
BUDGET = MotionBudget(2e-6)
MINUTES = thorough.count(10, 3)


def drifting():
    bed = read_preset("nanosat")
    torque = {f"drift_{axis}": float(v) for axis, v in zip("xyz", DRIFT, strict=True)}
    masses = tuple(replace(mass, accuracy=1e-6) for mass in bed.masses)
    return replace(bed, masses=masses, truth=replace(bed.truth, torque=torque), inertia_sd=0.02)


class SpeedBench(SimulatedBench):
    """Notes how fast masses may go."""

    def __init__(self, testbed, seed):
        super().__init__(testbed, seed)
        self.speeds = []

    def move(self, targets, speed=np.inf):
        super().move(targets, speed)
        self.speeds.append((self.time, speed))


@pytest.fixture(scope="module")
def kept():
    """Balanced, then kept: masses stand in the last third, and the experiment ends early."""
    bench = SpeedBench(drifting(), 4)
    options = HoldOptions(duration=60.0 * MINUTES, every=1.0, motion=BUDGET, report=60.0)
    steps = balance(bench, replace(options.balancing, max_time=100.0))
    while True:
        try:
            next(steps)
        except StopIteration as end:
            knowledge = end.value
            break
    start, states = bench.time, []
    bench.speeds.clear()
    quiet, over = start + 40.0 * MINUTES, start + 55.0 * MINUTES

    def says():
        if bench.time >= over:
            return Permission.DONE
        return Permission.HOLD if bench.time >= quiet else Permission.FREE

    options = replace(options, schedule=Schedule(says))
    found = list(hold(bench, begun(knowledge, bench.testbed), options, states.append))
    return bench, found, states, (start, quiet, over)


def test_masses_creep_within_their_budget_and_stand_when_the_experiment_says_so(kept):
    """Nothing is sent on in the hold but where masses are; 5.8 um/s is what one mass may go."""
    bench, steps, states, (_, quiet, over) = kept
    moving = [speed for t, speed in bench.speeds if t < quiet]
    assert len(moving) >= 3
    assert all(1e-6 < speed < 6e-6 for speed in moving)
    assert sum(t >= quiet for t, _ in bench.speeds) <= 1  # they were halted
    stood = np.array([h.displacement for h in states if quiet + 2.0 < h.state.t < over])
    assert np.abs(stood - stood[0]).max() < 1e-9
    assert not any(step.kind == "move" and step.time >= quiet for step in steps)


def test_while_they_may_move_they_follow_the_drift(kept):
    """3.6 um/min for minutes would be far outside; the tracker's own word is true to 4 sd."""
    bench, _, states, _ = kept
    last = states[-1].state
    true = bench.com - (bench.com - bench.platform.body.com - DRIFT * bench.time)
    sd = np.sqrt(np.diag(last.covariance))[6:9]
    assert np.all(np.abs(last.com - true) < 4 * sd + 0.1 * UM)


def test_it_says_when_masses_may_not_move_and_ends_when_the_experiment_does(kept):
    _, steps, _, (start, quiet, over) = kept
    said = [(str(step.code), step.time) for step in steps if step.kind == "control"]
    assert [code for code, _ in said] == ["experiment_holds", "experiment_done"]
    assert [t for _, t in said] == pytest.approx([quiet, over], abs=1.5)
    assert steps[-1].kind == "verify"
    duration = steps[-1].verdict.reasons[0].numbers["duration"]
    assert duration == pytest.approx(over - start, abs=1.5)
    reports = [step for step in steps if step.kind == "estimate"]
    assert len(reports) == int((over - start) // 60)


def test_it_goes_on_after_an_interruption(kept):
    """Two minutes later, on the same platform: the centre of mass is known again within seconds."""
    bench, _, states, _ = kept
    known = kept_of(states[-1])
    gap, since = 120.0, bench.time
    bench.read(gap - 1.0)
    held = resumed(bench, known, bench.time + 1.0 - since)
    sd = np.sqrt(np.diag(held.state.covariance))[6:9]
    true = bench.platform.body.com + DRIFT * bench.time
    assert np.all(np.abs(held.state.com - true) < 4 * sd)
    steps = list(hold(bench, held, HoldOptions(duration=30.0, every=1.0, motion=BUDGET)))
    assert steps[-1].kind == "verify"


def test_a_recording_is_kept_as_a_bench_is(kept):
    """The same rows give the same centre of mass, whoever reads them; masses did not obey then."""
    bench, _, states, _ = kept
    bench.stop()
    rows = bench.read(40.0)
    known = replace(kept_of(states[-1]), displacement=rows.masses.values[-1])
    replayed = ReplayedBench(bench.testbed, rows)
    options = HoldOptions(
        duration=30.0, every=1.0, motion=BUDGET, schedule=Schedule(lambda: "hold")
    )
    found = []
    *_, last = hold(replayed, resumed(replayed, known, 60.0), options, found.append)
    assert last.kind == "verify"
    state = found[-1].state
    sd = np.sqrt(np.diag(state.covariance))[6:9]
    assert np.all(np.abs(state.com - bench.platform.body.com - DRIFT * state.t) < 4 * sd)


def test_masses_that_were_moved_meanwhile_are_refused(kept):
    bench, _, states, _ = kept
    known = kept_of(states[-1])
    moved = replace(known, displacement=known.displacement + 1e-3)
    with pytest.raises(InputError, match="mass x: found at"):
        resumed(bench, moved, 1.0)


def test_without_measurements_it_drifts_on_and_is_known_less():
    """100 s at 0.05 um/s, known to 0.01 um/s, with a correlation of one half to 0.2 um."""
    state = tracker.first_state(0.0, np.array([1.0, 0, 0, 0]), drifting())
    P = np.zeros_like(state.covariance)
    P[6, 6], P[18, 18], P[6, 18] = (0.2 * UM) ** 2, (0.01 * UM) ** 2, 0.5 * 0.2 * 0.01 * UM**2
    P[18, 6] = P[6, 18]
    state = replace(state, covariance=P, drift=np.array([0.05, 0, 0]) * UM, com=np.zeros(3))
    later = unattended(state, 100.0)
    np.testing.assert_allclose(later.com, [5 * UM, 0, 0], atol=1e-15)
    walks = 0.05**2 * 100 + (5e-4) ** 2 * 100**3 / 3  # um^2: of r, and of its rate
    shared = (5e-4) ** 2 * 100**2 / 2  # um^2/s
    assert later.covariance[6, 6] / UM**2 == pytest.approx(0.04 + 2 * 100 * 0.001 + 1.0 + walks)
    assert later.covariance[6, 18] / UM**2 == pytest.approx(0.001 + 100 * 1e-4 + shared)
    assert later.covariance[18, 6] == pytest.approx(later.covariance[6, 18])
    assert later.covariance[18, 18] / UM**2 == pytest.approx(1e-4 + (5e-4) ** 2 * 100)
