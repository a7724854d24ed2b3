"""The magnetic field at the simulated bench: a background, and a cage that is driven.

    B_N(t) = background + sum gain_i y_i(t) axis_i     y: as driven, behind its lag;  T, laboratory

at the coils on the platform; at its magnetometer the field of each pair is greater by a share, its
deviation within the working volume. Gain, axis and background are those that there really are.
"""

from typing import NamedTuple

import numpy as np

from equipoise.model.arrays import Floats, Series1, Series3, Vector3
from equipoise.model.defects import TrueCoilPair
from equipoise.model.devices import CoilPair
from equipoise.model.testbed import Testbed
from equipoise.simulation.followers import Followers, followed


class TrueField(NamedTuple):
    """What the field is made of."""

    background: Vector3  # T, laboratory
    gives: Floats  # (k, 3) of the field for each T that a pair is driven by
    deviation: Floats  # (k,) relative, at the magnetometer


def draw_field(testbed: Testbed, rng: np.random.Generator) -> TrueField | None:
    """Return the field of a testbed's truth, with deviations drawn; None where none is known."""
    if testbed.field_N() is None:
        return None
    truth, known = testbed.truth, testbed.magnetic_field
    background = np.zeros(3) if known is None else known.field_N
    if truth is not None and truth.field_N is not None:
        background = truth.field_N
    true = {} if truth is None else {pair.name: pair for pair in truth.cage}
    drawn = rng.uniform(-1.0, 1.0, len(testbed.coil_pairs))
    pairs = [(pair, true.get(pair.name, TrueCoilPair(pair.name))) for pair in testbed.coil_pairs]
    gives = [_gives(stated, real) for stated, real in pairs]
    found = [share * stated.nonuniformity if real.deviation is None else real.deviation
             for share, (stated, real) in zip(drawn, pairs, strict=True)]  # fmt: skip
    return TrueField(background, np.array(gives).reshape(-1, 3), np.array(found))


def _gives(stated: CoilPair, real: TrueCoilPair) -> Vector3:
    return real.gain * (stated.axis_N if real.axis_N is None else real.axis_N)


def field_at(field: TrueField, testbed: Testbed, devices: Followers, t: Series1) -> Series3:
    """Return the field (n, 3) T at the coils on the platform at times (s), laboratory axes."""
    y, _ = followed(devices, t)
    total: Series3 = field.background + y[:, testbed.columns(CoilPair)] @ field.gives
    return total


def measured_field(field: TrueField, testbed: Testbed, devices: Followers, t: Series1) -> Series3:
    """Return the same at the magnetometer."""
    elsewhere = field._replace(gives=field.gives * (1.0 + field.deviation[:, None]))
    return field_at(elsewhere, testbed, devices, t)
