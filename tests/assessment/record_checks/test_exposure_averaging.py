"""The window of rows that are means, from the lengths of their quaternions."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from equipoise.assessment.findings.record_findings import findings
from equipoise.assessment.record_checks.exposure_averaging import (
    RowAveraging,
    row_averaging,
    with_window,
)
from equipoise.io.recording.recording_file import read_recording
from equipoise.io.testbed.presets import read_preset
from equipoise.maths.attitude import exponential, multiply, normalise
from equipoise.model.recording import Recording, Samples
from equipoise.model.testbed import AttitudeSensor
from equipoise.sensors.timing import measured_at

REAL = Path(__file__).parents[4] / "shared" / "data" / "optitrack_tumbling.csv"
T = np.arange(300) * 0.1


def spinning(t: np.ndarray, speed: float) -> np.ndarray:
    """Attitudes of a coning platform whose spin (rad/s) falls by a fifth within 30 s."""
    heading = speed * (t - t**2 / 300)
    turn = np.stack([0 * t, 0 * t, heading], axis=-1)
    tilt = 0.08 * np.stack([np.cos(0.9 * t), np.sin(0.7 * t), 0 * t], axis=-1)
    return multiply(exponential(tilt), exponential(turn))


def means(speed: float, offsets: np.ndarray, digits: int = 7) -> tuple[Samples, Samples]:
    """Rows that are means of frames at some offsets (s), printed with so many digits."""
    frames = spinning(T[:, None] + offsets, speed)
    mean = np.round(frames.mean(axis=1), digits)
    lengths = np.linalg.norm(mean, axis=1)[:, None]
    return Samples(T, normalise(mean)), Samples(T, lengths)


def said(attitude: Samples, lengths: Samples, testbed=None) -> str:
    record = Recording(attitude=attitude, attitude_norm=lengths)
    return " ".join(f"{f.kind}: {f.sentence}" for f in findings(record, testbed))


def test_two_frames_by_hand() -> None:
    """Turned by +-a/2 about z their mean is cos(a/4): frames 0.06 s apart at 2 rad/s, a = 0.12.

    Variance 0.03^2, so the uniform window is sqrt(12) * 0.03 = 0.10392 s.
    """
    half = 0.03
    frames = exponential(np.multiply.outer([-half, half], [0, 0, 2.0]))
    assert np.linalg.norm(frames.mean(axis=0)) == pytest.approx(np.cos(0.03), abs=1e-15)
    length = np.full((len(T), 1), np.cos(0.03))
    reported = row_averaging(Samples(T, exponential(np.outer(T, [0, 0, 2.0]))), Samples(T, length))
    assert reported is not None
    assert reported.window == pytest.approx(np.sqrt(12) * half, rel=1e-4)
    assert reported.damping == pytest.approx(4 * 0.03**2 * 12 / 24, rel=1e-3)  # w^2 T^2 / 24
    assert reported.odd == ()
    assert reported.steady


@pytest.mark.parametrize("digits", [5, 6, 7])
@pytest.mark.parametrize("speed", [1.5, 3.0, 4.9])
def test_four_frames_with_25_ms_spacing_are_a_window_of_97_ms(speed, digits) -> None:
    """Variance (n^2 - 1) / 12 dt^2: T = dt sqrt(15), wherever the row is stamped in it."""
    for start in (0.0, -0.0375, -0.075):
        reported = row_averaging(*means(speed, start + 0.025 * np.arange(4), digits))
        assert reported is not None
        # Rounding, and what the second order leaves out at 280 deg/s: 0.04 %.
        wanted = 0.025 * np.sqrt(15)
        assert abs(reported.window - wanted) < 4 * reported.sd + 5e-4 * wanted
        assert reported.sd < 0.02 * wanted
        assert reported.odd == ()
        assert reported.steady


def test_the_error_is_of_the_size_of_its_sd() -> None:
    """Lengths with white noise of 1e-4 over 60 seeds: squares of error over sd have mean one."""
    attitude, lengths = means(3.0, 0.025 * np.arange(-1.5, 2))
    found = []
    for seed in range(60):
        rng = np.random.default_rng(seed)
        noisy = Samples(T, lengths.values + rng.normal(scale=1e-4, size=(len(T), 1)))
        reported = row_averaging(attitude, noisy)
        assert reported is not None
        found.append((reported.window - 0.025 * np.sqrt(15)) / reported.sd)
    assert 0.6 < np.mean(np.square(found)) < 1.6


def test_rounding_alone_yields_no_averaging_window() -> None:
    """Single frames with five digits: lengths scatter about one."""
    for seed in range(20):
        shift = np.random.default_rng(seed).uniform(0, 0.1)
        assert row_averaging(*means(3.0, np.array([shift]), 5)) is None


def test_quaternion_lengths_uncorrelated_with_the_rate_yield_no_window() -> None:
    """10 % short at 0.3 rad/s would be a window of 10 s."""
    attitude = Samples(T, exponential(np.outer(T, [0, 0, 0.3])))
    assert row_averaging(attitude, Samples(T, np.full((len(T), 1), 0.9))) is None


@pytest.mark.parametrize("rows", [(299,), (0,), (150,), (20, 151, 299)])
def test_single_frames_among_means_are_named(rows) -> None:
    """Each is a frame of its own, whole; it may be turned as far off as the real file's last."""
    attitude, lengths = means(3.0, 0.025 * np.arange(4))
    q, norm = attitude.values.copy(), lengths.values.copy()
    for row in rows:
        norm[row] = 1.0
        q[row] = multiply(q[row], exponential(np.radians([0.0, 1.0, 3.0])))
    reported = row_averaging(Samples(T, q), Samples(T, norm))
    assert reported is not None
    assert reported.odd == rows
    assert reported.window == pytest.approx(0.025 * np.sqrt(15), rel=2e-3)
    text = said(Samples(T, q), Samples(T, norm))
    assert f"problem: row {rows[-1] + 1} at {T[rows[-1]]:g} s is not averaged like" in text


