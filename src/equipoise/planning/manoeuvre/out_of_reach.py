"""What is said of limits that no manoeuvre keeps: which, by how much, and what would help."""

import numpy as np

from equipoise.model.arrays import Floats
from equipoise.model.errors import InputError
from equipoise.model.units import DEG
from equipoise.planning.manoeuvre.manoeuvre_space import Space

LIMITS = (("tilt", "deg"), ("rate", "deg/s"))


def count_kept(space: Space, peaks: Floats) -> int:
    """Return of how many platforms the peaks (k, 2) of tilt (rad) and rate (rad/s) keep limits."""
    return int(np.sum(np.all(peaks <= space.limits, axis=1)))


def out_of_reach(space: Space, nearest: Floats, tried: int, alone: bool) -> InputError:
    """Return the error for limits that the ``nearest`` of so many manoeuvres passes.

    ``nearest`` (k, 2): peaks of tilt (rad) and rate (rad/s) of k platforms that may be there.
    ``alone``: nothing is known from an earlier record.
    """
    greatest = nearest.max(axis=0)
    passed = [
        f"{value / limit:.2g} times the {name} limit of {limit / DEG:.3g} {unit}"
        for (name, unit), value, limit in zip(LIMITS, greatest, space.limits, strict=True)
        if value > limit
    ]
    found = (
        f"that none of {tried} manoeuvres of {space.duration:.4g} s keeps the limits, "
        f"not even the mildest: the nearest does with {count_kept(space, nearest)} of "
        f"{len(nearest)} possible platforms, others reach {' and '.join(passed)}"
    )
    return InputError(space.testbed.name, found, ", or ".join(helpful(space, greatest, alone)))


def helpful(space: Space, greatest: Floats, alone: bool) -> list[str]:
    """Return what may help, each as a phrase."""
    com = 1e6 * float(np.max(space.testbed.com_sd))
    known = (
        "a short swing recorded first, given to the plan as prior record (the centre "
        f"of mass is known to {com:.3g} um only)"
    )
    rate = ["a higher rate limit"] if greatest[1] > space.rate_limit else []
    balanced = (
        "a platform that was balanced roughly before, with its centre of mass in the testbed file"
    )
    return ["a shorter record", *([known] if alone else []), balanced, *rate]
