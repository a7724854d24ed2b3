"""Torque by cause against the truth: `verification/torque_by_cause.py` with few platforms."""

import numpy as np

from tests.support import thorough
from verification import torque_by_cause as checked

LEAST = 0.8  # of components within; a dozen platforms err together


@thorough.whole
def test_intervals_hold_the_true_torque():
    jobs = [(kind, 200 + k) for k, kind in enumerate(checked.KINDS)]
    runs = [run for kind, seed in jobs if (run := checked.judged(kind, seed)) is not None]
    assert len(runs) >= 6
    assert checked.share(np.concatenate([run.total for run in runs])) >= LEAST
    assert max(run.closure for run in runs) < 1.5
