"""A platform that tilts to its limit, where its stop is, is stopped there."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.io.testbed.presets import read_preset
from equipoise.maths.attitude import exponential
from equipoise.model.recording import Recording, Samples
from equipoise.procedure.steps.tilt_guard import guarded, tilted

LIMIT = float(np.radians(10.0))
BED = replace(read_preset("sputnix"), tilt_limit=LIMIT, up=np.array([0.0, 0.0, 1.0]))


def leaning(*shares, start=0.0):
    """Rows that lean about x by shares of the limit, ten a second."""
    turns = np.outer(np.array(shares) * LIMIT, [1.0, 0.0, 0.0])
    return Recording(attitude=Samples(start + 0.1 * np.arange(len(shares)), exponential(turns)))


@pytest.mark.parametrize(
    ("shares", "beyond"),
    [
        ((0.97, 0.97, 0.97), False),
        ((0.99, 0.99, 0.99), True),  # on its stop, as noisy rows show it
        ((1.01, 1.01, 1.01), True),
        ((0.5, 0.5, 3.0), False),  # one bad row decides nothing
        ((2.0, 0.9, 0.9, 0.9), False),
        ((0.5, 1.01, 1.02), True),
        ((0.5, 1.0, 1.0, 0.9, 0.5), True),  # it has come back: the stop has pushed it
        ((1.01,), True),
    ],
)
def test_the_median_of_any_three_rows_decides(shares, beyond):
    assert tilted(leaning(*shares), BED) is beyond


def test_only_rows_from_a_time_on_count():
    record = leaning(1.0, 1.0, 1.0, 0.5, 0.5, 0.5)
    assert tilted(record, BED, since=0.05)
    assert not tilted(record, BED, since=0.25)


def test_without_rows_nothing_is_known_to_tilt():
    assert not tilted(Recording(), BED)
    assert not tilted(leaning(), BED)


class Bench:
    """Leans by a share of the limit, which grows by a tenth with each second."""

    testbed = BED

    def __init__(self, share):
        self.time, self.share, self.stopped = 0.0, share, False

    def read(self, duration):
        shares = self.share + 0.1 * (self.time + 0.1 * np.arange(round(10 * duration)))
        rows = leaning(*shares, start=self.time)
        self.time += duration
        return rows

    def stop(self):
        self.stopped = True

    def move(self, targets, speed=0.0):
        raise AssertionError(targets)

    drive = move


def test_a_measurement_ends_with_its_duration_or_with_the_limit():
    """From half of the limit it takes 4.8 seconds to 98 %, and is noticed within one more."""
    calm, wild = Bench(0.1), Bench(0.5)
    assert guarded(calm, 8.0).attitude.t[-1] == pytest.approx(7.9)
    assert not calm.stopped
    assert 4.8 < guarded(wild, 8.0).attitude.t[-1] < 5.8
    assert wild.stopped
