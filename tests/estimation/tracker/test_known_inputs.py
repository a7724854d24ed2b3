"""A record that is read in parts is tracked as the whole is: its inputs go on between the parts."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.estimation.tracker import tracker
from equipoise.estimation.tracker.known_inputs import inputs_kept, inputs_of
from equipoise.io.testbed.presets import read_preset
from equipoise.model.recording import Recording, Samples, join, rows_between
from equipoise.simulation.bench import SimulatedBench

PARTS = 0.4  # s, as it was read: each part ends with a row of the masses


@pytest.fixture(scope="module")
def driven():
    """Six seconds with a wheel driven, and a mass that travels, across the ends of parts."""
    bed = read_preset("reference-table")
    bench = SimulatedBench(bed, 2)
    parts = [bench.read(0.4)]
    for k in range(14):
        bench.drive({bed.wheels[0].name: (-1) ** k * 0.5 * bed.wheels[0].max_torque})
        if k % 4 == 1:
            bench.move({bed.masses[0].name: 1e-3 * k})
        parts.append(bench.read(0.4))
    whole = parts[0]
    for part in parts[1:]:
        whole = join(whole, part)
    return bed, whole


def in_parts(bed, recording, start):
    """The tracker's end after parts that share no row."""
    state, end = start, recording.span[1]
    for since in np.arange(start.t, end, PARTS):
        rows = rows_between(recording, float(since), min(float(since) + PARTS, end))
        state = tracker.track(rows, bed, tracker.Params(), state).end
    return state


def test_parts_without_a_common_row_give_the_whole_record_s_estimate(driven):
    """Within 1 % of its sds; a row less before each part makes it 28 sd of the centre of mass.

    The inertia is given, so that no row is passed again (``relinearisation``).
    """
    bed, recording = replace(driven[0], inertia_sd=0.0), driven[1]
    first = tracker.first_state(float(recording.attitude.t[0]), recording.attitude.values[0], bed)
    start = tracker.track(rows_between(recording, -1.0, 0.4), bed, tracker.Params(), first).end
    whole = tracker.track(recording, bed, tracker.Params(), start).end
    parts = in_parts(bed, recording, start)
    sd = np.sqrt(np.diag(whole.covariance))
    assert parts.t == whole.t
    assert np.abs((parts.rate - whole.rate) / sd[3:6]).max() < 0.01
    assert np.abs((parts.com - whole.com) / sd[6:9]).max() < 0.01
    np.testing.assert_allclose(np.diag(parts.covariance), sd**2, rtol=0.01)


def test_what_is_kept_is_the_last_row_and_the_one_before_it():
    """Behind 2.5 s: rows at 1 and 2 s, and what is to come; of the switch every change."""
    line = Samples(np.arange(5.0), np.arange(15.0).reshape(5, 3))
    record = Recording(momentum=line, masses=line, mass_names=("x", "y", "z"))
    kept = inputs_kept(inputs_of(None, record), 2.5)
    assert kept.momentum.t.tolist() == kept.masses.t.tolist() == [1.0, 2.0, 3.0, 4.0]
    more = replace(record, momentum=Samples(np.array([6.0]), np.ones((1, 3))), masses=None)
    grown = inputs_of(kept, more)
    assert grown.momentum.t.tolist() == [1.0, 2.0, 3.0, 4.0, 6.0]
    assert grown.mass_names == ("x", "y", "z")
