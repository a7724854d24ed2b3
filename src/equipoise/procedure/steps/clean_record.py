"""A recording without its odd rows, and the sensors as its rows show them.

Rows that lie off the motion of their neighbours, or repeat the one before, hold no information on
the platform. Rows that are means of several frames are predicted as means, when the testbed does
not state their length. Rounded rows are noisier than stated, and a sensor that the testbed does not
have is as noisy as its rows. A mass that flickers between two steps of its log stands.
"""

from dataclasses import replace

from equipoise.assessment.record_checks.exposure_averaging import row_averaging, with_window
from equipoise.assessment.record_checks.flagged_rows import (
    OddRows,
    odd_attitudes,
    odd_rates,
    odd_vectors,
)
from equipoise.assessment.record_checks.mass_flicker import without_flicker
from equipoise.assessment.record_checks.sensor_noise import shown_camera, shown_gyro
from equipoise.model.arrays import Bools
from equipoise.model.recording import Recording, Samples
from equipoise.model.testbed import Testbed
from equipoise.sensors.vector_sensors import CHANNELS

FEWEST = 20  # rows, chosen: among fewer nothing stands out
MOST = 0.2  # chosen: with a larger share of odd rows, it is the rest that is odd


def kept(channel: Samples, mask: Bools) -> Samples:
    """Return a channel without the rows of a mask, unless these are too many."""
    if mask.mean() > MOST:
        return channel
    return channel.where(~mask)


def sound_vectors(recording: Recording) -> dict[str, Samples]:
    """Return the rows of sensors of vectors, by channel, without those off their neighbours."""
    found = dict[str, Samples]()
    for name in CHANNELS:
        channel: Samples | None = getattr(recording, name)
        if channel is not None and len(channel) >= FEWEST:
            found[name] = kept(channel, odd_vectors(channel))
    return found


def sound(recording: Recording, testbed: Testbed) -> tuple[Recording, Testbed]:
    """Return the recording and the testbed that an estimator should use."""
    attitude, rate = recording.attitude, recording.rate
    reported = row_averaging(attitude, recording.attitude_norm)
    if attitude is not None and len(attitude) >= FEWEST:
        odd: OddRows = odd_attitudes(attitude)
        mask = odd.mask.copy()
        if reported is not None:
            mask[list(reported.odd)] = True
        attitude = kept(attitude, mask)
    if rate is not None and len(rate) >= FEWEST:
        rate = kept(rate, odd_rates(rate).mask)
    camera, gyro = shown_camera(attitude, testbed.attitude), shown_gyro(rate, testbed.gyro)
    if reported is not None and camera is not None and camera.averaging == 0:
        camera = with_window(camera, reported)
    observed = replace(testbed, attitude=camera, gyro=gyro)
    masses, vectors = without_flicker(recording, testbed), sound_vectors(recording)
    return replace(recording, attitude=attitude, rate=rate, masses=masses, **vectors), observed
