"""The period of a swing about a known axis, from a recording of it.

The attitude's rotation vector from the first one has the swing as its component along the axis; the
component across it is noise, and what the support lets through. ``assessment.metrics.period`` fits
decaying sines to both, and the swing is the greatest along the axis. Period and amplitude are those
of the recording: what a large swing adds to the period is taken out with the moment of inertia.
"""

from dataclasses import replace

import numpy as np

from equipoise.assessment.metrics.period import Swing, swings
from equipoise.maths.attitude import difference
from equipoise.maths.axes_across import axes_across
from equipoise.model.errors import InputError
from equipoise.model.mass_budget import Oscillation
from equipoise.model.recording import Recording


def timed(swing: Oscillation, recording: Recording) -> Oscillation:
    """Return a swing with period, amplitude and decay of a recording, and the period's sd.

    Raises InputError for a recording without attitudes, or in which nothing swings about the axis.
    """
    if recording.attitude is None:
        wanted = "the attitude of the swing"
        raise InputError(recording.source, "a recording without attitude", wanted)
    t, q = recording.attitude.t, recording.attitude.values
    axes = np.vstack([swing.axis, axes_across(swing.axis)[:1]])
    found = swings(t - t[0], difference(q, q[0]) @ axes.T)
    if not found:
        wanted = "a period of it at least"
        raise InputError(recording.source, f"no swing about the axis of '{swing.name}'", wanted)
    main = max(found, key=along_axis)
    small = 1 + main.amplitude**2 / 16  # by which the metric's frequency is that of a small swing
    frequency = main.frequency / small
    return replace(
        swing,
        period=1 / frequency,
        period_sd=main.sd / small / frequency**2,
        amplitude=main.amplitude,
        amplitude_sd=0.0,  # it is in the sd of the frequency
        decay=max(main.decay, 0.0),
    )


def along_axis(swing: Swing) -> float:
    """Return the amplitude along the first signal, rad."""
    return swing.amplitude * abs(swing.shape[0])
