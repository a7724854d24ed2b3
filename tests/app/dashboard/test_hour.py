"""`verification/dashboard_hour.py` for seconds: what 100 Hz cost."""

import pytest

from tests.support import thorough
from tests.support.dashboard_program import CHROMIUM
from verification.dashboard_hour import SHARE, growth, share, soaked
from verification.dashboard_hour import Observed as At


@thorough.whole
@pytest.mark.skipif(CHROMIUM is None, reason="no chromium: apt-get install chromium")
def test_a_quarter_of_a_minute_at_100_hz_costs_little():
    """Of a core; the page, whose beginning counts more here, twice what is wanted of an hour."""
    observed = soaked(2, 8.0)
    assert 0.0 < share(observed, "server") < SHARE
    assert 0.0 < share(observed, "page") < 2 * SHARE
    bench, clock = observed[-1].bench - observed[0].bench, observed[-1].clock - observed[0].clock
    assert bench > 0.85 * clock


def test_growth_is_the_relative_change_from_the_first_sample_to_the_last():
    """100, 105, 110 MB: ten of 105; a curve that is high in the middle alone is none."""
    assert growth([at(100.0), at(105.0), at(110.0)], "server") == pytest.approx(10 / 105)
    assert growth([at(100.0), at(130.0), at(100.0)], "server") == pytest.approx(0.0)


def at(megabytes):
    return At(0.0, 0.0, {}, {"server": megabytes})
