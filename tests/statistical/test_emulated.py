"""The claims of `make verify` about emulated benches, on fewer platforms and in less time."""

from verification import emulated_balancing, faulty_benches, long_emulation


def test_balancing_through_emulated_devices_is_within_tolerance() -> None:
    """Three platforms, each also judged right."""
    runs = [emulated_balancing.balanced_through("nanosat", seed) for seed in range(100, 103)]
    assert all(run.passed and run.good for run in runs), runs


def test_faults_end_in_recovery_or_in_a_stop_with_its_sentence() -> None:
    """One run of every other fault, with other moments and starts than those of `make verify`."""
    seeds = range(1026, 1026 + len(faulty_benches.FAULTS), 2)
    assert faulty_benches.measure(seeds).missed == ()


def test_three_minutes_on_a_bench_lose_no_row() -> None:
    run = long_emulation.soaked(0.05)
    assert (run.lost, run.extra, run.stops) == (0, 0, 0)
