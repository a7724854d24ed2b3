"""Whether the platform stands upright in the recording's laboratory frame."""

import math

import numpy as np

from equipoise.maths.attitude import tilt
from equipoise.model.arrays import Vector3
from equipoise.model.errors import InputError
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed

TILTED = math.radians(60)  # chosen: no table on a hemisphere swings about a mean tilt beyond this


def check_frame(recording: Recording, testbed: Testbed) -> None:
    """Raise InputError when gravity does not point down: the frame, not the platform, is turned."""
    if recording.attitude is None or not len(recording.attitude):
        return
    angle = float(np.median(tilt(recording.attitude.values, testbed.up)))
    if angle <= max(TILTED, testbed.tilt_limit):
        return
    found = (
        f"gravity that does not point down: the platform would be tilted by "
        f"{math.degrees(angle):.0f} deg, with its body axis {_named(testbed.up)} as up"
    )
    wanted = (
        "attitudes that turn body into a laboratory whose Z is up. Is the laboratory Y up? Try "
        "--dialect optitrack, or a column map with lab_up; or set platform.up in the testbed. Did "
        "it fall over while it was recorded? Record it until you catch it"
    )
    raise InputError(recording.source or "recording", found, wanted)


def _named(up: Vector3) -> str:
    """Return x, -y and the like, or the components."""
    main = int(np.argmax(np.abs(up)))
    if np.abs(up[main]) > 1 - 1e-9:
        return ("-" if up[main] < 0 else "") + "xyz"[main]
    return "[" + ", ".join(f"{component:.3g}" for component in up) + "]"
