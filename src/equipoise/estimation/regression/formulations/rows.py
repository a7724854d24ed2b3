"""Rows that are linear in the unknowns, whatever made them.

    A_k x + c_piece = b_k,        k = 1 ... n, each with m equations

The unknowns x go by name (inertia_P_xx ..., com_x ..., torque terms), in SI, so that nobody has to
know columns by number. Where a formulation integrates from a start that nobody knows, each piece of
the record has free constants c of its own; they are never written out but removed by centring.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

import numpy as np

from equipoise.estimation.motion.fused_motion import LedMotion
from equipoise.maths.linalg import pack_symmetric, unpack_symmetric
from equipoise.model.arrays import Floats, Ints, Series1
from equipoise.model.estimate import BODY, COM, INERTIA
from equipoise.model.mass_properties import MassProperties
from equipoise.model.reasons.reason import Reason
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed


@dataclass(frozen=True, slots=True, eq=False)
class Rows:
    """The equations of a record."""

    t: Series1  # (n,) s
    A: Floats  # (n, m, c)
    b: Floats  # (n, m)
    names: tuple[str, ...]  # (c,) of the unknowns
    piece: Ints | None = None  # (n,) with free constants; None: there are none
    instruments: Floats | None = None  # (n, m, c) like A, of noise that is not A's
    omitted: Floats | None = None  # (n, m) of b: what is left out of the motion, as far as known
    notes: tuple[Reason, ...] = ()  # what of the record is not used


@dataclass(frozen=True, slots=True, eq=False)
class Posed:
    """What a formulation is given; J and com of the testbed are taken as known where it needs."""

    recording: Recording  # masses in the order of the testbed
    testbed: Testbed
    motion: LedMotion
    terms: tuple[str, ...] = ()  # torques


Formulation = Callable[[Posed], Rows]


def values_of(testbed: Testbed) -> dict[str, float]:
    """Return what the testbed says of the body, by name."""
    six = pack_symmetric(testbed.body.inertia_P)
    return dict(zip(BODY, map(float, (*six, *testbed.body.com)), strict=True))


def guess_of(rows: Rows, testbed: Testbed) -> Floats:
    """Return the testbed's values (c,) in the order of the unknowns; 0 for torques."""
    known = values_of(testbed)
    return np.array([known.get(name, 0.0) for name in rows.names])


def body_with(testbed: Testbed, found: Mapping[str, float]) -> MassProperties:
    """Return the body found; what is not among ``found`` is the testbed's."""
    known = values_of(testbed)
    six, com = (np.array([found.get(n, known[n]) for n in names]) for names in (INERTIA, COM))
    return MassProperties(testbed.body.mass, com, unpack_symmetric(six))


def held(rows: Rows, testbed: Testbed, names: tuple[str, ...]) -> Rows:
    """Return the rows with some unknowns at the testbed's value (torques: 0) on the other side."""
    known = guess_of(rows, testbed)
    keep = [k for k, name in enumerate(rows.names) if name not in names]
    gone = [k for k, name in enumerate(rows.names) if name in names]
    instruments = None if rows.instruments is None else rows.instruments[:, :, keep]
    return replace(
        rows,
        A=rows.A[:, :, keep],
        b=rows.b - rows.A[:, :, gone] @ known[gone],
        names=tuple(rows.names[k] for k in keep),
        instruments=instruments,
    )


def means(values: Floats, piece: Ints, weight: Floats) -> Floats:
    """Return the weighted mean of each piece, shape (pieces, ...)."""
    total = np.bincount(piece, weight)
    flat = (values * weight.reshape(-1, *[1] * (values.ndim - 1))).reshape(len(values), -1)
    sums = np.column_stack([np.bincount(piece, column) for column in flat.T])
    return (sums / np.maximum(total, 1e-300)[:, None]).reshape(-1, *values.shape[1:])


def centred(rows: Rows, weight: Floats | None = None) -> Rows:
    """Return the rows without the free constants of each piece: less the mean of the piece.

    With a weight (n,) of each time that is what weighted least squares make of the constants.
    """
    if rows.piece is None:
        return rows
    weight = np.ones(len(rows.t)) if weight is None else weight
    A = rows.A - means(rows.A, rows.piece, weight)[rows.piece]
    b = rows.b - means(rows.b, rows.piece, weight)[rows.piece]
    instruments = rows.instruments
    if instruments is not None:
        instruments = instruments - means(instruments, rows.piece, weight)[rows.piece]
    return replace(rows, A=A, b=b, piece=None, instruments=instruments)
