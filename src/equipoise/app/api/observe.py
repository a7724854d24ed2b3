"""Observe: what a recording can and cannot show, before anything is estimated."""

from collections.abc import Sequence

from equipoise.app.arguments import inputs
from equipoise.app.runs import observation
from equipoise.app.runs.observation import Observation


def observe(
    recording: inputs.AnyRecording,
    testbed: inputs.AnyTestbed,
    *,
    terms: Sequence[str] = (),
    hold: Sequence[str] = (),
    use_prior: bool = False,
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

    Raises
    ------
    InputError
        For files that cannot be read, unknown names, and a recording that does not fit the testbed.
    """
    bed = inputs.testbed_from(testbed)
    requested = inputs.options_from(terms, hold, use_prior)
    return observation.run(inputs.recording_from(recording, bed), bed, requested)
