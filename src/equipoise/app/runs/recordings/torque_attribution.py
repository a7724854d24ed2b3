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
    with waiting.doing("dividing the torque by cause"):
        torque = attribute_torque(recording, testbed, estimate)
    return AttributedTorque(testbed, recording, estimate, torque)
