"""The zero of a gyro, by the attitude beside it, against what MuJoCo's gyro was given."""

import numpy as np
import pytest

from equipoise.assessment.hypotheses.gyro_zero import GyroZero, zero_of
from equipoise.assessment.hypotheses.gyros import gyro_guesses, spans_of
from equipoise.assessment.hypotheses.number_table import NumberTable
from equipoise.model.arrays import Vector3
from tests.support.recordings.recorded_motion import ZERO, Motion, motion, swinging, turning

NAMES = ("gx", "gy", "gz")
SD = 4.0
MOTIONS = (turning, swinging, lambda: motion(5, 8.0, 3.0), lambda: motion(6, 10.0, 30.0))


def zero(moved: Motion, added: Vector3, scale: float = 1.0) -> GyroZero:
    """Return the zero of a gyro with an error of scale, and more zero than the motion's."""
    table = NumberTable(NAMES, scale * moved.w + added)
    spans = spans_of(moved.t, moved.q, table, list(NAMES))
    gyro = gyro_guesses(spans.turns(moved.q), spans.integrals())[0]
    found = zero_of(spans, moved.q, gyro)
    assert found is not None
    return found


@pytest.mark.parametrize("made", MOTIONS)
@pytest.mark.parametrize("scale", [1.0, 1.02])
def test_the_zero_is_within_its_sd(made, scale) -> None:
    added = np.radians([1.0, -2.0, 0.5])
    found = zero(made(), added, scale)
    assert found.is_clear
    assert np.all(np.abs(found.rate - added - ZERO * scale) < SD * found.sd)


@pytest.mark.parametrize("made", MOTIONS)
def test_no_zero_is_clear_where_there_is_none(made) -> None:
    assert not zero(made(), -ZERO).is_clear


def test_of_few_spans_nothing_is_said() -> None:
    moved = turning()
    few = NumberTable(NAMES, moved.w[:9])
    spans = spans_of(moved.t[:9], moved.q[:9], few, list(NAMES))
    gyro = gyro_guesses(spans.turns(moved.q[:9]), spans.integrals())[0]
    assert len(spans.starts) < 10
    assert zero_of(spans, moved.q[:9], gyro) is None
