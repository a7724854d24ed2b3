"""Increments of the rate in the simplified model, by recursive least squares."""

from equipoise.estimation import recursive_methods
from equipoise.estimation.formulations import increments
from equipoise.estimation.method import Card, Method, Options
from equipoise.model.estimate import Estimate
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed

PLAN = recursive_methods.Plan(increments.increments, increments.increment_noise)


def run(recording: Recording, testbed: Testbed, options: Options) -> Estimate:
    """Return the estimate."""
    return recursive_methods.run(METHOD.card, PLAN, recording, testbed, options)


METHOD = Method(
    Card(
        "simplified_recursive",
        "Euler simplified model: diagonal J known, no gyroscopic torque",
        "recursive least squares",
        "da Silva 2021 Eqs. 6-9 and 22-25, errata R5, R10; Young 1998",
        "a camera or a gyro; J",
        "inertia; what is left out: com is off by about |w|^2 dJ / (m g); com along gravity "
        "without tilt",
        "free",
        ("term", "hold"),
    ),
    run,
)
