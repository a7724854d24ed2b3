"""Extended Kalman filter of rate, inertia and centre of mass."""

from equipoise.estimation.filters.conclusion import filter_method
from equipoise.estimation.filters.model import Kind
from equipoise.model.method_card import Card

KIND = Kind(attitude=False, estimated=12)
METHOD = filter_method(
    Card(
        "ekf_12",
        "Euler's equation with known momentum and torque; w, J and com",
        "extended Kalman filter, analytic Jacobian",
        "da Silva 2021 Eqs. 35-38 with errata R15-R19",
        ("a gyro and a camera; a known torque, momentum or move; an initial J with its sd"),
        "scale of J and com before a known change; may diverge from a poor initial J",
        "played",
    ),
    KIND,
)
