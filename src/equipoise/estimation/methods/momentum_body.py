"""The momentum integral in body axes by least squares."""

from equipoise.estimation import momentum
from equipoise.estimation.method import Card, Method, Options
from equipoise.model import torque_terms
from equipoise.model.estimate import Estimate
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed


def run(recording: Recording, testbed: Testbed, options: Options) -> Estimate:
    """Return the estimate."""
    terms = torque_terms.among((*testbed.disturbances, *options.terms))
    return momentum.estimate(recording, testbed, "body", terms)


METHOD = Method(
    Card(
        "momentum_body",
        "momentum integral in body axes, with t0 terms as free constants",
        "least squares",
        "da Silva 2021 Eqs. 16-21, t0 terms restored; Kim and Agrawal 2009",
        "a camera or a gyro",
        "scale of J and com without a known change; J_zz and products without spin about more "
        "than one axis",
        "driven",
        ("term",),
    ),
    run,
)
