"""Tables of many rows, and the memory that a program takes for them."""

import subprocess
import sys
from pathlib import Path

import numpy as np

from equipoise.maths.attitude import exponential

HEADER = "time_s,q_w,q_x,q_y,q_z,omega_x_rad_s,omega_y_rad_s,omega_z_rad_s\n"
DIFFERENT = 997  # rows of one swing
PEAK = """
print([line.split()[1] for line in open("/proc/self/status") if line.startswith("VmHWM")][0])
"""
READ = f"""
import sys
from equipoise.io.recording.recording_file import read_recording
recording = read_recording(sys.argv[1])
print(len(recording.attitude), len(recording.rate), recording.attitude.t[-1])
{PEAK}"""
CONVERT = f"""
import sys
from equipoise.app.cli import run
code = run(["convert", *sys.argv[1:]])
assert not code
{PEAK}"""


def long_table(path: Path, rows: int) -> Path:
    """Write a record of so many rows at 100 Hz, with all the digits of a double."""
    phase = 2 * np.pi * np.arange(DIFFERENT) / DIFFERENT
    turn = 0.1 * np.stack([np.sin(phase), np.cos(phase), np.sin(2 * phase)], axis=1)
    swing = np.column_stack([exponential(turn), 0.01 * np.roll(turn, 1, axis=1)])
    tails = [",".join(["", *map(repr, row)]) for row in swing.tolist()]
    with path.open("w") as file:
        file.write(HEADER)
        file.writelines(f"{k / 100!r}{tails[k % DIFFERENT]}\n" for k in range(rows))
    return path


def in_its_own_process(program: str, *words: str | Path) -> list[str]:
    """Return the words that a program prints; the last is the most memory it held, in kB."""
    command = [sys.executable, "-c", program, *map(str, words)]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    return done.stdout.split()
