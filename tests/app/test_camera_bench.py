"""The preset `sputnix` through its real drivers: emulated Grbl boards and a drawn camera."""

import numpy as np
import pytest

pytest.importorskip("cv2", reason="the extra 'camera' is not installed")

from equipoise.app.emulation import emulate
from equipoise.app.kept_bench import keeper_of
from equipoise.app.lockstep import LockstepClock
from equipoise.hardware.real_bench import RealBench
from equipoise.model.bench import Bench
from equipoise.procedure.balance import BalanceOptions, balance
from verification.camera_bench import over_tcp


def test_it_balances_by_a_camera_and_the_verdict_is_true():
    """As on the simulated bench: (2, 2, 3) um in 3 moves and 120 s, errors as large as stated.

    Many seeds: `make verify`, camera_bench.
    """
    options, emulated = BalanceOptions(), emulate(over_tcp(), 3)
    keeper = keeper_of(emulated.testbed())
    bench = RealBench(keeper, LockstepClock(emulated))
    try:
        assert isinstance(bench, Bench)
        bench.start()
        steps = list(balance(bench, options))
        truth = emulated.platform.truth().com
        verdict = steps[-1].verdict
        (link,) = keeper.links.sensors
        assert link.driver.counts.corrupt == link.driver.counts.foreign == 0
        assert link.driver.counts.good > 5 * emulated.platform.time
    finally:
        keeper.close()
        emulated.close()
    assert verdict.passed
    assert sum(step.move is not None for step in steps) <= options.max_moves
    assert emulated.platform.time <= options.max_time
    assert np.all(np.abs(truth - options.target) < options.tolerance)
    # chi-square of three degrees of freedom: beyond 16.3 in one of a thousand
    assert np.sum(((verdict.com - truth) / verdict.sd) ** 2) < 16.3
