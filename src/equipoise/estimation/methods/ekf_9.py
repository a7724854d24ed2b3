"""Extended Kalman filter of attitude, rate and centre of mass."""

from equipoise.estimation.filters.conclusion import filter_method
from equipoise.estimation.filters.model import Kind
from equipoise.model.method_card import Card

KIND = Kind(attitude=True, estimated=9)
METHOD = filter_method(
    Card(
        "ekf_9",
        "Euler's equation and kinematics; attitude, w and com",
        "multiplicative extended Kalman filter; J is considered",
        "Ivanov 2021 section 5 with errata I7-I11",
        "a camera; J with its sd",
        (
            "com better than J, since free motion determines only their ratio; com along "
            "gravity until it has tilted"
        ),
        "wandering",
    ),
    KIND,
)
