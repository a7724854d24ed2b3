"""A hold on a platform that sags: how much nobody knew before, and masses follow its tilt."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.actuators.sliding_masses import shift_by
from equipoise.app.runs.balancing import Goal
from equipoise.app.runs.keeping import file_of, interrupted
from equipoise.dynamics.sag_trim import SAG_TERMS
from equipoise.io.documents.held_file import write_held
from equipoise.io.testbed.presets import read_preset
from equipoise.model.units import UM
from equipoise.procedure.balancing.balance import balance
from equipoise.procedure.balancing.hold import HoldOptions, begun, hold
from equipoise.procedure.balancing.hold_resumed import kept_of, resumed
from equipoise.procedure.balancing.motion_budget import MotionBudget
from equipoise.procedure.balancing.sag_shift import allowance, as_stiff
from equipoise.procedure.steps.joint_fit import as_it_sags
from equipoise.simulation.bench import SimulatedBench
from tests.support import thorough

SAG = np.array([-0.4, 1.3, 0.1, -0.5, -2.3]) * UM
DRIFT = np.array([3.0, -2.0, 0.5]) * UM / 60  # m/s
OPTIONS = HoldOptions(
    duration=60.0 * thorough.count(4, 2), every=1.0, motion=MotionBudget(2e-6), report=60.0
)


def sagging():
    """A platform that swings some 20 deg at first, damped by its air, and drifts."""
    bed = read_preset("nanosat")
    torque = dict(zip(SAG_TERMS, SAG.tolist(), strict=True))
    for axis, drift in zip("xyz", DRIFT.tolist(), strict=True):
        torque |= {f"drift_{axis}": drift, f"viscous_{axis}": 2e-4}
    masses = tuple(replace(mass, accuracy=1e-6) for mass in bed.masses)
    truth, terms = replace(bed.truth, torque=torque), (*bed.disturbances, *SAG_TERMS)
    return replace(bed, masses=masses, truth=truth, inertia_sd=0.02, disturbances=terms)


@pytest.fixture(scope="module")
def balanced():
    """A bench after balancing, which takes it for stiff, and what is known then."""
    bench = SimulatedBench(sagging(), 2)
    steps = balance(bench, replace(OPTIONS.balancing, max_time=100.0))
    while True:
        try:
            next(steps)
        except StopIteration as end:
            return bench, end.value


@pytest.fixture(scope="module")
def held(balanced):
    """Steps of the hold, and at every measurement: where it stood, and the true offset."""
    bench, knowledge = balanced
    start = begun(as_it_sags(knowledge, bench.testbed), bench.testbed)
    noted = []

    def note(found):
        true = bench.com - allowance(bench.sag, found.state.q, bench.testbed.up)
        noted.append((found, true))

    return bench, list(hold(bench, start, OPTIONS, note)), noted, start


def errors_of(found, true, bed):
    """Errors of com as it acts, and of the sag, in sd."""
    state = as_stiff(found.state, bed.up)
    com = state.com + shift_by(bed, found.displacement) - true
    error = np.append(com, state.sag - SAG)
    return error / np.sqrt(np.diag(state.covariance))[np.r_[6:9, 24:29]]


def test_the_balancing_gives_the_sag_that_nobody_knew(balanced):
    """From 30 um of sd beforehand to a few."""
    bench, knowledge = balanced
    assert not knowledge.estimate.has("sag_xx")
    found = as_it_sags(knowledge, bench.testbed).estimate
    sd = np.sqrt(np.diag(found.covariance_of(SAG_TERMS)))
    assert np.all(np.abs(found.values(SAG_TERMS) - SAG) < 4 * sd)
    assert np.all(sd < 5 * UM)


def test_it_is_held_and_the_verdict_is_true(held):
    _, steps, noted, _ = held
    off = np.abs([true - OPTIONS.target for _, true in noted])
    assert steps[-1].verdict.passed, steps[-1].sentence
    assert np.all(off <= OPTIONS.tolerance)


def test_com_and_sag_are_within_what_is_stated_at_every_measurement(held):
    """4 sd at any of some hundred; 1.5 sd rms."""
    bench, _, noted, _ = held
    errors = np.array([errors_of(found, true, bench.testbed) for found, true in noted])
    assert np.abs(errors).max() < 4.0
    assert np.sqrt(np.mean(errors**2)) < 1.5


def test_the_covariance_stays_possible(held):
    """No direction with a negative variance, as the filter goes on."""
    for found, _ in held[2][::20]:
        P = found.state.covariance
        keep = np.diag(P) > 0
        sd = np.sqrt(np.diag(P)[keep])
        assert np.linalg.eigvalsh(P[np.ix_(keep, keep)] / np.outer(sd, sd)).min() > 0


def test_reports_state_com_drift_and_sag(held):
    """Each with its sd; nothing warms this platform, so nothing is said of heat."""
    report = next(step for step in held[1] if step.kind == "estimate")
    assert [str(reason.code) for reason in report.reasons] == ["com_at", "com_drifts", "com_sags"]
    numbers = report.reasons[2].numbers
    assert numbers["of_yz"] == pytest.approx(SAG[4], abs=4 * numbers["sd_yz"])
    assert "It drifts by (" in report.sentence
    assert "Elastic sag: xx" in report.sentence
    estimate = report.estimate
    assert estimate.has("drift_z")
    assert not estimate.has("thermal_x")
    drift = estimate.values(("drift_x", "drift_y", "drift_z"))
    sd = np.sqrt(np.diag(estimate.covariance_of(("drift_x", "drift_y", "drift_z"))))
    assert np.all(np.abs(drift - DRIFT) < 4 * sd)


def test_a_state_has_a_sag_where_it_was_estimated_alone(balanced, held):
    """As the balancing leaves it, taken for stiff, the error state is that of every platform."""
    bench, knowledge = balanced
    stiff = begun(knowledge, bench.testbed).state
    assert stiff.sag is None
    assert stiff.covariance.shape == (24, 24)
    assert held[3].state.covariance.shape == (29, 29)
    bed = bench.testbed.without("sag")
    assert as_it_sags(knowledge, bed) is knowledge


def test_it_goes_on_after_an_interruption_with_what_it_knew_of_the_sag(held, tmp_path):
    """Through the file: com and sag, and what they share, are as they were."""
    bench, _, noted, _ = held
    kept = kept_of(noted[-1][0])
    write_held(file_of(kept, bench.testbed, OPTIONS, 60.0), tmp_path)
    found = interrupted(tmp_path, bench.testbed)
    assert isinstance(found.goal, Goal)
    np.testing.assert_array_equal(found.kept.sag, kept.sag)
    np.testing.assert_array_equal(found.kept.covariance, kept.covariance)
    again = resumed(bench, found.kept, 1.0)
    body = np.r_[9:15, 18:29]
    np.testing.assert_array_equal(again.state.sag, kept.sag)
    np.testing.assert_allclose(
        again.state.covariance[24:, 24:], kept.covariance[15:, 15:], rtol=1e-12
    )
    assert np.all(np.diag(again.state.covariance)[body] > 0)
    steps = list(hold(bench, again, replace(OPTIONS, duration=10.0)))
    assert steps[-1].kind == "verify"
