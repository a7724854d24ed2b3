"""What a file says beside its numbers, in words: conventions, origin, standard deviations."""

from collections.abc import Iterator

import numpy as np

from equipoise.model.estimate import COM, INERTIA
from equipoise.model.stated_body import StatedBody
from equipoise.model.version import __version__

TENSOR = "Products of inertia are elements of the tensor: J_xy = -integral of x y dm."
INTEGRAL = "Products of inertia are integrals here, +integral of x y dm: -J_xy of the tensor."
FRAME = "Body axes; P is the centre of rotation, C the centre of mass. SI units."


def lines_of(stated: StatedBody, sign: str = TENSOR) -> Iterator[str]:
    """Yield the lines of a comment: body, conventions, both inertias with their sd."""
    yield f"{stated.name}, written by Equipoise {__version__}."
    yield FRAME
    yield sign
    yield from stated.remarks
    sd = np.sqrt(np.diag(stated.covariance))
    yield f"mass {stated.body.mass!r} kg, sd {sd[0]:.2g}"
    yield from valued(COM, stated.body.com, sd[7:], "m")
    yield from valued(INERTIA, stated.about_P, sd[1:7], "kg m2")
    central = np.sqrt(np.diag(stated.covariance_about_C))[1:7]
    yield from valued(central_names(), stated.about_C, central, "kg m2")


def valued(names: tuple[str, ...], values: np.ndarray, sds: np.ndarray, unit: str) -> Iterator[str]:
    """Yield a line for each value with its sd."""
    for name, value, sd in zip(names, values, sds, strict=True):
        doubt = f"sd {sd:.2g}" if np.isfinite(sd) else "not shown by the data"
        yield f"{name} {float(value)!r} {unit}, {doubt}"


def central_names() -> tuple[str, ...]:
    """Return the names of the inertia about the centre of mass."""
    return tuple(name.replace("_P_", "_C_") for name in INERTIA)
