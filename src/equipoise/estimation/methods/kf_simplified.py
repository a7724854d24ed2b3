"""The linear Kalman filter on Euler's simplified model."""

from equipoise.estimation.filters.conclusion import estimate
from equipoise.estimation.filters.model import Kind
from equipoise.estimation.method_contract import Method, Options
from equipoise.model.estimate import Estimate
from equipoise.model.method_card import Card
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed

KIND = Kind(attitude=False, estimated=6, gyroscopic=False)


def run(recording: Recording, testbed: Testbed, options: Options) -> Estimate:
    """Return the belief after the last row, begun from what the testbed says."""
    return estimate(METHOD.card, KIND, recording, testbed)


METHOD = Method(
    Card(
        "kf_simplified",
        "simplified Euler equation: J diagonal, no gyroscopic torque; w and com",
        "Kalman filter; J and what is left out are considered",
        "da Silva 2021 Eqs. 28-31 with errata R11-R13; Young 1998",
        "a gyro and a camera; J with its sd",
        "com along gravity until it has tilted; anything at all in fast motion",
        "wandering",
    ),
    run,
)
