"""Extended Kalman filter of rate and centre of mass."""

from equipoise.estimation.filters.conclusion import estimate
from equipoise.estimation.filters.model import Kind
from equipoise.estimation.method_contract import Method, Options
from equipoise.model.estimate import Estimate
from equipoise.model.method_card import Card
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed

KIND = Kind(attitude=False, estimated=6)


def run(recording: Recording, testbed: Testbed, options: Options) -> Estimate:
    """Return the belief after the last row, begun from what the testbed says."""
    return estimate(METHOD.card, KIND, recording, testbed)


METHOD = Method(
    Card(
        "ekf_6",
        "Euler's equation, attitude as an input; w and com",
        "extended Kalman filter; J is considered",
        "da Silva 2021 Eqs. 32-34 with errata R14, R16, R18",
        "a gyro and a camera; J with its sd",
        "com better than J, as free motion shows their ratio; com along gravity until it has "
        "tilted",
        "wandering",
    ),
    run,
)
