"""Calibrate: what masses really do for their commands, and how sensors are aligned."""

from collections.abc import Sequence

from equipoise.app.arguments import inputs
from equipoise.app.arguments.options import BUDGET_S
from equipoise.estimation.calibration.calibration import CalibrateOptions
from equipoise.model.estimate import Estimate
from equipoise.procedure.identification import calibrate as procedure


def calibrate(
    recording: inputs.AnyRecording,
    testbed: inputs.AnyTestbed,
    *,
    reference: Sequence[str] = (),
    terms: Sequence[str] = (),
    hold: Sequence[str] = (),
    use_prior: bool = False,
    budget_s: float = BUDGET_S,
) -> Estimate:
    """Estimate gain, rail and backlash of masses from commanded moves; alignment of sensors too.

    Whether the calibration is usable is its ``outcome``.

    Parameters
    ----------
    recording
        Recording of commanded moves, or its file.
    testbed
        Testbed, its file, or a preset's name.
    reference
        Masses whose weight and steps you trust, which fixes the scale.
    terms
        Torques to estimate too: viscous, quadratic, constant, swirl, sag or drift.
    hold
        Parameters to keep at the testbed's value, such as inertia_P_zz.
    use_prior
        Use the testbed's inertia and centre of mass with their sd.
    budget_s
        Processor time that a search may take, s; it ends then with the best that it has found.

    Raises
    ------
    InputError
        For files that cannot be read, unknown names, and a recording that does not fit the testbed.
    """
    bed, requested = inputs.testbed_from(testbed), inputs.options_from(terms, hold, use_prior)
    budget = inputs.budget_from(budget_s)
    options = CalibrateOptions(tuple(reference), requested.terms, requested.hold, use_prior, budget)
    return procedure.calibrate(inputs.recording_from(recording, bed), bed, options)
