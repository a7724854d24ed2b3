"""The linear Kalman filter on Euler's simplified model."""

from equipoise.estimation.filters.conclusion import filter_method
from equipoise.estimation.filters.model import Kind
from equipoise.model.method_card import Card

KIND = Kind(attitude=False, estimated=6, gyroscopic=False)
METHOD = filter_method(
    Card(
        "kf_simplified",
        "simplified Euler equation: J diagonal, no gyroscopic torque; w and com",
        "Kalman filter; J and neglected terms are considered",
        "da Silva 2021 Eqs. 28-31 with errata R11-R13; Young 1998",
        "a gyro and a camera; J with its sd",
        "com along gravity until it has tilted; not valid in fast motion",
        "wandering",
    ),
    KIND,
)
