"""A motion whose attitudes are known, and the tables that are made of it."""

import numpy as np
from scipy.spatial.transform import Rotation

from equipoise.io.columns.read_options import ReadOptions
from equipoise.io.recording.recording_file import read_recording
from equipoise.maths.attitude import to_matrix

T = np.arange(8) * 0.01
YAW = 30.0 + 2.0 * np.arange(8)  # deg, about the laboratory's Z
TILT = 10.0  # deg, then about the body's x
TURN = Rotation.from_euler("ZX", np.column_stack([YAW, np.full(8, TILT)]), degrees=True)


def read(tmp_path, text: str, **options):
    """Write and read a table."""
    (tmp_path / "r.csv").write_text(text)
    return read_recording(tmp_path / "r.csv", ReadOptions(**options))


def cells(*columns) -> list[list[str]]:
    """Return columns as rows of texts."""
    return [[repr(float(c)) for c in row] for row in np.column_stack(columns)]


def is_known_turn(recording, rows=slice(None)) -> None:
    """Compare attitudes with the known ones, at the given rows."""
    found = to_matrix(recording.attitude.values)
    np.testing.assert_allclose(found, TURN[rows].as_matrix(), atol=1e-12)
