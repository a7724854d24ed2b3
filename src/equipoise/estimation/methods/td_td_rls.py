"""The balance of torques behind two tracking differentiators, by recursive least squares."""

from equipoise.estimation import recursive_methods
from equipoise.estimation.formulations import tracked
from equipoise.estimation.method import Card, Method, Options
from equipoise.model.estimate import Estimate
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed

PLAN = recursive_methods.Plan(tracked.twice, tracked.twice_noise)


def run(recording: Recording, testbed: Testbed, options: Options) -> Estimate:
    """Return the estimate."""
    return recursive_methods.run(METHOD.card, PLAN, recording, testbed, options)


METHOD = Method(
    Card(
        "td_td_rls",
        "balance of torques, every term through the same two tracking differentiators",
        "recursive least squares",
        "Xu 2015 (TD-TD-RLS); Han 2009 for fhan",
        "a camera or a gyro",
        "scale of J and com without a known change; J_zz and products without spin about more "
        "than one axis; that noise in the rates pulls J towards zero",
        "driven",
        ("term", "hold"),
    ),
    run,
)
