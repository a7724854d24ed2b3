"""The momentum integral behind an extended tracking differentiator, by recursive least squares."""

from equipoise.estimation import recursive_methods
from equipoise.estimation.formulations import tracked
from equipoise.estimation.method import Card, Method, Options
from equipoise.model.estimate import Estimate
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed

PLAN = recursive_methods.Plan(tracked.integrals, tracked.integrals_noise)


def run(recording: Recording, testbed: Testbed, options: Options) -> Estimate:
    """Return the estimate."""
    return recursive_methods.run(METHOD.card, PLAN, recording, testbed, options)


METHOD = Method(
    Card(
        "etd_rls",
        "momentum integral, each term or its integral from one extended tracking differentiator",
        "recursive least squares",
        "Xu 2015 (ETD-RLS); Han 2009 for fhan",
        "a camera or a gyro",
        "scale of J and com without a known change; J_zz and products without spin about more "
        "than one axis; that noise in the rates pulls J towards zero",
        "driven",
        ("term", "hold"),
    ),
    run,
)
