"""The motion that a model predicts along a record."""

from typing import NamedTuple

from equipoise.model.arrays import Series1, Series3, Series4


class PredictedMotion(NamedTuple):
    """Attitude and rate at the times of the camera's rows (or the gyro's, without a camera)."""

    t: Series1  # s
    q: Series4  # body to laboratory, scalar first
    rate: Series3  # rad/s, body axes
