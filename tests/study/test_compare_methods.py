"""Methods compared: numbers of made-up runs by hand, failures counted and left out."""

import numpy as np
import pytest

from equipoise.estimation.methods.registry import METHODS
from equipoise.model.units import UM
from equipoise.study.compare_methods import Share, compared_methods, summary
from equipoise.study.method_families import FAMILY
from equipoise.study.method_run import Cost, MethodTask
from tests.support.synthetic_runs import made_up


def test_bias_sd_and_rmse_of_errors_of_1_and_3_um():
    """Bias 2, sd sqrt(2) with n - 1, RMSE sqrt(5), all in um; what is not stated has none."""
    reported = summary([made_up([1.0]), made_up([3.0])])
    assert reported.bias[0] == pytest.approx(2 * UM)
    assert reported.sd[0] == pytest.approx(2**0.5 * UM)
    assert reported.rmse[0] == pytest.approx(5**0.5 * UM)
    assert np.isnan(reported.bias[1:]).all()


def test_an_sd_needs_two_runs():
    reported = summary([made_up([1.0])])
    assert np.isnan(reported.sd[0])
    assert reported.rmse[0] == pytest.approx(UM)


def test_each_error_counts_in_units_of_its_own_records_bound():
    """x: 2 / 1 and 6 / 2, y: -4 / 4 and 4 / 4. Squares 4, 9, 1, 1: RMSE / bound sqrt(15 / 4).

    Means 2.5 and 0: bias / bound sqrt(6.25 / 2).
    """
    runs = [
        made_up([2.0, -4.0], [1.0, 1.0], [1.0, 4.0]),
        made_up([6.0, 4.0], [1.0, 1.0], [2.0, 4.0]),
    ]
    reported = summary(runs)
    assert reported.com.rmse == pytest.approx((15 / 4) ** 0.5)
    assert reported.com.bias == pytest.approx((6.25 / 2) ** 0.5)
    assert reported.com.stated == Share(4, 4)
    assert np.isnan(reported.inertia.rmse)


def test_inertia_is_a_group_of_its_own():
    """com errs by its bound, the first moment of inertia by 50 times its own."""
    four = [1.0, -1.0, 1.0, 50.0]
    reported = summary([made_up(four, four, [1.0] * 4)])
    assert reported.com.rmse == pytest.approx(1.0)
    assert reported.inertia.rmse == pytest.approx(50.0)
    assert (reported.com.stated, reported.inertia.stated) == (Share(3, 3), Share(1, 1))


def test_what_the_record_does_not_show_is_no_part_of_the_ratio():
    """y has no bound: it is neither asked for nor counted. z is shown and not stated."""
    reported = summary([made_up([2.0, 9.0], [1.0, 1.0], [1.0, np.inf, 1.0])])
    assert reported.com.rmse == pytest.approx(2.0)
    assert reported.com.stated == Share(1, 2)


def test_intervals_hold_within_1_96_sd():
    """z of 1.9, -1.9 and 2.0: two of three hold; NEES is the mean of the runs'."""
    runs = [made_up([1.9, -1.9], [1.0, 1.0], nees=3.0), made_up([4.0], [2.0], nees=1.0)]
    reported = summary(runs)
    assert reported.coverage == Share(2, 3)
    assert reported.nees == 2.0
    assert reported.trusted == 2


def test_a_run_that_warns_of_its_intervals_has_errors_and_no_coverage():
    reported = summary([made_up([100.0], [1.0], warned=True), made_up([0.0], [1.0])])
    assert reported.coverage == Share(1, 1)
    assert (reported.warned, reported.confident_wrong) == (1, 0)
    assert reported.rmse[0] == pytest.approx(100 / 2**0.5 * UM)


@pytest.mark.parametrize(("error", "count"), [(4.9, 0), (5.1, 1), (-5.1, 1)])
def test_confidently_wrong_is_a_miss_by_more_than_five_sd(error, count):
    """Once a run, however many of its intervals miss."""
    assert summary([made_up([error, 2 * error], [1.0, 2.0])]).confident_wrong == count


def test_failures_are_counted_and_are_in_no_statistic():
    runs = [
        made_up([1.0]),
        made_up([500.0], ending="unusable", why="It means nothing.", warned=True),
        made_up(ending="refused", sentence="No gyro."),
        made_up(ending="refused", sentence="No gyro."),
        made_up([7.0], ending="broke", sentence="ValueError: no"),
    ]
    reported = summary(runs)
    assert (
        reported.runs,
        reported.refused,
        reported.unusable,
        reported.broke,
        reported.failed,
    ) == (5, 2, 1, 1, 4)
    assert reported.rmse[0] == pytest.approx(UM)
    assert reported.coverage == Share(1, 1)
    assert reported.warned == 0
    assert reported.why == "It means nothing."


def test_a_method_that_always_fails_has_no_numbers():
    reported = summary([made_up(ending="refused", sentence="No."), made_up(ending="refused")])
    assert reported.failed == reported.runs == 2
    assert np.isnan(
        [reported.com.rmse, reported.nees, reported.time, reported.coverage.value]
    ).all()
    assert reported.memory is None


def test_time_is_the_middle_and_memory_the_greatest_that_was_measured():
    """A refusal takes no time worth reporting."""
    costs = [Cost(1.0, 100), Cost(9.0, 300), Cost(2.0, None)]
    runs = [made_up(cost=cost) for cost in costs]
    reported = summary([*runs, made_up(ending="refused", cost=Cost(0.0, 1))])
    assert (reported.time, reported.memory) == (2.0, 300)


def test_settling_time_is_given_only_for_methods_with_a_course():
    assert summary([made_up()]).settled is None
    runs = [made_up(method="tracker", settled=s) for s in (3.0, 5.0, np.inf)]
    assert summary(runs).settled == 5.0


def test_every_method_has_its_own_runs_in_the_requested_order():
    names, seeds = ("tracker", "trajectory"), (4, 5)
    tasks = [MethodTask(None, names, seed, None, False) for seed in seeds]

    def spread(_work, items):
        return iter([[made_up([k], method=name, seed=task.seed) for k, name in enumerate(names)]
                     for task in items])  # fmt: skip

    reported = compared_methods(tasks, spread)
    assert [m.method for m in reported.methods] == list(names)
    assert [m.rmse[0] for m in reported.methods] == pytest.approx([0.0, UM])
    assert list(reported.seeds) == [4, 5]
    assert len(reported.runs) == 4


def test_the_bound_is_that_of_all_records_and_open_if_one_does_not_show_it():
    tasks = [MethodTask(None, ("tracker",), seed, None, False) for seed in (1, 2)]
    runs = [[made_up(bound=[3.0, 1.0], method="tracker")],
            [made_up(bound=[4.0, np.inf], method="tracker")]]  # fmt: skip
    bound = compared_methods(tasks, lambda *_: iter(runs)).bound
    assert bound[0] == pytest.approx(12.5**0.5 * UM)
    assert np.isinf(bound[1])


def test_every_method_has_a_family():
    assert set(FAMILY) == set(METHODS)
    assert FAMILY["tracker"] == FAMILY["ekf_6"] == "extended Kalman filter"
    assert FAMILY["kf_simplified"] == "Kalman filter"
    assert FAMILY["equilibrium"] == FAMILY["energy"] == "least squares"
