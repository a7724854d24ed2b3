"""A real OptiTrack recording that nobody here made, when it is at hand."""

from pathlib import Path

import numpy as np
import pytest

from equipoise.assessment.findings.record_findings import findings
from equipoise.io.recording.recording_file import read_recording
from equipoise.maths.attitude import tilt

REAL = Path(__file__).parents[4] / "shared" / "data" / "optitrack_tumbling.csv"
pytestmark = pytest.mark.skipif(not REAL.is_file(), reason="the real recording is not at hand")


def test_its_rows_and_rate_are_those_of_its_readme() -> None:
    """601 rows, 10 Hz, 60 s; the derived rates are ignored, no mass is recorded."""
    recording = read_recording(REAL)
    assert recording.attitude is not None
    assert len(recording.attitude) == 601
    assert np.median(np.diff(recording.attitude.t)) == pytest.approx(0.1)
    assert recording.span == (0.0, 60.0)
    assert recording.rate is recording.masses is None


def test_its_body_y_axis_stays_near_the_vertical() -> None:
    """After the turn to Z up the tilt is at most about 8 deg, as published."""
    attitude = read_recording(REAL).attitude
    assert attitude is not None
    angles = np.degrees(tilt(attitude.values, np.array([0.0, 1.0, 0.0])))
    assert 5.0 < angles.max() < 8.0
    np.testing.assert_allclose(np.linalg.norm(attitude.values, axis=1), 1, atol=1e-12)


def test_the_lengths_of_its_quaternions_are_kept() -> None:
    """All rows but the last are means of frames, as published: 0.99977 against 1.000000."""
    recording = read_recording(REAL)
    assert "means of several frames" in " ".join(recording.notes)
    lengths = recording.attitude_norm
    assert lengths is not None
    assert lengths.values[-2, 0] == pytest.approx(0.99977, abs=1e-5)
    assert lengths.values[-1, 0] == pytest.approx(1.0, abs=1e-6)


def test_its_noise_estimate_is_within_the_published_range() -> None:
    """Published: 0.0075-0.012 deg at rest, 0.036-0.048 deg left by the best model in motion."""
    said = next(f.sentence for f in findings(read_recording(REAL)) if "noise" in f.sentence)
    assert 0.0075 < float(said.split()[2]) < 0.05
