"""Case S made by MuJoCo, which shares no code with what is judged: bodies of the same size.

Platform, move and noise are drawn by ``tests.oracle.cases``; what is believed beforehand is drawn
about its truth as ``case_s.believed`` says, so that sd and error agree.
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from equipoise.maths.linalg import pack_symmetric
from equipoise.model.arrays import Vector6
from equipoise.model.testbed import Testbed
from tests.oracle import cases
from tests.oracle import defects as D
from verification import case_s


class Sample(NamedTuple):
    """One record."""

    logged: cases.Logged
    inertia: Vector6  # kg m^2, true


def sample(seed: int, touched: bool) -> Sample:
    """Return the record of one seed, with contacts or without any defect."""
    logged = cases.case_s(seed, (D.CONTACTS,) if touched else ())
    return Sample(logged, pack_symmetric(logged.truth.inertia_P))


def testbed(one: Sample, seed: int, doubt: float) -> Testbed:
    """Return what is known beforehand; its inertia is wrong by ``doubt``."""
    guess = case_s.believed(one.inertia, doubt, np.random.default_rng([seed, 6]))
    return replace(one.logged.testbed, body=guess, inertia_sd=doubt)


testbed.__test__ = False  # pytest would take its name for a test's
