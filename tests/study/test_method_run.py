"""One method on one record: errors by hand, the truth, and every method of the registry."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.app.runs.comparison import metered
from equipoise.estimation.method_contract import Options
from equipoise.estimation.methods.registry import METHODS
from equipoise.io.testbed.presets import read_preset
from equipoise.model.estimate import COM, END, INERTIA, Course, Estimate, Parameter
from equipoise.model.outcome import Outcome, outcome
from equipoise.model.reasons.estimate_reasons import EstimateReason
from equipoise.model.reasons.reason import Reason
from equipoise.model.recording import Recording
from equipoise.model.units import UM
from equipoise.simulation.bench import SimulatedBench
from equipoise.study.compare_methods import compared_methods
from equipoise.study.method_record import JudgedRecord, Scene, judged_record
from equipoise.study.method_run import (
    JUDGED,
    Cost,
    Failure,
    MethodTask,
    judged,
    method_runs,
    settled,
    tried,
)

pytestmark = pytest.mark.usefixtures("few_draws")

NOTHING = Cost(0.0, None)
BED = read_preset("sputnix")
MOVES = [(15.0, {"x1": 0.02, "z1": -0.05})]
TRUTH = dict.fromkeys((*COM, *END, *INERTIA), 0.0)


def record(truth=None, testbed=BED, recording=None, options=None, bound=None):
    return JudgedRecord(
        recording or Recording(), testbed, options or Options(), TRUTH | (truth or {}), bound or {}
    )


def estimate(values, covariance, why=EstimateReason.LINEAR, course=None):
    """Return an estimate of named values in um, covariance in um^2."""
    P = np.array(covariance, dtype=float) * UM**2
    parameters = tuple(
        Parameter(name, "m", value * UM, float(np.sqrt(P[k, k])), bool(np.isfinite(P[k, k])))
        for k, (name, value) in enumerate(values.items())
    )
    return Estimate("tracker", outcome(why), parameters, P, course=course)


def test_error_sd_and_bound_stand_in_their_places():
    found = estimate({"com_y": 5.0, "com_z": -1.0}, np.diag([4.0, 9.0]))
    run = judged("tracker", 3, found, record({"com_y": 2 * UM}, bound={"com_y": UM}), NOTHING)
    assert run.error[1:3] == pytest.approx([3 * UM, -UM])
    assert run.sd[1:3] == pytest.approx([2 * UM, 3 * UM])
    assert run.bound[1] == UM
    assert np.isnan(run.error[[0, 3, 8]]).all()
    assert np.isnan(run.bound[[0, 2]]).all()
    assert (run.ending, run.seed, run.stated) == ("done", 3, True)


def test_nees_of_correlated_errors_by_hand():
    """P = [[2, 1], [1, 2]], e = (1, 1): P^-1 e = (1/3, 1/3), e^T P^-1 e / 2 = 1/3."""
    found = estimate({"com_x": 1.0, "com_y": 1.0}, [[2.0, 1.0], [1.0, 2.0]])
    assert judged("tracker", 1, found, record(), NOTHING).nees == pytest.approx(1 / 3)


def test_fixed_or_unobservable_parameters_have_no_error():
    found = estimate({"com_x": 1.0, "com_y": 1.0, "com_z": 2.0}, np.diag([0.0, np.inf, 1.0]))
    run = judged("tracker", 1, found, record(), NOTHING)
    assert np.isnan(run.error[:2]).all()
    assert run.nees == pytest.approx(4.0)


def test_com_as_masses_stand_is_judged_by_the_end():
    found = estimate(dict.fromkeys(END, 7.0), np.eye(3))
    run = judged(
        "tracker", 1, found, record({"com_end_x": 5 * UM}, bound={"com_end_x": 3.0}), NOTHING
    )
    assert run.error[0] == pytest.approx(2 * UM)
    assert run.bound[0] == 3.0
    both = estimate({**dict.fromkeys(COM, 1.0), **dict.fromkeys(END, 7.0)}, np.eye(6))
    assert judged("tracker", 1, both, record(), NOTHING).error[0] == pytest.approx(UM)


@pytest.mark.parametrize(
    ("why", "ending", "warned"),
    [
        (EstimateReason.LINEAR, "done", False),
        (EstimateReason.RESIDUAL_LARGE, "done", False),
        (EstimateReason.IMPOSSIBLE_INERTIA, "unusable", True),
        (EstimateReason.BIAS_BY_NOISE, "done", True),
    ],
)
def test_endings(why, ending, warned):
    numbers = {"power": 4.0, "widening": 2.0, "sds": 1.0}
    ended = Outcome((Reason(why, ("com_x",), numbers),))
    found = replace(estimate({"com_x": 1.0}, [[1.0]]), outcome=ended)
    run = judged("tracker", 1, found, record(), NOTHING)
    assert (run.ending, run.warned, run.stated) == (ending, warned, ending == "done" and not warned)


def test_a_failure_states_its_reason_and_has_no_numbers():
    run = judged("tracker", 1, Failure("broke", "ValueError: no"), record(), NOTHING)
    assert (run.ending, run.sentence, run.why) == ("broke", "ValueError: no", "ValueError: no")
    assert not run.stated
    assert np.isnan(run.error).all()


def course(*distances):
    """A course whose centre of mass is so far off, um, a row a second."""
    values = np.zeros((len(distances), 3))
    values[:, 2] = np.array(distances) * UM
    return Course(COM, np.arange(len(distances), dtype=float), values, np.ones((len(distances), 3)))


@pytest.mark.parametrize(
    ("distances", "when"),
    [((90, 50, 8, 20, 8, 7), 4.0), ((90, 50, 30), np.inf), ((8, 8), 0.0), ((50, np.nan, 1), 2.0)],
)
def test_com_has_settled_when_it_stays_within_a_tenth_of_the_first_error(distances, when):
    """The testbed's guess is 90 um off: 9 um count as settled."""
    swing = judged_record(Scene(BED, 2.0, [], Options()), 1).recording
    found = estimate({"com_x": 1.0}, [[1.0]], course=course(*distances))
    assert settled(found, record(recording=swing)) == when
    assert settled(replace(found, method="smoother"), record(recording=swing)) is None


