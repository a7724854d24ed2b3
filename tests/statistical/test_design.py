"""Predictions of a design beside Monte Carlo: `verification/design_predictions.py`, few seeds."""

import pytest

from equipoise.io.testbed.presets import read_preset
from tests.support import thorough
from verification import design_predictions as check

SKEW, TIERED = check.pyramid(), read_preset("reference-table")


@pytest.mark.parametrize("testbed", [SKEW, TIERED], ids=["pyramid", "coarse and fine"])
def test_reach_and_what_moves_leave(testbed):
    rows = (
        *check.reach_rows(testbed, 30),
        *check.move_rows(testbed, range(thorough.count(300, 100))),
    )
    assert [row for row in rows if not row.ok] == []


def test_moves_as_balance_makes_them():
    rows = check.move_rows(read_preset("sputnix"), range(40))
    assert [row for row in rows if not row.ok] == []


def test_predicted_measurement_sds_agree_with_monte_carlo():
    errors = [check.measurement_error("unb", seed) for seed in range(10)]
    assert [row for row in check.measurement_rows("unb", errors) if not row.ok] == []
