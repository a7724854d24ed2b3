"""The claims of `make verify` about emulated benches, on fewer platforms and in less time."""

from equipoise.model.verdict import VerdictOutcome
from tests.support import thorough
from verification import emulated_balancing, faulty_benches, long_emulation


def test_balancing_through_emulated_devices_is_within_tolerance() -> None:
    """Platforms, each also judged right."""
    seeds = range(100, 100 + thorough.count(3, 1))
    runs = [emulated_balancing.balanced_through("nanosat", seed) for seed in seeds]
    assert all(run.outcome is VerdictOutcome.PASSED and run.good for run in runs), runs


def test_faults_end_in_recovery_or_in_a_stop_with_its_sentence() -> None:
    """One run of some of the faults, with other moments and starts than `make verify` has."""
    step = thorough.count(2, 18)
    seeds = range(1026, 1026 + len(faulty_benches.FAULTS), step)
    assert faulty_benches.measure(seeds).missed == ()


def test_minutes_on_a_bench_lose_no_row() -> None:
    run = long_emulation.soaked(thorough.count(180, 60) / 3600)
    assert (run.lost, run.extra, run.stops) == (0, 0, 0)
