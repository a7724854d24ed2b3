"""Observe: what a recording can and cannot show, before anything is estimated."""

from collections.abc import Sequence
from dataclasses import replace

from equipoise.app.arguments import inputs
from equipoise.app.arguments.options import BUDGET_S
from equipoise.app.runs.recordings import observation
from equipoise.app.runs.recordings.observation import Observation


def observe(
    recording: inputs.AnyRecording,
    testbed: inputs.AnyTestbed,
    *,
    terms: Sequence[str] = (),
    hold: Sequence[str] = (),
    use_prior: bool = False,
    budget_s: float = BUDGET_S,
) -> Observation:
    """Return the least sd that any method can reach, parameter by parameter, SI units.

    Motion and sensors decide, not what the rows happen to say. The result has ``bounds`` and
    ``filters``: which part of its state each filter can observe.

    Parameters
    ----------
    recording
        Recording, or its file.
    testbed
        Testbed, its file, or a preset's name; its sensors' noise counts.
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
    bed = inputs.testbed_from(testbed)
    requested = inputs.options_from(terms, hold, use_prior)
    requested = replace(requested, budget=inputs.budget_from(budget_s))
    return observation.run(inputs.recording_from(recording, bed), bed, requested)
