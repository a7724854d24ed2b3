"""A balance that is kept during an experiment, and for hours; less of both than `make verify`."""

import numpy as np
import pytest

from equipoise.procedure.balancing.hold import HoldOptions
from tests.support import thorough
from verification import keep, kept_hours

LASTS = float(thorough.count(900, 240))  # s


def test_a_platform_of_other_code_is_kept_within_its_budget():
    """Within 3 um while its experiment points it; its twin, left alone, points worse."""
    kept, alone = (keep.kept(LASTS, (3, alone)) for alone in (False, True))
    assert kept.well
    assert not kept.false
    assert kept.moves > 0
    assert 0 < kept.added <= keep.BUDGET.torque
    assert np.linalg.norm(alone.worst) > 2 * np.linalg.norm(kept.worst)
    assert alone.pointing > 1.5 * kept.pointing


@pytest.mark.parametrize("seed", [7, 10, 34])
def test_what_a_short_record_takes_for_damping_is_not_kept(seed):
    """These bodies have none; after 20 s their spin is explained by one, with a wrong inertia."""
    bench = keep.bench_of(seed)
    options = HoldOptions(keep.TARGET, np.full(3, keep.LIMIT), duration=1.0)
    _, known = keep.balanced(bench, options)
    assert not any(term.startswith("viscous") for term in known.found)


def test_minutes_of_keeping_through_ports_lose_no_row():
    """Emulated Grbl and VN-100; the memory's growth counts in `make verify`, over hours."""
    done = kept_hours.kept(thorough.count(10, 3) / 60)
    assert (done.lost, done.stops) == (0, 0)
    assert done.worst < 3e-6
    assert done.sentence.startswith("Passed: held for")
