"""Unscented Kalman filter of rate and the centre of mass along the up axis."""

from equipoise.estimation.filters.conclusion import filter_method
from equipoise.estimation.filters.model import Kind
from equipoise.model.method_card import Card

KIND = Kind(attitude=False, estimated=4, unscented=True, upright=True)
METHOD = filter_method(
    Card(
        "ukf_4",
        "Euler's equation, attitude as an input; w and com along up (com_z where z is up)",
        "unscented Kalman filter, 2n points; com across up and J are considered",
        "Chesi 2014, second step; da Silva 2021 section 4.1",
        "a gyro and a camera; com across up balanced and known (com_sd); J with its sd",
        "com across up, which it takes from the testbed; com along gravity until it has tilted",
        "levelled",
    ),
    KIND,
)
