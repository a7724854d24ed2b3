"""What a manoeuvre is said to tell is what a fit of its recording says, and what the bench does."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from equipoise.design.noiseless_record import imagined
from equipoise.design.predicted import Known, followed_truth, predicted
from equipoise.estimation import fisher
from equipoise.estimation.trajectory import Params
from equipoise.io.presets import read_preset
from equipoise.model.estimate import COM, INERTIA
from equipoise.model.manoeuvre import Manoeuvre, SquareWave

BODY = (*INERTIA, *COM)
X = np.array([1.0, 0.0, 0.0])
PAPER = Manoeuvre(
    120.0, np.radians(4.0), X, np.array([-0.010, -0.004, 0.011]),
    ((60.0, {"x1": -0.010, "y1": -0.010, "z1": -0.050}),),
)  # fmt: skip
WHEELED = Manoeuvre(
    60.0, np.radians(3.0), X, np.zeros(3), ((20.0, {"coarse_z": -0.030}),),
    (SquareWave("rw_x", 0.001, 40.0), SquareWave("rw_z", 0.002, 30.0)),
)  # fmt: skip


@cache
def sputnix():
    return read_preset("sputnix")


@cache
def table():
    return read_preset("reference-table")


@pytest.mark.parametrize(
    ("testbed", "manoeuvre"), [(sputnix(), PAPER), (table(), WHEELED)], ids=["camera", "wheels"]
)
def test_it_is_what_observe_says_of_the_recording(testbed, manoeuvre):
    """`observe` fits the noiseless rows first, and ends at the truth: sd within 1e-3."""
    params = Params(testbed.disturbances)
    said = predicted(testbed, testbed.body, manoeuvre, params)
    seen = fisher.seen_by(imagined(testbed, testbed.body, manoeuvre).recording, testbed, params)
    assert said.names == seen.names
    np.testing.assert_allclose(said.sd, seen.sd, rtol=1e-3)


def test_it_is_what_observe_says_along_the_same_motion():
    said = predicted(sputnix(), sputnix().body, PAPER, Params())
    seen = fisher.seen_along(followed_truth(sputnix(), sputnix().body, PAPER, Params()))
    np.testing.assert_array_equal(said.sd, seen.sd)
    assert said.peak_tilt == pytest.approx(seen.tilt[1], rel=1e-3)


def test_what_is_not_seen_is_infinite_and_named():
    said = predicted(sputnix(), sputnix().body, replace(PAPER, moves=()), Params())
    assert np.all(np.isinf(said.sd_of(BODY)))
    assert any("scale" in sentence for sentence in said.sentences)
    held = predicted(sputnix(), sputnix().body, PAPER, Params(hold=INERTIA))
    assert np.all(held.sd_of(INERTIA) == 0.0)


def test_what_is_known_counts_as_one_more_recording():
    """Known: what a first run like it told of the body. Then every sd is 2^-1/2 of one run's.

    But for what hanging masses add, which depends on the lag and so a little on all else: 1e-4.
    """
    alone = predicted(sputnix(), sputnix().body, PAPER, Params())
    where = [alone.names.index(name) for name in BODY]
    first = np.linalg.inv(alone.covariance[np.ix_(where, where)])
    both = predicted(sputnix(), sputnix().body, PAPER, Params(), Known(BODY, first))
    np.testing.assert_allclose(both.sd_of(BODY), alone.sd_of(BODY) / np.sqrt(2), rtol=1e-4)
