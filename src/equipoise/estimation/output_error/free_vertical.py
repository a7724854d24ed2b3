"""The camera's vertical as an unknown of the fit, as far as the testbed says that it may lean.

It is no term to be chosen: no camera is level to what a record shows of it, and the centre of mass
is well off before the record asks for the term.
"""

from dataclasses import replace

from equipoise.estimation.output_error.trajectory import Params
from equipoise.model import sensor_terms
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed

PLUMB = sensor_terms.GROUPS["plumb"]


def may_lean(recording: Recording, testbed: Testbed) -> bool:
    """Say whether a recording has rows of a camera whose vertical may lean."""
    camera, rows = testbed.attitude, recording.attitude
    return camera is not None and rows is not None and len(rows) > 0 and camera.plumb_sd > 0


def with_free_vertical(recording: Recording, testbed: Testbed, params: Params) -> Params:
    """Return the options with the camera's vertical free where it may lean."""
    if not may_lean(recording, testbed):
        return params
    return replace(params, sensor=sensor_terms.among((*params.sensor, *PLUMB)))
