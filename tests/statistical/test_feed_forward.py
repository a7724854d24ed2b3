"""A controller with gravity's torque fed forward points better than without, with few seeds."""

from tests.support import thorough
from verification import feed_forward


def test_the_pointing_error_is_at_least_halved():
    seeds = range(50, 50 + thorough.count(1, 6))
    assert feed_forward.measure(seeds, on_other=thorough.count(1, 3)).missed == ()


@thorough.whole
def test_a_stream_that_stops_leaves_no_more_error_than_none():
    bench = feed_forward.simulated
    with_it, without = (feed_forward.pointed(bench(3), fed=fed) for fed in (True, False))
    stopped = feed_forward.pointed(bench(3), fed=True, silent_from=30.0)
    assert with_it.rms < 0.5 * stopped.rms
    assert stopped.rms < without.rms
