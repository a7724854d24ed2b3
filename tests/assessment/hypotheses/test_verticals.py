"""The vertical of a laboratory by an accelerometer, against how it was tilted."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from equipoise.assessment.hypotheses.number_table import NumberTable
from equipoise.assessment.hypotheses.verticals import accelerometer_columns, vertical_of
from tests.support.recordings.frame_guises import accelerations, tilted
from tests.support.recordings.recorded_motion import swinging, turning

NAMES = ("ax", "ay", "az")


def measured(motion, sign: float = 1.0) -> NumberTable:
    return NumberTable(NAMES, sign * 1000.0 * np.stack([*accelerations(motion).values()], axis=1))


@pytest.mark.parametrize("made", [turning, swinging])
@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize("angle", [0.0, 5.0, 20.0, 45.0])
def test_the_tilt_is_that_of_the_laboratory(made, sign, angle) -> None:
    motion = made()
    found = vertical_of(measured(motion, sign), tilted(motion, angle), None, "z")
    assert found is not None
    assert np.degrees(found.tilt) == pytest.approx(angle, abs=0.1)
    assert found.is_off == (angle > 15.0)


def test_a_sensor_without_gravity_says_nothing() -> None:
    motion = turning()
    shaken = np.random.default_rng(3).normal(size=(len(motion.t), 3))
    assert vertical_of(NumberTable(NAMES, shaken), motion.q, None, "z") is None


def test_a_sensor_with_other_axes_says_nothing() -> None:
    """Its z is level: what it feels turns about with the platform."""
    motion = turning()
    turn = Rotation.from_euler("y", 90.0, degrees=True)
    table = NumberTable(NAMES, turn.apply(measured(motion).values))
    assert vertical_of(table, motion.q, None, "z") is None


@pytest.mark.parametrize(
    ("names", "found"),
    [
        (("az", "t", "ax", "ay"), ("ax", "ay", "az")),
        (("accX", "accY", "accZ"), ("accX", "accY", "accZ")),
        (
            ("accel_x [g]", "accel_y [g]", "accel_z [g]"),
            ("accel_x [g]", "accel_y [g]", "accel_z [g]"),
        ),
        (("linear_acceleration.x", "linear_acceleration.y"), None),
        (("ax", "ay", "az", "acc2_x"), None),
        (("gx", "gy", "gz"), None),
        (("accuracy", "x", "y", "z"), None),
    ],
)
def test_an_accelerometer_is_known_by_its_names(names, found) -> None:
    values = np.random.default_rng(4).normal(size=(5, len(names)))
    assert accelerometer_columns(NumberTable(names, values)) == found
