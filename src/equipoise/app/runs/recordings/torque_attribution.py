"""One ledger of disturbance torque: an estimate, and the torque of each cause along its record."""

from dataclasses import dataclass

from equipoise.app.runs.recordings.identification import run as identified
from equipoise.app.runs.recordings.plausible_record import CLOSED, Gate
from equipoise.app.runs.waiting import QUIET, Waiting
from equipoise.model.estimate import Estimate
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed
from equipoise.model.torque_by_cause import TorqueByCause
from equipoise.procedure.identification.attribute_torque import attribute_torque
from equipoise.procedure.identification.identify import IdentifyOptions


@dataclass(frozen=True, slots=True, eq=False)
class AttributedTorque:
    """The torque of each cause, and what it was found from."""

    testbed: Testbed
    recording: Recording
    estimate: Estimate
    torque: TorqueByCause

    @property
    def is_good(self) -> bool:
        """Say whether the estimate may be used and the causes close the momentum balance."""
        return self.estimate.outcome.usable and self.torque.closes


def run(
    recording: Recording,
    testbed: Testbed,
    options: IdentifyOptions,
    waiting: Waiting = QUIET,
    gate: Gate = CLOSED,
) -> AttributedTorque:
    """Identify the platform from a recording that fits the testbed, and divide its torque."""
    estimate = identified(recording, testbed, options, waiting, gate).estimate
    return divided(recording, testbed, estimate, waiting)


def run_with(
    recording: Recording,
    testbed: Testbed,
    estimate: Estimate,
    waiting: Waiting = QUIET,
    gate: Gate = CLOSED,
) -> AttributedTorque:
    """Divide the torque on a platform whose estimate there is already."""
    with waiting.doing("examining the recording"):
        gate.findings(recording, testbed)
    return divided(recording, testbed, estimate, waiting)


def divided(
    recording: Recording, testbed: Testbed, estimate: Estimate, waiting: Waiting
) -> AttributedTorque:
    """Divide the torque on a platform among its causes."""
    with waiting.doing("dividing the torque by cause"):
        torque = attribute_torque(recording, testbed, estimate)
    return AttributedTorque(testbed, recording, estimate, torque)
