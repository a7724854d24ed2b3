"""Unscented Kalman filter of rate, inertia and centre of mass."""

from equipoise.estimation.filters.conclusion import estimate
from equipoise.estimation.filters.model import Kind
from equipoise.estimation.method_contract import Method, Options
from equipoise.model.estimate import Estimate
from equipoise.model.method_card import Card
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed

KIND = Kind(attitude=False, estimated=12, unscented=True)


def run(recording: Recording, testbed: Testbed, options: Options) -> Estimate:
    """Return the belief after the last row, begun from what the testbed says."""
    return estimate(METHOD.card, KIND, recording, testbed)


METHOD = Method(
    Card(
        "ukf_12",
        "Euler's equation with known momentum and torque; w, J and com",
        "unscented Kalman filter, 2n points",
        "da Silva 2021 Eq. 35; unscented points as in Simon 2006",
        "a gyro and a camera; a known torque, momentum or move; a first guess of J and its sd",
        "scale of J and com before a known change",
        "played",
    ),
    run,
)
