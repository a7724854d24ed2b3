"""The verdict on a hold counts what the tracker does not know, at each of its measurements."""

from functools import reduce

import numpy as np
import pytest

from equipoise.model.units import UM
from equipoise.procedure.balancing.hold_verdict import (
    Measured,
    course_from,
    followed,
    verdict_on,
)
from equipoise.procedure.steps.verify import Aim

AIM = Aim(np.array([0.0, 0.0, -100.0]) * UM, np.full(3, 3.0) * UM)


def at(*off_um, sd_um=(0.1, 0.1, 0.5)):
    """A posterior so many um from the target."""
    return Measured(AIM.target + np.array(off_um) * UM, np.diag((np.array(sd_um) * UM) ** 2))


def judged_on(measured, duration):
    """The verdict on measurements, one after the other."""
    first, *others = measured
    course = reduce(
        lambda course, each: followed(course, each, AIM), others, course_from(first, AIM)
    )
    return verdict_on(course, AIM, duration)


def test_a_height_known_to_1_7_um_cannot_pass_3_um():
    """The case of issue 35: z found at -99.9 +/- 1.7 um, truth -103.6 um."""
    judged = judged_on([at(1.6, 1.1, 0.1, sd_um=(0.1, 0.1, 1.7))], 600.0)
    assert judged.outcome == "undecided"
    assert judged.reasons[0].parameters == ("z",)
    assert "z not known precisely enough" in judged.sentence


@pytest.mark.parametrize(
    ("off", "outcome"),
    [(1.9, "passed"), (2.1, "undecided"), (3.9, "undecided"), (4.1, "failed")],
)
def test_two_sd_decide(off, outcome):
    """1.96 sd of 0.5 um about a tolerance of 3 um: below 2.02 it passes, above 3.98 it fails."""
    assert judged_on([at(0, 0, -off)], 60.0).outcome == outcome


def test_one_measurement_in_doubt_leaves_all_of_it_undecided():
    """However good the others are; the sentence has the farthest offset and its sd then."""
    judged = judged_on([at(0, 0, 0.5), at(0, 2.9, 0.1), at(0.2, 0, 0)], 60.0)
    assert judged.outcome == "undecided"
    assert judged.reasons[0].parameters == ("y",)
    assert "held for 1 min; at most (0.2 +/- 0.1, 2.9 +/- 0.1, 0.5 +/- 0.5) um" in judged.sentence
    np.testing.assert_allclose(judged.com, AIM.target + [0.2e-6, 0, 0])


def test_axes_that_are_outside_are_named_alone():
    judged = judged_on([at(0, 2.95, 0), at(-9.0, 0, 0)], 60.0)
    assert judged.outcome == "failed"
    assert judged.reasons[0].parameters == ("x",)
