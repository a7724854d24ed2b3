"""Torque by cause against the truth: `verification/torque_by_cause.py` with few platforms."""

import numpy as np
import pytest

pytest.importorskip("mujoco", reason="MuJoCo is a development dependency")

from tests.support import thorough
from verification import torque_by_cause as checked
from verification.judged_torque import share

LEAST = 0.8  # of components within; a dozen platforms err together


@thorough.whole
def test_intervals_hold_the_true_torque():
    jobs = [(kind, 200 + k) for k, kind in enumerate(checked.KINDS)]
    runs = [run for kind, seed in jobs if (run := checked.judged(kind, seed)) is not None]
    assert len(runs) >= 6
    assert share(np.concatenate([run.total for run in runs])) >= LEAST
    assert max(run.closure for run in runs) < 1.5


@thorough.whole
@pytest.mark.parametrize("kind", checked.ON_MUJOCO)
def test_intervals_hold_the_torque_on_bodies_of_another_engine(kind):
    """Few platforms, whose seconds err together: the shares of many are in the verification."""
    runs = [run for seed in range(1, 3) if (run := checked.ON_MUJOCO[kind](seed)) is not None]
    assert runs
    assert share(np.concatenate([run.total for run in runs])) >= LEAST
    assert max(run.closure for run in runs) < 1.5
