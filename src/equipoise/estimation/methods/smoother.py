"""The trajectory fit with a drifting centre of mass: see ``drift_smoother``."""

from equipoise.estimation.method_contract import Method, Options, refused
from equipoise.estimation.methods.trajectory import params_of
from equipoise.estimation.model_selection import drift_smoother
from equipoise.estimation.model_selection.reference_fit import too_few
from equipoise.model.estimate import Estimate
from equipoise.model.method_card import Card
from equipoise.model.reasons.estimate_reasons import EstimateReason
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed


def run(recording: Recording, testbed: Testbed, options: Options) -> Estimate:
    """Return the estimate, with the course of the centre of mass."""
    if too_few(recording, testbed):
        return refused(METHOD.card, EstimateReason.TOO_FEW_ROWS, rows=recording.rows)
    return drift_smoother.estimate(recording, testbed, params_of(testbed, options))


METHOD = Method(
    Card(
        "smoother",
        ("integrated motion, J physically consistent; com is a random walk of estimated size"),
        "maximum a posteriori, Levenberg-Marquardt; equals a fixed-interval smoother",
        ("Rauch, Tung and Striebel 1965, around the trajectory fit of Ivanov 2021 section 3"),
        "a camera or a gyro",
        (
            "as trajectory; cannot separate drift from other slow torques; drift along "
            "gravity without tilt; a drift of constant rate is modelled as a random walk"
        ),
        "moved",
        ("term", "hold", "prior", "robust"),
    ),
    run,
)
