"""What a division of torque by cause says of itself."""

import numpy as np
import pytest

from equipoise.model.reasons.torque_reasons import TorqueReason
from equipoise.model.recording import Recording, Samples, column_names, window
from equipoise.model.torque_by_cause import MomentumClosure, TorqueByCause, with_torque

LEFT = np.array([[1.0, -3.0, 0.5], [0.5, 1.0, np.nan]])


def made(left, unmodelled=0.0):
    closure = MomentumClosure(left, np.ones_like(left))
    n = len(left)
    return TorqueByCause(
        np.arange(float(n)), 1.0, ("gravity", "air"),
        np.tile([[[3.0, 0, 0], [4.0, 0, 0]]], (n, 1, 1)),
        np.ones((n, 2, 3)), np.ones((n, 3)), np.ones((n, 3)), unmodelled, 20.0, closure,
    )  # fmt: skip


def test_intervals_without_rows_near_their_ends_do_not_count():
    closure = made(LEFT).closure
    assert closure.normalised_rms == pytest.approx(np.sqrt((1 + 9 + 0.25 + 0.25 + 1) / 5))
    assert closure.share_within == pytest.approx(0.8)


@pytest.mark.parametrize(
    ("left", "code", "closes"),
    [
        (LEFT, TorqueReason.BALANCE_OPEN, False),
        (LEFT / 2, TorqueReason.BALANCE_CLOSED, True),
        (np.nan * LEFT, TorqueReason.BALANCE_UNTESTED, True),
    ],
)
def test_balance_is_open_beyond_half_as_much_again_as_stated(left, code, closes):
    torque = made(left)
    assert torque.reasons[0].code is code
    assert torque.closes is closes


def test_an_unmodelled_torque_is_named_beside_the_band():
    assert [reason.code for reason in made(LEFT, 0.5).reasons[1:]] == [
        TorqueReason.TORQUE_UNMODELLED
    ]
    assert made(LEFT, 1e-3).reasons[1:] == ()


def test_torque_of_a_cause_and_its_course():
    torque = made(LEFT)
    values, sd = torque.of("air")
    assert values[:, 0].tolist() == [4.0, 4.0]
    assert np.all(sd == 1.0)
    courses = {course.name: course for course in torque.courses}
    assert courses["gravity"].rms.tolist() == [3.0, 0.0, 0.0]
    assert courses["total"].greatest == 1.0
    with pytest.raises(KeyError):
        torque.of("sag")


def test_a_recording_takes_the_torque_of_each_cause_as_columns():
    """Gravity about x is 3 N m, its sd 1; what was recorded stays as it was."""
    rate = Samples(np.arange(3.0), np.zeros((3, 3)))
    recording = with_torque(Recording(rate=rate), made(LEFT))
    names = column_names(recording, "torque_by_cause")
    assert names[:4] == ("gravity_x", "gravity_sd_x", "gravity_y", "gravity_sd_y")
    assert len(names) == 3 * 2 * len(("gravity", "air", "total"))
    rows = recording.torque_by_cause
    assert rows.t.tolist() == [0.0, 1.0]
    assert rows.values[1, [names.index("gravity_x"), names.index("air_x")]].tolist() == [3.0, 4.0]
    assert recording.rate is rate


def test_a_part_of_a_recording_keeps_the_rows_within():
    recording = with_torque(Recording(), made(LEFT))
    assert window(recording, 0.5, 2.0).torque_by_cause.t.tolist() == [1.0]
    assert window(recording, 0.5, 2.0).cause_names == recording.cause_names
