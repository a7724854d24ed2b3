"""A balance that is kept during an experiment, and for hours; less of both than `make verify`."""

import numpy as np

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


def test_minutes_of_keeping_through_ports_lose_no_row():
    """Emulated Grbl and VN-100; the memory's growth counts in `make verify`, over hours."""
    done = kept_hours.kept(thorough.count(10, 3) / 60)
    assert (done.lost, done.stops) == (0, 0)
    assert done.worst < 3e-6
    assert done.sentence.startswith("Passed: held for")
