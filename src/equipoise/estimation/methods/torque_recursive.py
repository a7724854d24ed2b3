"""The balance of torques, the momentum's slope by a running fit, by recursive least squares."""

from equipoise.estimation import recursive_methods
from equipoise.estimation.formulations import differentiated
from equipoise.estimation.method import Card, Method, Options
from equipoise.model.estimate import Estimate
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed

PLAN = recursive_methods.Plan(differentiated.smoothed_slope, differentiated.slope_noise)


def run(recording: Recording, testbed: Testbed, options: Options) -> Estimate:
    """Return the estimate."""
    return recursive_methods.run(METHOD.card, PLAN, recording, testbed, options)


METHOD = Method(
    Card(
        "torque_recursive",
        "balance of torques; slope by Savitzky and Golay, all else by the mean that matches it",
        "recursive least squares",
        "da Silva 2021 Eqs. 11-15 and 22-25, errata R5, R7, R10",
        "a camera or a gyro",
        "scale of J and com without a known change; J_zz and products without spin about more "
        "than one axis; that noise in the rates pulls J towards zero",
        "driven",
        ("term", "hold"),
    ),
    run,
)
