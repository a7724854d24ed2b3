"""The preset `sputnix` through its real drivers: emulated Grbl boards and a drawn camera."""

import numpy as np
import pytest

pytest.importorskip("cv2", reason="the extra 'camera' is not installed")

from equipoise.io.testbed.presets import read_preset
from equipoise.procedure.balancing.balance import BalanceOptions, balance
from tests.support import thorough
from tests.support.emulated_lab import lab, over_tcp


@thorough.whole
def test_it_balances_by_a_camera_and_the_verdict_is_true():
    """As on the simulated bench: (2, 2, 3) um in 3 moves and 120 s, errors as large as stated.

    Many seeds: `make verify`, emulated_sputnix.
    """
    options = BalanceOptions()
    with lab(over_tcp(read_preset("sputnix")), 3) as found:
        steps = list(balance(found.bench, options))
        truth, seconds = found.emulated.platform.truth().com, found.emulated.platform.time
        (link,) = found.keeper.links.sensors
        assert link.driver.counts.corrupt == link.driver.counts.foreign == 0
        assert link.driver.counts.good > 5 * seconds
    verdict = steps[-1].verdict
    assert verdict.passed
    assert sum(step.move is not None for step in steps) <= options.max_moves
    assert seconds <= options.max_time
    assert np.all(np.abs(truth - options.target) < options.tolerance)
    # chi-square of three degrees of freedom: beyond 16.3 in one of a thousand
    assert np.sum(((verdict.com - truth) / verdict.sd) ** 2) < 16.3
