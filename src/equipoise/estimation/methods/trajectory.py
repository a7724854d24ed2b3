"""Maximum likelihood in the model that the record supports: see ``reference_fit``."""

from equipoise.estimation.method_contract import Method, Options
from equipoise.estimation.model_selection import reference_fit
from equipoise.estimation.output_error.trajectory import Params
from equipoise.model import sensor_terms, torque_terms
from equipoise.model.estimate import Estimate
from equipoise.model.method_card import Card
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed


def run(recording: Recording, testbed: Testbed, options: Options) -> Estimate:
    """Return the estimate."""
    return reference_fit.estimate(recording, testbed, params_of(testbed, options))


def params_of(testbed: Testbed, options: Options) -> Params:
    """Return the options of a trajectory fit: the testbed's own terms among those to estimate."""
    terms = (*testbed.disturbances, *options.terms)
    return Params(
        torque_terms.among(terms),
        sensor_terms.among(terms),
        use_prior=options.use_prior,
        hold=options.hold,
        robust=options.robust,
        budget=options.budget,
    )


METHOD = Method(
    Card(
        "trajectory",
        ("integrated motion with free initial attitude and rate, J physically consistent"),
        "maximum likelihood, Levenberg-Marquardt",
        "Ivanov 2021 section 3 with errata I1-I6, I15",
        "a camera or a gyro",
        (
            "scale of J and com without a known change; com along gravity without tilt; "
            "J_zz and products without rotation about more than one axis; heading without "
            "a camera"
        ),
        "moved",
        ("term", "hold", "prior", "robust"),
    ),
    run,
)
