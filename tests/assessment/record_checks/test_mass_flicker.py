"""A mass whose log flickers between two steps, by hand."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.assessment.record_checks.mass_flicker import (
    flicker_findings,
    flicker_of,
    without_flicker,
)
from equipoise.model.recording import Recording, Samples
from tests.support.builders import platform, sliding_masses

STEP = 2e-3  # m
(ROUNDED, *_) = sliding_masses(accuracy=6e-4, resolution=STEP)
EXACT = replace(ROUNDED, accuracy=4e-4)


@pytest.mark.parametrize(
    ("logged", "stands", "count"),
    [
        ([0, 1, 0, 0, 1, 1, 0, 0], [0, 0, 0, 0, 0, 0, 0, 0], 2),
        ([0, 1, 0, 1, 2, 3, 3, 3], [0, 0, 0, 1, 2, 3, 3, 3], 1),  # on its way out
        ([2, 2, 1, 2, 1, 0, 0, 0], [2, 2, 2, 2, 1, 0, 0, 0], 1),  # down, and then away
        ([0, 1, 1, 1, 1, 1, 0, 0], [0, 1, 1, 1, 1, 1, 0, 0], 0),  # a second: it was moved
        ([0, 2, 0, 0, 0, 0, 0, 0], [0, 2, 0, 0, 0, 0, 0, 0], 0),  # by two steps
        ([0, 1, 2, 1, 0, 0, 0, 0], [0, 1, 1, 1, 0, 0, 0, 0], 1),  # at the turning point only
    ],
)
def test_a_step_aside_and_back_within_a_second_is_none(logged, stands, count) -> None:
    t = 0.2 * np.arange(len(logged))
    found = flicker_of(t, STEP * np.array(logged), ROUNDED)
    assert found.positions == pytest.approx(STEP * np.array(stands), abs=1e-12)
    assert found.times == count


@pytest.mark.parametrize("mass", [EXACT, replace(ROUNDED, resolution=0.0)])
def test_a_mass_that_stops_more_finely_than_its_steps_did_move(mass) -> None:
    logged = STEP * np.array([0.0, 1.0, 0.0, 1.0, 0.0])
    found = flicker_of(0.2 * np.arange(5), logged, mass)
    assert found.positions == pytest.approx(logged)
    assert found.times == 0


def test_columns_are_found_by_name_and_the_finding_names_the_mass() -> None:
    testbed = replace(platform(), masses=sliding_masses(6e-4, STEP))
    rows = np.zeros((6, 2))
    rows[2, 0] = rows[4, 0] = STEP
    rows[3:, 1] = 5 * STEP
    logged = Recording(
        masses=Samples(0.1 * np.arange(6), rows), mass_names=("y", "x"), source="here"
    )
    kept = without_flicker(logged, testbed)
    assert kept is not None
    assert kept.values[:, 0] == pytest.approx(np.zeros(6))
    assert kept.values[:, 1] == pytest.approx(rows[:, 1])
    (finding,) = flicker_findings(logged, testbed)
    assert finding.reasons[0].parameters == ("y",)
    assert finding.reasons[0].numbers == {"count": 2}
