"""What a torque's coefficient costs a model: its usual size on benches is its prior."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.estimation.events.record_model import improbability, refitted, shrunk
from equipoise.estimation.model_selection.model_choice import surplus, with_group
from equipoise.io.testbed.presets import read_preset
from equipoise.maths.attitude import exponential, multiply
from equipoise.model.recording import Samples
from equipoise.model.torque_terms import GROUPS
from equipoise.study.papers import ivanov
from tests.estimation.events.test_event_evidence import estimated
from tests.support.builders import noisy
from tests.support.event_records import with_event

BENT = 1e-6  # rad/s2, chosen: of the camera, about x, which drift explains as well as it can


def bent(record):
    """The record turned ever faster about x, by hardly more than the camera's noise."""
    attitude, t = record.attitude, record.attitude.t
    turn = np.outer(BENT * (t - t[0]) ** 2 / 2, [1.0, 0.0, 0.0])
    turned = multiply(attitude.values, exponential(turn))
    return replace(record, attitude=Samples(t, turned))


@pytest.mark.parametrize("change", [lambda record: record, bent])
@pytest.mark.parametrize("group", ["drift", "constant", "quadratic", "sag"])
def test_two_ways_to_the_likelihood_ratio_agree(group, change):
    """From the optimum without a group (Laplace), and from both optima by their evidence."""
    poorer = estimated(change(noisy(with_event("impulse", 0.0), 2)))
    richer = refitted(with_group(poorer, GROUPS[group]))
    gained = improbability(poorer) - improbability(richer)
    assert gained == pytest.approx(surplus(poorer, GROUPS[group]), abs=0.3)


def test_a_cost_drawn_towards_zero_grows_by_hand():
    """N = 3 and 1 more about zero: from d = 2 to 1.5, 3 (0.5)^2 + 1.5^2 = 3."""
    assert shrunk(np.array([2.0]), np.array([[3.0]]), np.array([1.0])) == pytest.approx(3.0)


def test_a_cost_drawn_towards_zero_grows_by_its_least():
    """The least of the sum of both, found by its gradient."""
    rng = np.random.default_rng(5)
    root, d, more = rng.normal(size=(6, 6)), rng.normal(size=6), np.array([0, 2.0, 0, 5.0, 1.0, 0])
    information = root @ root.T
    x = np.linalg.solve(information + np.diag(more), information @ d)
    least = (x - d) @ information @ (x - d) + x @ np.diag(more) @ x
    assert shrunk(d, information, more) == pytest.approx(least, rel=1e-12)


@pytest.mark.parametrize("seed", [6, 12])
def test_drift_that_nobody_declared_is_not_taken_for_sag(seed):
    """75 s at 1 um/min, of a camera alone: sag would leave the height open."""
    found = ivanov.experiment(read_preset("sputnix"), seed).estimate
    assert not {p.name for p in found.parameters} & set(GROUPS["sag"])
    sd = np.sqrt(np.diag(found.covariance_of(("com_x", "com_y", "com_z"))))
    assert np.all(np.abs(found.com - ivanov.COM) < 4 * sd)
    assert np.all(sd < [1e-6, 1e-6, 5e-6])
