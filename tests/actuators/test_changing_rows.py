"""Rows at which masses stand add nothing to what their travels leave open."""

import numpy as np
import pytest

from equipoise.actuators.mass_errors import mass_errors
from equipoise.actuators.stops import changing_rows
from equipoise.io.testbed.presets import preset_names, read_preset
from equipoise.maths.straight_lines import read_at
from equipoise.model.recording import Samples

T = np.arange(0.0, 60.0, 0.2)
BEDS = [name for name in preset_names() if read_preset(name).masses]


def test_the_first_row_and_those_near_a_change_are_left():
    """One mass goes 3 mm between rows 20 and 21 of 100, a second each: 3 s and 4 rows about it."""
    values = np.where(np.arange(100) > 20, 0.003, 0.0)[:, None]
    found = changing_rows(Samples(np.arange(100.0), values))
    np.testing.assert_array_equal(found.t, [0, *range(14, 28)])
    np.testing.assert_array_equal(found.values[:, 0], [0] * 8 + [0.003] * 7)


def test_masses_that_stand_longer_have_the_same_track():
    values = np.where(T > 10.0, 0.003, 0.0)[:, None]
    whole = Samples(T, values)
    assert changing_rows(whole) is changing_rows(whole.where(T < 40.0))
    assert changing_rows(whole) is not changing_rows(Samples(T, 2 * values))


def test_a_track_that_never_rests_is_as_it_was():
    values = np.random.default_rng(0).normal(size=(len(T), 2))
    found = changing_rows(Samples(T, values))
    np.testing.assert_array_equal(found.t, T)
    np.testing.assert_array_equal(found.values, values)


def travelled(bed, rng, rows):
    """Return a track of up to three travels, each of one mass at no more than its speed."""
    values = np.zeros((len(rows), len(bed.masses)))
    for start in rng.choice([3.0, 20.0, 22.0, 41.0], size=rng.integers(1, 4), replace=False):
        i = int(rng.integers(len(bed.masses)))
        mass = bed.masses[i]
        way = rng.uniform(0.05, 0.4) * (mass.travel[1] - mass.travel[0])
        seconds = way / mass.speed * rng.uniform(1.0, 3.0)
        values[:, i] += np.interp(rows, [start, start + seconds], [0.0, way])
    if rng.random() < 0.5:
        values = np.round(values / 1e-3) * 1e-3  # measured in steps
    return Samples(rows, values)


@pytest.mark.parametrize("name", BEDS)
@pytest.mark.parametrize("period", [0.02, 0.2, 1.0])
def test_what_travels_leave_open_is_the_same(name, period):
    bed, rng = read_preset(name), np.random.default_rng(7)
    for _ in range(10):
        track = travelled(bed, rng, np.arange(0.0, 60.0, period))
        whole, near = mass_errors(track, bed.masses), mass_errors(changing_rows(track), bed.masses)
        assert near.names == whole.names
        assert near.at_rest == whole.at_rest
        np.testing.assert_array_equal(near.owner, whole.owner)
        np.testing.assert_allclose(near.sd, whole.sd, rtol=1e-12)
        np.testing.assert_array_equal(near.sag, whole.sag)
        if whole.response is None:
            assert near.response is None
            continue
        at = rng.uniform(-1.0, 61.0, 3000)  # not at a corner, which may be upright
        np.testing.assert_allclose(
            read_at(at, near.response.t, near.response.values),
            read_at(at, whole.response.t, whole.response.values),
            atol=1e-12,
        )
