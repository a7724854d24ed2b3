"""The claims of `make verify` that need MuJoCo, on fewer platforms."""

import pytest

pytest.importorskip("mujoco", reason="MuJoCo is a development dependency")

from verification import independent_truth, lagging_masses, mujoco_platforms


def test_propagator_agrees_with_mujoco() -> None:
    """Two platforms over two minutes with moves, within 5e-6 rad."""
    assert independent_truth.measure(range(2)).missed == ()


def test_errors_on_mujoco_records_are_as_large_as_stated() -> None:
    """Five platforms, camera alone and camera with gyro; the band is that of 45 errors each."""
    assert mujoco_platforms.measure(range(5)).missed == ()


def test_lag_of_servos_is_found_and_their_sag_carried() -> None:
    """Four platforms, by their commands: the bands are as wide as that costs."""
    assert lagging_masses.measure(range(4)).missed == ()
