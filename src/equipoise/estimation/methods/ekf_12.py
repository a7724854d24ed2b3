"""Extended Kalman filter of rate, inertia and centre of mass."""

from equipoise.estimation.filters.conclusion import estimate
from equipoise.estimation.filters.model import Kind
from equipoise.estimation.method_contract import Method, Options
from equipoise.model.estimate import Estimate
from equipoise.model.method_card import Card
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed

KIND = Kind(attitude=False, estimated=12)


def run(recording: Recording, testbed: Testbed, options: Options) -> Estimate:
    """Return the belief after the last row, begun from what the testbed says."""
    return estimate(METHOD.card, KIND, recording, testbed)


METHOD = Method(
    Card(
        "ekf_12",
        "Euler's equation with known momentum and torque; w, J and com",
        "extended Kalman filter, analytic Jacobian",
        "da Silva 2021 Eqs. 35-37 with errata R16-R19",
        "a gyro and a camera; a known torque, momentum or move; a first guess of J and its sd",
        "scale of J and com before a known change; anything from a guess that is far off",
        "played",
    ),
    run,
)
