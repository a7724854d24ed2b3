"""Extended Kalman filter of attitude, rate and centre of mass."""

from equipoise.estimation.filters.conclusion import estimate
from equipoise.estimation.filters.model import Kind
from equipoise.estimation.method_contract import Method, Options
from equipoise.model.estimate import Estimate
from equipoise.model.method_card import Card
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed

KIND = Kind(attitude=True, estimated=9)


def run(recording: Recording, testbed: Testbed, options: Options) -> Estimate:
    """Return the belief after the last row, begun from what the testbed says."""
    return estimate(METHOD.card, KIND, recording, testbed)


METHOD = Method(
    Card(
        "ekf_9",
        "Euler's equation and kinematics; attitude, w and com",
        "multiplicative extended Kalman filter; J is considered",
        "Ivanov 2021 section 5 with errata I7-I11",
        "a camera; J with its sd",
        "com better than J, as free motion shows their ratio; com along gravity until it has "
        "tilted",
        "wandering",
    ),
    run,
)
