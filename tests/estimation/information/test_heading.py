"""What is open without a camera: one turn about the vertical, and not the tilt."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.estimation.information.fisher_information import information_by
from equipoise.estimation.output_error import trajectory
from equipoise.estimation.output_error.fit_visibility import tilt_sd, visibility_of
from equipoise.estimation.output_error.trajectory import Params
from equipoise.maths.attitude import to_matrix
from equipoise.model.estimate import ATTITUDE
from equipoise.model.manoeuvre import Manoeuvre
from equipoise.planning.manoeuvre.noiseless_record import imagined
from tests.support.without_camera import without_camera

SWING = Manoeuvre(
    40.0, np.radians(8.0), np.array([0.6, 0.8, 0.0]), np.array([-0.02, 0.01, 0.05]),
    ((20.0, {"x1": -0.010, "y1": -0.010, "z1": -0.050}),),
)  # fmt: skip


def recorded(bed):
    return imagined(bed, bed.body, SWING).recording


@pytest.mark.parametrize(("kit", "codes"), [("imu", ["heading"]), ("sun", []), ("compass", [])])
def test_a_second_vector_shows_the_heading(kit, codes):
    bed = without_camera(kit)
    found = information_by(recorded(bed), bed, Params())
    assert [reason.code for reason in found.unobservable] == codes
    assert found.rank == found.size - len(codes)


def test_the_open_turn_is_about_the_vertical_and_no_other():
    """The direction that the data do not see is the vertical in body axes; the tilt is known.

    The accelerometer, by hand: 0.02 m/s^2 of g in 2001 rows, were there no bias, is 0.003 deg.
    """
    bed = without_camera("imu")
    fitted = trajectory.fit(recorded(bed), bed, Params())
    view = visibility_of(fitted)
    vertical = to_matrix(fitted.point.q0)[2]
    np.testing.assert_allclose(np.abs(view.unseen[:3, 0]), np.abs(vertical), atol=1e-3)
    assert np.radians(0.003) < tilt_sd(fitted, view) < np.radians(0.1)
    sentence = view.unobservable[0].sentence
    assert all(name in sentence for name in ATTITUDE)


def test_a_gyro_alone_is_not_said_to_show_where_gravity_points():
    """Where the tilt is open, too, nothing is called a heading."""
    bed = replace(without_camera("imu"), accelerometer=None)
    record = recorded(bed)
    quiet = replace(record, rate=record.rate.where(record.rate.t < 8.0))
    found = information_by(quiet, bed, Params())
    codes = [reason.code for reason in found.unobservable]
    assert "tilt_open" in codes
    assert "heading" not in codes
