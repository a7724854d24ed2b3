"""A hold is judged by the truth of every second, and by nothing that the procedure says."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from equipoise.io.testbed.presets import read_preset
from equipoise.model.units import MINUTE, UM
from equipoise.model.verdict import VerdictOutcome
from equipoise.procedure.balancing.hold import HoldOptions
from equipoise.study.held_run import TrueCourseBench, held_run, rails_suffice
from equipoise.study.papers.ivanov import drift_of, drifting

BED = drifting(read_preset("sputnix"), 2 * UM / MINUTE, 3)
HOLDING = HoldOptions(duration=30.0)


@cache
def run():
    return held_run(BED, HOLDING, 3)


def test_the_truth_is_noted_every_second():
    bench = TrueCourseBench(BED, 3)
    bench.read(0.4)
    bench.read(5.0)
    np.testing.assert_allclose(bench.t, [0.4, 1.4, 2.4, 3.4, 4.4, 5.4])
    moved = bench.coms[-1] - bench.coms[0]
    np.testing.assert_allclose(moved, 5.0 * drift_of(BED), atol=1e-12)


def test_a_read_in_pieces_is_the_read_as_a_whole():
    whole, pieces = TrueCourseBench(BED, 3), TrueCourseBench(BED, 3)
    rows = whole.read(3.0).attitude
    parts = [pieces.read(1.0).attitude for _ in range(3)]
    np.testing.assert_array_equal(rows.values, np.vstack([part.values for part in parts]))


def test_a_hold_lasts_and_is_judged_from_the_end_of_the_balancing():
    done = run()
    assert done.held
    assert done.last.verdict is not None
    assert done.last.time - done.began == pytest.approx(30.0)
    assert 0 < done.at <= 30.0 + 1e-9
    assert done.start.shape == (3,)
    assert np.all(done.worst < 4 * HOLDING.tolerance)  # of the target 100 um below, not of nought


def test_false_is_a_pass_that_the_truth_denies():
    """Of balancing, by where it ended; of the hold, by the greatest distance."""
    good = replace(run(), balanced=VerdictOutcome.PASSED, worst=np.full(3, 2.9e-6),
                   start=np.zeros(3))  # fmt: skip
    assert good.well
    assert not good.false
    assert replace(good, start=np.array([0, 0, 3.1e-6])).false
    wide = replace(good, worst=np.array([0, 0, 3.1e-6]))
    assert not wide.well
    assert wide.false == (wide.outcome is VerdictOutcome.PASSED)
    assert not replace(good, held=False).well


def test_rails_of_50_mm_follow_110_um_along_an_axis():
    """Two loads of 15.6 g, 50 mm, 14.24 kg: 109.55 um; from com (0, 0, -100) um at the target."""
    bed = read_preset("sputnix")
    com = np.array([0.0, 0.0, -100.0]) * UM
    bed = replace(bed, truth=replace(bed.truth, com=com))
    for seconds, enough in ((109.0, True), (110.0, False)):
        drift = np.array([1.0 * UM, 0.0, 0.0])
        assert rails_suffice(bed, drift, com, seconds, 1) is enough


def test_rails_that_have_gone_half_their_way_follow_the_other_half():
    """50 um ahead of the target: 59.55 um are left of what drifts on, more of what returns."""
    bed, target = read_preset("sputnix"), np.array([0.0, 0.0, -100.0]) * UM
    bed = replace(bed, truth=replace(bed.truth, com=target + np.array([50.0, 0.0, 0.0]) * UM))
    for speed, seconds, enough in ((1.0, 59.0, True), (1.0, 60.0, False), (-1.0, 159.0, True)):
        drift = np.array([speed * UM, 0.0, 0.0])
        assert rails_suffice(bed, drift, target, seconds, 1) is enough
