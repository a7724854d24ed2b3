"""A record's platform is let go so that it meets no stop, where there is such a start."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.io.testbed.presets import read_preset
from equipoise.maths.attitude import tilt
from equipoise.model.units import UM
from equipoise.simulation.bench import SimulatedBench
from equipoise.simulation.carried_out import record, recorded
from equipoise.simulation.free_start import freely

LIMIT = np.radians(30.0)


def hung(testbed, aside, height, **start):
    """A platform of the given centre of mass (um), drawn within 3 deg of level, at rest."""
    given = {"attitude": None, "tilt": np.radians(3.0)} | start
    return testbed((aside * UM, 0.0, height * UM), truth=given, tilt_limit=LIMIT)


def two_minutes(bench):
    return bench.read(120.0)


@pytest.mark.parametrize("seed", range(4))
def test_a_platform_that_hangs_within_its_stop_is_let_go_within_it(testbed, seed):
    """It hangs at 24.2 deg: let go level it would swing to twice that."""
    setup = hung(testbed, 90.0, -200.0)
    level = SimulatedBench(setup, seed)
    level.read(120.0)
    assert level.touches
    bench, rows = freely(setup, seed, two_minutes)
    assert bench.touches == ()
    angles = tilt(rows.attitude.values, setup.up)
    assert angles.max() < LIMIT
    assert np.ptp(angles) > np.radians(5.0)  # nearly as far as the stop lets it
    np.testing.assert_array_equal(bench.platform.body.com, level.platform.body.com)
    np.testing.assert_array_equal(bench.platform.rate, level.platform.rate)


def test_a_start_that_meets_no_stop_stays_as_it_is_drawn(testbed):
    """11.3 deg aside: it swings to 23 deg or so."""
    setup = hung(testbed, 40.0, -200.0)
    rows = record(setup, 120.0, (), 1)
    np.testing.assert_array_equal(
        rows.attitude.values, SimulatedBench(setup, 1).read(120.0).attitude.values
    )


def test_moves_count(testbed, rail):
    """From upright a mass that goes 8.5 mm along x leads it to 12 deg aside: it swings to 24 deg.

    The start, up to 25 deg aside, comes on top of that.
    """
    setup = hung(testbed, 0.0, -2000.0, tilt=np.radians(25.0))
    setup, moves = replace(setup, masses=(rail(),)), [(20.0, {"x": 0.0085})]
    drawn = SimulatedBench(setup, 1)
    recorded(drawn, 120.0, moves)
    assert drawn.touches[0].start > 20.0
    bench, _ = freely(setup, 1, lambda bench: recorded(bench, 120.0, moves))
    assert bench.com[0] == pytest.approx(0.5 * 0.0085 / 10.0)
    assert bench.touches == ()


@pytest.mark.parametrize(("aside", "height"), [(150.0, -200.0), (0.0, 100.0), (200.0, 0.0)])
def test_a_platform_that_meets_its_stop_from_any_start_is_let_go_as_drawn(testbed, aside, height):
    """It hangs at 37 deg, stands on its head, or hangs at 90 deg."""
    setup = hung(testbed, aside, height)
    bench, _ = freely(setup, 1, two_minutes)
    assert bench.touches
    drawn = SimulatedBench(setup, 1).platform.attitude
    np.testing.assert_array_equal(bench.platform.attitude, drawn)


def test_a_given_start_is_kept(testbed):
    setup = hung(testbed, 90.0, -200.0, attitude=np.zeros(3))
    bench, rows = freely(setup, 1, two_minutes)
    assert bench.touches
    assert tilt(rows.attitude.values[0], setup.up) == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize("name", ["sputnix", "nanosat", "unb", "cubesat-tas", "reference-table"])
def test_records_of_presets_meet_their_stop_only_where_they_hang_by_it(name):
    bed = read_preset(name)
    for seed in range(12):
        bench, _ = freely(bed, seed, two_minutes)
        com, limit = bench.platform.body.com, bed.tilt_limit
        hangs = np.arccos(-com @ bed.up / np.linalg.norm(com))
        assert not bench.touches or hangs > limit - np.radians(2.0)
