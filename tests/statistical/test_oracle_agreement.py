"""The claims of `make verify` that need MuJoCo, on fewer platforms."""

import pytest

pytest.importorskip("mujoco", reason="MuJoCo is a development dependency")

from verification import independent_truth, mujoco_platforms


def test_propagator_agrees_with_mujoco() -> None:
    """Two platforms over two minutes with moves, within 5e-6 rad."""
    assert independent_truth.measure(range(2)).missed == ()


def test_errors_on_mujoco_records_are_as_large_as_stated() -> None:
    """Five platforms, camera alone and camera with gyro; the band is that of 45 errors each."""
    assert mujoco_platforms.measure(range(5)).missed == ()
