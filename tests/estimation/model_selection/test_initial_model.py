"""When the body of a first fit takes the place of a guess that was far off."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.estimation.model_selection.initial_model import anchored
from equipoise.estimation.output_error.trajectory import Params, fit
from equipoise.maths.pseudo_inertia import from_inertia
from equipoise.model.mass_properties import parallel_axis
from tests.support.builders import MASS, move_at, noisy, platform, recording

END = 20.0


@pytest.fixture(scope="module")
def fitted():
    record, testbed = noisy(recording(END, move_at(5.0, END)), 1), platform()
    return record, testbed, fit(record, testbed, Params())


def shrunk(fitted, times):
    """The fit as if the body had turned out so many times as large."""
    body = fitted.point.body(MASS)
    com = times * body.com
    inertia_C = times * body.inertia_P - parallel_axis(MASS, com)
    return replace(fitted, point=replace(fitted.point, six=from_inertia(inertia_C), com=com))


def test_a_body_that_is_as_guessed_is_no_better_guess(fitted):
    record, testbed, found = fitted
    assert anchored(record, testbed, Params(), found) == (testbed, found)


def test_a_guess_ten_times_too_large_gives_way(fitted):
    record, testbed, found = fitted
    small = shrunk(found, 0.1)
    nearer, again = anchored(record, testbed, Params(), small)
    np.testing.assert_allclose(nearer.body.inertia_P, small.point.body(MASS).inertia_P)
    assert again.problem.testbed is nearer


def test_a_body_hundreds_of_times_smaller_than_its_guess_is_a_lost_fit(fitted):
    """Steps of integration would follow swings that no bench has."""
    record, testbed, found = fitted
    lost = shrunk(found, 1 / 500)
    assert anchored(record, testbed, Params(), lost) == (testbed, lost)
