"""Operations of kernels are counted as by hand, and counting changes no result."""

import numpy as np
import pytest

from benchmarks.counted_numbers import operations
from benchmarks.limit import DEGREE, fit_pass, polynomials, simulated, tracker_rows
from equipoise.dynamics.rigid_body import cross, invert, times
from equipoise.estimation.tracker.filter_kernel import run_filter
from equipoise.maths.turns import turn

A, B, SIX = (1.0, 2.0, 3.0), (4.0, 5.0, 6.0), (2.0, 3.0, 4.0, 0.1, 0.2, 0.3)


@pytest.mark.parametrize(
    ("name", "call", "expected"),
    [
        ("cross", lambda: cross(A, B), 9),  # six products, three differences
        ("times", lambda: times(SIX, A), 15),  # nine products, six sums
        ("invert", lambda: invert(SIX), 30),  # 9 of minors, 6 of 1 / det, 3 and 12 of elements
        # four numbers of seven; sine 6 and a root of them; 2 atan2 / sine; three products; what
        # comes from the mathematical library is a number that is not watched: 2 of it less
        ("turn", lambda: turn(np.array([1.0, 0, 0, 0]), np.array([0.8, 0.6, 0, 0])), 28 + 6 + 4),
    ],
)
def test_operations_are_those_counted_by_hand(name, call, expected):
    assert operations(call, name)[0] == expected


def test_a_kernel_writes_and_returns_the_same_where_it_counts():
    """x = 1, 2, 3 and sixteen times v / 2 + 1: 2 + (x - 2) / 2^16; twice over is as much more."""
    x, returned = np.array([1.0, 2.0, 3.0]), []
    counted, _ = operations(lambda: returned.append(polynomials(x, 0.5, 1.0, 1)), "polynomials")
    assert counted == 2 * DEGREE * 3
    np.testing.assert_allclose(x, 2.0 + np.array([-1.0, 0.0, 1.0]) / 2**16, rtol=1e-15)
    assert returned == [x[0]]
    assert type(returned[0]) is float
    assert operations(lambda: polynomials(x, 0.5, 1.0, 2), "polynomials")[0] == 2 * counted


def test_what_is_not_watched_counts_nothing():
    assert operations(lambda: cross(A, B), "times") == (0, {})


def test_a_pass_of_the_fit_costs_the_same_by_counting_numbers():
    """To rounding: machine code fuses products and sums, Python does not."""
    run, found = fit_pass(11), []
    operations(lambda: found.append(run()), "descend")
    assert found[0].cost == pytest.approx(run().cost, rel=1e-10)


def test_a_row_of_the_tracker_takes_as_many_operations_wherever_it_stands():
    """Passed again, without the test for contacts: within 1 %, as masses stand still."""
    few, many = (operations(tracker_rows(n, True), "run_filter")[0] for n in (5, 10))
    assert many / few == pytest.approx(2.0, rel=0.01)
    assert operations(tracker_rows(5, False), "run_filter")[0] > 2 * few
    assert run_filter.py_func.__name__ == "run_filter"


def test_steps_of_the_simulator_are_counted():
    counted, calls = operations(simulated(1.0), "_run")
    assert calls["slope_at"] == 4 * calls["step"]
    assert counted > 500 * calls["step"]