def test_a_window_that_changes_is_said() -> None:
    """Four frames at first, two later."""
    four, two = means(3.0, 0.025 * np.arange(4)), means(3.0, 0.025 * np.arange(2))
    late = (T > 15)[:, None]
    lengths = Samples(T, np.where(late, two[1].values, four[1].values))
    reported = row_averaging(four[0], lengths)
    assert reported is None or not reported.steady
    assert "over different windows" in said(four[0], lengths)


def test_the_rows_of_a_sensor_with_the_window_stand_for_the_same_moments() -> None:
    """Whatever delay and averaging the testbed had."""
    reported = RowAveraging(0.1, 1e-4, True, 1e-3, 2e-4, ())
    for delay, averaging in ((0.0, 0.0), (0.02, 0.0), (0.0, 0.06)):
        sensor = AttitudeSensor(10.0, 1e-3, delay, averaging)
        changed = with_window(sensor, reported)
        assert changed.averaging == 0.1
        np.testing.assert_allclose(measured_at(T, changed), measured_at(T, sensor), atol=1e-15)


def test_the_testbed_is_held_against_the_record() -> None:
    """0.0968 s is shown by the record; 0 s and 0.05 s are wrong by more than matters."""
    rows = means(3.0, 0.025 * np.arange(4))
    bed = read_preset("sputnix")
    assert bed.attitude is not None
    for stated, wrong in ((0.0, True), (0.05, True), (0.0968, False)):
        other = replace(bed, attitude=replace(bed.attitude, averaging=stated))
        assert ("problem: the testbed states" in said(*rows, other)) == wrong


@pytest.mark.skipif(not REAL.is_file(), reason="the real recording is not at hand")
def test_the_real_record() -> None:
    """Found elsewhere from the same lengths: 4 frames 25.06 ms apart; the last row is a frame."""
    record = read_recording(REAL)
    reported = row_averaging(record.attitude, record.attitude_norm)
    assert reported is not None
    assert reported.window == pytest.approx(25.06e-3 * np.sqrt(15), rel=3e-3)
    assert reported.odd == (600,)
    assert reported.steady
    sentences = " ".join(f.sentence for f in findings(record))
    assert "row 601 at 60 s is not averaged like the others" in sentences
    assert "an average over 0.0971 s" in sentences
