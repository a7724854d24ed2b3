"""A long table takes little more memory than its numbers."""

import subprocess
import sys
from pathlib import Path

import pytest

ROWS = 1_000_000
LIMIT = 300  # MB of memory, all of Python included
READ = """
import resource, sys
from equipoise.io.recording.recording_file import read_recording
recording = read_recording(sys.argv[1])
print(len(recording.attitude), len(recording.rate), recording.attitude.t[-1])
print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss)
"""
HEADER = "time_s,q_w,q_x,q_y,q_z,omega_x_rad_s,omega_y_rad_s,omega_z_rad_s\n"


def long_table(path: Path, rows: int) -> Path:
    """Write a record of so many rows with all the digits of a double."""
    turned = [0.9998000066665778, 0.009599360012799891, 0.011999200015999863, 0.012799146683733186]
    tails = [
        "," + ",".join(repr(x) for x in [*turned, *(0.1 / (k + 1 + axis) for axis in range(3))])
        for k in range(997)
    ]
    with path.open("w") as file:
        file.write(HEADER)
        file.writelines(f"{k * 0.01!r}{tails[k % 997]}\n" for k in range(rows))
    return path


@pytest.mark.skipif(sys.platform != "linux", reason="the peak of memory is counted in kB there")
def test_a_million_rows_take_300_mb(tmp_path) -> None:
    path = long_table(tmp_path / "long.csv", ROWS)
    done = subprocess.run(
        [sys.executable, "-c", READ, str(path)], capture_output=True, text=True, check=True
    )
    attitude, rate, end, peak = done.stdout.split()
    assert (int(attitude), int(rate)) == (ROWS, ROWS)
    assert float(end) == pytest.approx(0.01 * (ROWS - 1))
    assert int(peak) < LIMIT * 1000
