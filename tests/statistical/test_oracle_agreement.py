"""The claims of `make verify` that need MuJoCo, on fewer platforms."""

import pytest

pytest.importorskip("mujoco", reason="MuJoCo is a development dependency")

from tests.oracle import cases
from tests.support import thorough
from verification import independent_truth, lagging_masses, long_record, mujoco_platforms


def test_propagator_agrees_with_mujoco() -> None:
    """Platforms over two minutes with moves, within 5e-6 rad."""
    assert independent_truth.measure(range(thorough.count(2, 1))).missed == ()


def test_errors_on_mujoco_records_are_as_large_as_stated() -> None:
    """Platforms, camera alone and camera with gyro; the band is that of nine errors a platform."""
    cases = thorough.some([mujoco_platforms.CAMERA, mujoco_platforms.CAMERA_AND_GYRO], 1)
    result = mujoco_platforms.measure(range(thorough.count(3, 1)), cases=cases)
    assert result.missed == ()


@thorough.whole
def test_a_dense_record_is_identified_as_well_as_stated() -> None:
    """Four minutes at 100 Hz, with a camera alone; time and memory are not judged here."""
    logged = cases.dense(1, 240.0)
    task = long_record.Task(logged.recording, logged.testbed, logged.truth)
    found = long_record.identified(long_record.by_camera(task))
    assert found.rows == 24_001
    assert found.fine
    assert abs(found.z).max() < long_record.WORST


def test_lag_of_servos_is_found_by_commands() -> None:
    """One platform of Case S: bands as wide as that costs."""
    found = [lagging_masses.reported("S", 0)]
    rows = [
        *lagging_masses.honest_rows("S", found),
        *lagging_masses.lag_rows("S", found, lagging_masses.LATE),
    ]
    assert [row for row in rows if not row.ok] == []


@thorough.whole
def test_lag_of_servos_is_found_and_their_sag_carried() -> None:
    """Two platforms, by their commands: the bands are as wide as that costs."""
    assert lagging_masses.measure(range(2)).missed == ()
