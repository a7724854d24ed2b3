"""Calibrate: from a recording of commanded moves to the parameters of drives and sensors."""

from equipoise.estimation.calibration import calibration
from equipoise.estimation.calibration.calibration import CalibrateOptions
from equipoise.model.estimate import Estimate
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed
from equipoise.procedure.steps.clean_record import sound


def calibrate(recording: Recording, testbed: Testbed, options: CalibrateOptions) -> Estimate:
    """Return the calibration by the sound rows of a recording."""
    recording, testbed = sound(recording, testbed)
    return calibration.calibrate(recording, testbed, options)
