"""Unscented Kalman filter of rate and centre of mass."""

from equipoise.estimation.filters.conclusion import filter_method
from equipoise.estimation.filters.model import Kind
from equipoise.model.method_card import Card

KIND = Kind(attitude=False, estimated=6, unscented=True)
METHOD = filter_method(
    Card(
        "ukf_6",
        "Euler's equation, attitude as an input; w and com",
        "unscented Kalman filter, 2n points; J is considered",
        "da Silva 2021 section 3.2; unscented points as in Simon 2006",
        "a gyro and a camera; J with its sd",
        (
            "com better than J, since free motion determines only their ratio; com along "
            "gravity until it has tilted"
        ),
        "wandering",
    ),
    KIND,
)
