"""Case S made by MuJoCo, which shares no code with what is judged: bodies of the same size.

Platform, move and noise are drawn by ``tests.oracle.cases``; what is believed beforehand is drawn
about its truth as ``case_s.trusted`` says, so that sd and error agree.
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from equipoise.maths.linalg import pack_symmetric
from equipoise.model.arrays import Vector6
from equipoise.model.testbed import Testbed
from tests.oracle import cases
from tests.oracle.defects import CONTACTS, Contact, Defects
from verification import case_s

PULSE = 0.020  # s


class Sample(NamedTuple):
    """One record."""

    logged: cases.Logged
    inertia: Vector6  # kg m^2, true


def sample(logged: cases.Logged) -> Sample:
    """Return a record with its inertia."""
    return Sample(logged, pack_symmetric(logged.truth.inertia_P))


def untouched(seed: int) -> Sample:
    """Return the record of one seed without any defect."""
    return sample(cases.case_s(seed))


def touched_once(seed: int, event: case_s.Event) -> Sample:
    """Return the same with one contact: the impulse (laboratory axes) within ``PULSE``."""
    contact = Contact(event.t, PULSE, event.impulse)
    return sample(cases.case_s(seed, (), Defects(contacts=(contact,))))


def touched(seed: int) -> Sample:
    """Return the same with contacts as drawn: 1 to 4 at any time, 0.2 to 2 mN m s, 10 to 50 ms."""
    return sample(cases.case_s(seed, (CONTACTS,)))


def strong(one: Sample, size: float, until: float) -> list[float]:
    """Return the times (s) of contacts beyond a size (N m s), until a time."""
    contacts = one.logged.defects.contacts
    return [c.time for c in contacts if np.linalg.norm(c.impulse) > size and c.time < until]


def testbed(one: Sample, seed: int, doubt: float) -> Testbed:
    """Return what is known beforehand; its inertia is wrong by ``doubt``."""
    guess = case_s.estimated(one.inertia, doubt, np.random.default_rng([seed, 6]))
    return replace(one.logged.testbed, body=guess, inertia_sd=doubt)


testbed.__test__ = False  # pytest would take its name for a test's
