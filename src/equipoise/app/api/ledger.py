"""Ledger: the disturbance torque of each cause, second by second."""

from pathlib import Path

from equipoise.app.arguments import inputs
from equipoise.io.exchange.estimate_file import read_estimate
from equipoise.model.estimate import Estimate
from equipoise.model.torque_by_cause import TorqueByCause
from equipoise.procedure.identification.attribute_torque import attribute_torque


def ledger(
    recording: inputs.AnyRecording, estimate: Estimate | str | Path, testbed: inputs.AnyTestbed
) -> TorqueByCause:
    """Return what each cause added to the torque on a platform, with its 95 % band.

    Torques are means over each second, N m, body axes: subtract ``total`` from your own record.
    ``of("gravity")`` returns the torque of one cause with its sd; ``closure`` says whether the
    causes close the momentum balance.

    Parameters
    ----------
    recording
        Recording, or its file.
    estimate
        Estimate of ``identify``, of this recording or of another one of the platform, or the folder
        of its run. Its terms decide which causes are distinguished.
    testbed
        Testbed, its file, or a preset's name.

    Raises
    ------
    InputError
        For files that cannot be read, a recording that does not fit the testbed or is too short,
        and an estimate without inertia and centre of mass.
    """
    bed = inputs.testbed_from(testbed)
    found = estimate if isinstance(estimate, Estimate) else read_estimate(estimate)
    return attribute_torque(inputs.recording_from(recording, bed), bed, found)
