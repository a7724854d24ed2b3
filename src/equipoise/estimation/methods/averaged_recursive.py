"""Averaged momentum integral, begun with a batch, by recursive least squares: Lee's method."""

from equipoise.estimation import recursive_methods
from equipoise.estimation.formulations import running_mean
from equipoise.estimation.method import Card, Method, Options
from equipoise.model.estimate import Estimate
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed

PLAN = recursive_methods.Plan(running_mean.averaged, running_mean.averaged_noise, batch=True)


def run(recording: Recording, testbed: Testbed, options: Options) -> Estimate:
    """Return the estimate."""
    return recursive_methods.run(METHOD.card, PLAN, recording, testbed, options)


METHOD = Method(
    Card(
        "averaged_recursive",
        "momentum integral, the whole equation averaged over 20 rows, t0 terms free",
        "least squares on the first seconds, then recursive",
        "Lee et al. Eqs. 3-8, errata L5-L7",
        "a camera or a gyro",
        "scale of J and com without a known change; J_zz and products without spin about more "
        "than one axis; that noise in the rates pulls J towards zero",
        "driven",
        ("term", "hold"),
    ),
    run,
)
