"""Whether attitude rows are means of several frames, and over how long, by their lengths.

A mean of unit quaternions is shorter than one. For frames at times with variance var about their
mean, and a turn at the rate w (rad/s) between them,

    |q| = 1 - |w|^2 var / 8        var = T^2 / 12: a uniform window of T seconds

to second order in |w| T / 4 (at 280 deg/s and 0.1 s T comes out 0.04 % short). The lengths show how
wide the window is, not where in it the row is stamped: that is a delay, which a record of free
motion does not show and one with a gyro does (``gyro_consistency``). Rows that were normalised
before they were written show nothing. Taken as moments, such rows show a motion of the angular
frequency W smaller by W^2 T^2 / 24; that is given for a motion as fast as the platform turns.
Inertia fitted to them is off by about as much: once to twice, in simulated spins at 100 and 200
deg/s.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray

from equipoise.assessment.record_checks.robust_scatter import robust_sd
from equipoise.maths.local_motion import half_window, local_motion
from equipoise.model.arrays import Floats, Series1
from equipoise.model.finding import Finding
from equipoise.model.reasons.finding_reasons import FindingReason as Why
from equipoise.model.reasons.reason import one_reason
from equipoise.model.recording import Recording, Samples
from equipoise.model.testbed import AttitudeSensor
from equipoise.sensors.timing import lateness

NAMED = 5  # odd rows that are named one by one; chosen: a screen
FEWEST = 20  # rows for the estimate of a window (chosen)
SURE = 5.0  # sd of the window's square, from which it is reported (chosen)
TRIMMED = 4.0  # robust sd beyond which a row has no say in the window (chosen)
ROUNDS = 5  # of trimming; chosen: the rows left do not change after two or three
ODD = 6.0  # robust sd of a row's length from that of a mean (chosen: one row in 10^9)
OTHER = 0.5  # share of the shortness that is missing or too much in an odd row (chosen)
CALM = 9  # rows of the running median of the rate; chosen: one bad row spoils four fits
PIECES = 8  # of the record, whose windows are compared (chosen)
UNSTEADY = 0.05  # of the window, by which a piece may differ however sure it is (chosen)
LONGEST = 3.0  # row intervals; chosen: a moving mean over more smooths the motion away
EXACT = 1e-12  # to which a length is computed
MATTERS = 1e-4  # of inertia; chosen: below what any record of a minute shows


@dataclass(frozen=True, slots=True)
class RowAveraging:
    """The window over which attitude rows are means."""

    window: float  # s, of the uniform window with the same variance
    sd: float  # s
    steady: bool  # the same throughout the record
    damping: float  # -, of a motion as fast as the platform turns; its share that rows do not show
    shortness: float  # -, 1 - |q| of the median row
    odd: tuple[int, ...]  # rows, counted from 0, that are not means over this window


def averaging_findings(recording: Recording, sensor: AttitudeSensor | None) -> list[Finding]:
    """Return the window, whether it is what the testbed states, and the rows that have another."""
    reported = row_averaging(recording.attitude, recording.attitude_norm)
    if reported is None or recording.attitude is None:
        return []
    t = recording.attitude.t
    return [
        _window(reported),
        *_stated(reported, sensor),
        *_unsteady(reported),
        *_odd_rows(reported, recording, t),
    ]


def row_averaging(attitude: Samples | None, lengths: Samples | None) -> RowAveraging | None:
    """Return the window; None if the lengths do not show one."""
    if attitude is None or lengths is None or len(lengths) < FEWEST:
        return None
    rows = np.searchsorted(attitude.t, lengths.t)
    short, speed = 1.0 - lengths.values[:, 0], _speed_squared(attitude)[rows]
    square, sd, scatter = _window_squared(short, speed)
    if square <= SURE * sd or square > (LONGEST * attitude.period) ** 2:
        return None
    window = float(np.sqrt(square))
    return RowAveraging(
        window=window,
        sd=sd / (2.0 * window),
        steady=_steady(short, speed, window),
        damping=square * float(np.median(speed)) / 24.0,
        shortness=float(np.median(short)),
        odd=tuple(rows[_odd(short, speed * square / 96.0, scatter)].tolist()),
    )


def with_window(sensor: AttitudeSensor, averaging: RowAveraging) -> AttitudeSensor:
    """Return the sensor with this window, its rows standing for the same moments as before.

    A row stamped t stands for t - delay - averaging / 2. The window grows about that moment, so the
    delay shrinks by half of what the averaging gains: below zero for rows stamped at their middle.
    """
    delay = lateness(sensor) - 0.5 * averaging.window
    return replace(sensor, averaging=averaging.window, delay=delay)


def _speed_squared(attitude: Samples) -> Series1:
    """Return |w|^2 (rad^2/s^2) at the rows, from which single bad rows are kept out."""
    _, rate = local_motion(attitude.t, attitude.values, half_window(attitude.t, attitude.values))
    medians = np.median(sliding_window_view(np.sum(rate**2, axis=1), CALM), axis=1)
    return np.pad(medians, CALM // 2, mode="edge")  # at an edge the window stays as wide


def _window_squared(short: Series1, speed: Series1) -> tuple[float, float, float]:
    """Return T^2 (s^2) with its sd, and the scatter of the lengths about the law."""
    keep = speed >= np.median(speed)
    square = 96.0 * float(np.median(short[keep] / np.maximum(speed[keep], 1e-12)))
    scatter = 0.0
    for _ in range(ROUNDS):
        left = short - square * speed / 96.0
        scatter = float(robust_sd(left - np.median(left)))
        keep = np.abs(left) <= TRIMMED * scatter + EXACT
        weight = float(np.sum(speed[keep] ** 2))
        if weight == 0:
            return 0.0, np.inf, scatter
        square = 96.0 * float(speed[keep] @ short[keep]) / weight
    sd = 96.0 * scatter / float(np.sqrt(np.sum(speed**2)))
    return square, sd, scatter


def _steady(short: Series1, speed: Series1, window: float) -> bool:
    """Say whether each piece of the record shows the same window."""
    for piece in np.array_split(np.arange(len(short)), min(PIECES, len(short) // FEWEST)):
        square, sd, _ = _window_squared(short[piece], speed[piece])
        if abs(square - window**2) > max(SURE * sd, 2.0 * UNSTEADY * window**2):
            return False
    return True


def _odd(short: Series1, expected: Floats, scatter: float) -> NDArray[np.bool_]:
    """Say which rows are longer or shorter than a mean over the window."""
    off = np.abs(short - expected)
    return off > np.maximum(ODD * scatter, OTHER * expected)


def _window(averaging: RowAveraging) -> Finding:
    numbers = {"window": averaging.window, "sd": averaging.sd, "shortness": averaging.shortness}
    return Finding("content", one_reason(Why.ROWS_AVERAGED, **numbers, damping=averaging.damping))


def _stated(averaging: RowAveraging, sensor: AttitudeSensor | None) -> list[Finding]:
    """Return a problem if the testbed states another window, and the difference matters."""
    if sensor is None or abs(averaging.window - sensor.averaging) < SURE * averaging.sd:
        return []
    if averaging.damping * abs(1.0 - (sensor.averaging / averaging.window) ** 2) < MATTERS:
        return []
    numbers = {"stated": sensor.averaging, "window": averaging.window}
    return [Finding("problem", one_reason(Why.OTHER_WINDOW, **numbers))]


def _unsteady(averaging: RowAveraging) -> list[Finding]:
    if averaging.steady:
        return []
    return [Finding("problem", one_reason(Why.UNSTEADY_WINDOW))]


def _odd_rows(averaging: RowAveraging, recording: Recording, t: Series1) -> list[Finding]:
    lengths = recording.attitude_norm
    assert lengths is not None  # the window was estimated from them
    norm = dict(zip(lengths.t.tolist(), lengths.values[:, 0].tolist(), strict=True))
    theirs = 1 - averaging.shortness
    found = [_odd_row(k + 1, float(t[k]), norm[float(t[k])], theirs) for k in averaging.odd[:NAMED]]
    if len(averaging.odd) > NAMED:
        more = one_reason(Why.MORE_ROWS_NOT_MEANS, count=len(averaging.odd) - NAMED)
        found.append(Finding("problem", more))
    return found


def _odd_row(row: int, t: float, length: float, theirs: float) -> Finding:
    """Return a row whose quaternion has another length than the others'."""
    numbers = {"row": row, "t": t, "length": length, "theirs": theirs}
    return Finding("problem", one_reason(Why.ROW_NOT_A_MEAN, **numbers), (t, t), "no mean")
