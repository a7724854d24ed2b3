"""Unscented Kalman filter of rate, inertia and centre of mass."""

from equipoise.estimation.filters.conclusion import filter_method
from equipoise.estimation.filters.model import Kind
from equipoise.model.method_card import Card

KIND = Kind(attitude=False, estimated=12, unscented=True)
METHOD = filter_method(
    Card(
        "ukf_12",
        "Euler's equation with known momentum and torque; w, J and com",
        "unscented Kalman filter, 2n points",
        "da Silva 2021 Eq. 35; unscented points as in Simon 2006",
        ("a gyro and a camera; a known torque, momentum or move; an initial J with its sd"),
        "scale of J and com before a known change",
        "played",
    ),
    KIND,
)
