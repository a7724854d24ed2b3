"""What is said of limits that no manoeuvre keeps: which, by how much, and what would help."""

import numpy as np

from equipoise.model.arrays import Floats
from equipoise.model.errors import InputError
from equipoise.model.units import DEG
from equipoise.planning.manoeuvre.manoeuvre_space import Space

LIMITS = (("tilt", "deg"), ("rate", "deg/s"))


def out_of_reach(space: Space, nearest: Floats, tried: int, alone: bool) -> InputError:
    """Return the error for limits that the ``nearest`` of so many manoeuvres passes by far.

    ``nearest`` (2,): tilt (rad) and rate (rad/s) with their margin. ``alone``: nothing is known
    from an earlier record.
    """
    passed = [
        f"{value / limit:.2g} times the {name} limit of {limit / DEG:.3g} {unit}"
        for (name, unit), value, limit in zip(LIMITS, nearest, space.limits, strict=True)
        if value > limit
    ]
    found = (
        f"that none of {tried} manoeuvres of {space.duration:.4g} s keeps the limits, the mildest "
        f"among them; the nearest comes to {' and '.join(passed)}, with its margin over the "
        "platforms that may be there"
    )
    return InputError(space.testbed.name, found, ", or ".join(helpful(space, nearest, alone)))


def helpful(space: Space, nearest: Floats, alone: bool) -> list[str]:
    """Return what may help, each as a phrase."""
    com = 1e6 * float(np.max(space.testbed.com_sd))
    known = (
        "a short swing recorded first, which the plan is given as prior record "
        f"(the centre of mass is known to {com:.3g} um only)"
    )
    rate = ["a greater limit of the rate"] if nearest[1] > space.rate_limit else []
    balanced = "a platform that was balanced roughly before, with that centre of mass in its file"
    return ["a shorter record", *([known] if alone else []), balanced, *rate]