def test_misuse_is_a_refusal_and_an_exception_is_reported_as_broken():
    def raising(error):
        def run(*_):
            raise error

        return replace(METHODS["tracker"], run=run)

    broke = tried(raising(np.linalg.LinAlgError("singular")), record())
    assert broke == Failure("broke", "LinAlgError: singular")
    refused = tried(METHODS["tracker"], record(options=Options(hold=("com_x",))))
    assert refused.ending == "refused"
    assert "--hold with tracker" in refused.why
    empty = tried(replace(METHODS["tracker"], run=lambda *_: estimate({}, np.zeros((0, 0)),
                  EstimateReason.NO_CAMERA)), record())  # fmt: skip
    assert empty == Failure("refused", EstimateReason.NO_CAMERA.template)


# --- on records --------------------------------------------------------------------------------


def test_the_truth_is_the_benchs_at_the_beginning_and_at_the_end():
    """A bench of the same seed, by hand."""
    reported = judged_record(Scene(BED, 30.0, MOVES, Options()), 5)
    bench = SimulatedBench(BED, 5)
    assert [reported.truth[n] for n in COM] == pytest.approx(bench.truth().com)
    assert reported.truth["inertia_P_xy"] == bench.truth().inertia_P[0, 1]
    bench.read(15.0)
    bench.move(MOVES[0][1])
    bench.read(15.0)
    assert [reported.truth[n] for n in END] == pytest.approx(bench.truth().com)
    assert reported.truth["com_end_z"] - reported.truth["com_z"] == pytest.approx(
        -0.05 * 15.6e-3 / 14.24, rel=0.05
    )


def test_sag_is_part_of_com_unless_it_is_sought():
    """The platform's own testbed may ask for it, too; here it does not."""
    bed = replace(read_preset("reference-table"), disturbances=())
    bench = SimulatedBench(bed, 1)
    assert np.linalg.norm(bench.truth().com - bench.com) > UM
    for options, com in ((Options(), bench.truth().com), (Options(("sag_xx",)), bench.com)):
        reported = judged_record(Scene(bed, 5.0, [], options), 1)
        assert [reported.truth[n] for n in COM] == pytest.approx(com)


def test_errors_of_the_trajectory_fit_are_as_large_as_the_bound():
    """Eight records. RMSE / bound of eight numbers or more (0.1 % on both sides): 0.33 to 1.81."""
    free = replace(BED, tilt_limit=np.pi)  # some of these platforms hang beyond the table's stop
    scene = Scene(free, 60.0, [(30.0, {"x1": 0.05, "z1": -0.05, "z2": -0.05})], Options())
    tasks = [MethodTask(scene, ("trajectory",), seed, metered, False) for seed in range(8)]
    (reported,) = compared_methods(tasks, map).methods
    assert reported.failed == 0
    assert 0.33 < reported.com.rmse < 1.81
    assert 0.33 < reported.inertia.rmse < 1.81
    assert reported.coverage.of == 8 * len(JUDGED)
    assert reported.coverage.value > 0.8


def slow(bed):
    """The testbed with few rows."""
    return replace(bed, attitude=replace(bed.attitude, rate=5.0), gyro=replace(bed.gyro, rate=10.0))


def test_every_method_can_be_compared():
    """One short record with camera, gyro and a move: numbers or a reason, and no fault."""
    scene = Scene(slow(read_preset("unb")), 12.0, [(4.0, {"x": 0.004})], Options())
    runs = method_runs(MethodTask(scene, tuple(METHODS), 2, metered, weighed=False))
    assert [run.method for run in runs] == list(METHODS)
    assert [(run.method, run.sentence) for run in runs if run.ending == "broke"] == []
    assert all(run.sentence for run in runs)
    for run in runs:
        np.testing.assert_array_equal(np.isfinite(run.error), np.isfinite(run.sd))
        assert run.cost.time > 0
    gyro_filters = [run for run in runs if run.method[:3] in ("kf_", "ekf", "ukf")]
    assert all(np.isfinite(run.error[0]) for run in gyro_filters if run.method != "ukf_4")


def test_memory_is_the_peak_of_what_is_allocated_meanwhile():
    """Four million bytes, given back: watched in a run of its own, which is not timed."""
    calls = list[int]()

    def work():
        calls.append(len(np.ones(500_000)))
        return Failure("refused", "only asked")

    _, cost = metered(work, weighed=True)
    assert 4.0e6 < cost.memory < 4.4e6
    assert len(calls) == 2
    assert metered(work, weighed=False)[1].memory is None
    assert len(calls) == 3
