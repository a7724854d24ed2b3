"""A program that records until it is killed, and says what time its last rows have.

    python -m verification.recording_child FILE SEED

Rows at 200 Hz of attitude and rate, masses at 20 Hz, an event now and then; every number is a
function of its time, so that a reader can tell whether it is the one that was written.
"""

import sys
import time

import numpy as np

from equipoise.io.mcap.live_recording import LiveRecording, Opening
from equipoise.model.recording import Recording, Samples

RATE = 200  # Hz
BATCH = 5  # rows handed over at once


def turns(t: np.ndarray) -> np.ndarray:
    """Unit quaternions of a time."""
    return np.stack([np.cos(t / 9), np.sin(t / 9), 0 * t, 0 * t], axis=1)


def rates(t: np.ndarray) -> np.ndarray:
    """Rates of a time, rad/s."""
    return np.stack([np.sin(t), np.cos(t), t / 7], axis=1)


def main(path: str, seed: int) -> None:
    rng = np.random.default_rng(seed)
    opening = Opening(zero_ns=time.time_ns(), testbed="name = 'child'\n", drivers={"imu": "none"})
    file = LiveRecording(path, opening)
    begin, sent = time.monotonic(), 0
    while True:
        now = time.monotonic() - begin
        while sent + BATCH <= now * RATE:
            t = np.arange(sent, sent + BATCH) / RATE
            masses = Samples(t[:1], rates(t[:1])) if sent % 10 == 0 else None
            file.rows(
                Recording(Samples(t, turns(t)), Samples(t, rates(t)), ("x", "y", "z"), masses)
            )
            sent += BATCH
        if rng.uniform() < 0.002:
            file.event(now, "note", f"at row {sent}", {"row": sent})
            print(f"event {sent}", flush=True)
        file.turn(now)
        print(f"row {sent - 1}", flush=True)
        time.sleep(0.004)


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]))
