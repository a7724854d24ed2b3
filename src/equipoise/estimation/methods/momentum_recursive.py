"""The momentum integral in body axes by recursive least squares."""

from equipoise.estimation import recursive_methods
from equipoise.estimation.formulations import differentiated, momentum
from equipoise.estimation.method import Card, Method, Options
from equipoise.model.estimate import Estimate
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed

PLAN = recursive_methods.Plan(momentum.body_axes, differentiated.momentum_noise)


def run(recording: Recording, testbed: Testbed, options: Options) -> Estimate:
    """Return the estimate."""
    return recursive_methods.run(METHOD.card, PLAN, recording, testbed, options)


METHOD = Method(
    Card(
        "momentum_recursive",
        "momentum integral in body axes, with t0 terms as states that begin anew with each piece",
        "recursive least squares",
        "da Silva 2021 Eqs. 16-25, errata R8-R10",
        "a camera or a gyro",
        "scale of J and com without a known change; J_zz and products without spin about more "
        "than one axis; that noise in the rates pulls J towards zero",
        "driven",
        ("term", "hold"),
    ),
    run,
)
