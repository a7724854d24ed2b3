"""Assess: what a recording proves about a platform."""

import math
from collections.abc import Callable, Sequence

from equipoise.app.arguments import checks, inputs
from equipoise.app.arguments.options import BUDGET_S
from equipoise.app.runs.recordings import assessment
from equipoise.app.runs.recordings.assessment import AssessedPlatform, Recordings
from equipoise.app.runs.waiting import passing_on
from equipoise.model.step import Step
from equipoise.procedure.identification.assess import AssessOptions


def assess(
    recording: inputs.AnyRecording,
    testbed: inputs.AnyTestbed,
    *,
    before: inputs.AnyRecording | None = None,
    tilt: float = inputs.TILT,
    target: checks.Triple = (0.0, 0.0, 0.0),
    require_torque: float | None = None,
    require_offset: float | None = None,
    windows: float | None = None,
    terms: Sequence[str] = (),
    hold: Sequence[str] = (),
    budget_s: float = BUDGET_S,
    on_step: Callable[[Step], None] | None = None,
) -> AssessedPlatform:
    """Say what gravity still does to a platform, how surely, and whether that is good enough.

    The result has ``estimate``, ``verdict``, ``steps`` and ``findings``.

    Parameters
    ----------
    recording
        Recording of the platform swinging freely, or its file.
    testbed
        Testbed, its file, or a preset's name. Its inertia counts as known to its sd.
    before
        A recording made before balancing, or its file, to compare with.
    tilt
        Torque counts over directions within this angle of level, rad.
    target
        Where the centre of mass is wanted, from the centre of rotation, body axes, m.
    require_torque
        Torque of gravity that is allowed, rms over that range, N m.
    require_offset
        Distance of the centre of mass from its target that is allowed, m.
    windows
        Assess windows of this length along the recording too, s: drift and Allan deviation.
    terms
        Torques to consider too: viscous, quadratic, constant, swirl, sag or drift.
    hold
        Parameters to keep at the testbed's value, such as inertia_P_zz.
    budget_s
        Processor time that a search may take, s; it ends then with the best that it has found.
    on_step
        Called with each step as it is done, those of ``before`` last.

    Raises
    ------
    InputError
        For files that cannot be read, unknown names, limits that are not above zero, and a
        recording that does not fit the testbed.
    """
    bed, requested = inputs.testbed_from(testbed), inputs.options_from(terms, hold)
    for name, limit in (("require_torque", require_torque), ("require_offset", require_offset),
                        ("windows", windows)):  # fmt: skip
        checks.positive(name, limit)
    options = AssessOptions(
        checks.vector("target", target, 1.0),
        checks.between("tilt", tilt, 0.0, math.pi / 2),
        require_torque,
        require_offset,
        requested.terms,
        requested.hold,
        inputs.budget_from(budget_s),
    )
    earlier = None if before is None else inputs.recording_from(before, bed)
    of = Recordings(inputs.recording_from(recording, bed), earlier, windows)
    return assessment.run(of, bed, options, passing_on(on_step))
