"""A magnetometer in a cage: which field its rows show, how surely, and when they show none."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.actuators.stored_momentum import changes_field
from equipoise.estimation.motion.observed_vectors import observed
from equipoise.model.devices import CoilPair, MagneticField
from equipoise.model.recording import Recording, Samples
from equipoise.model.vector_sensors import Magnetometer
from tests.support.builders import platform

X, Y, Z = np.eye(3)
PAIRS = (CoilPair("x", X, 1e-4, 50e-6), CoilPair("z", Z, 1e-4))
T = np.arange(101.0)


def caged(pairs=PAIRS):
    background = MagneticField(np.array([0.0, 0.0, -40e-6]))
    return replace(platform(), coil_pairs=pairs, magnetic_field=background,
                   magnetometer=Magnetometer(1.0, 1e-7, 0.0))  # fmt: skip


def logged(x, z=0.0):
    """A record of the cage's fields, and of a magnetometer whose numbers do not matter here."""
    fields = np.column_stack([np.broadcast_to(x, T.shape), np.broadcast_to(z, T.shape)])
    field = Samples(T[:100], np.zeros((100, 3)))
    names = ("cage:x", "cage:z")
    return Recording(device_names=names, devices=Samples(T, fields), field=field)


def test_it_sees_what_the_cage_reports():
    """30 uT along x and 10 - 40 along z, not the 50 uT of the start."""
    ((sensor, rows),) = observed(logged(30e-6, 10e-6), caged())
    np.testing.assert_allclose(sensor.vector_N, [30e-6, 0.0, -30e-6], rtol=1e-12)
    assert sensor.noise == 1e-7
    assert len(rows) == 100


def test_without_a_report_it_is_as_at_the_start():
    record = replace(logged(0.0), devices=None, device_names=())
    ((sensor, _),) = observed(record, caged())
    np.testing.assert_allclose(sensor.vector_N, [50e-6, 0.0, -40e-6], rtol=1e-12)


def test_what_the_cage_is_off_by_is_common_to_all_rows():
    """30 uT, 2 % of gain, 0.01 rad each way across, 3 % uniform: of a mean of 100 rows, too."""
    pairs = (replace(PAIRS[0], gain_sd=0.02, mounting_sd=0.01, nonuniformity=0.03), PAIRS[1])
    ((sensor, _),) = observed(logged(30e-6), caged(pairs))
    share = np.sqrt((0.02**2 + 2 * 0.01**2 + 0.03**2 / 3) / 3)
    assert sensor.noise == pytest.approx(np.hypot(1e-7, 10 * 30e-6 * share), rel=1e-12)


def test_a_field_that_changes_shows_no_attitude():
    ramp = np.linspace(30e-6, 31e-6, len(T))
    assert changes_field(logged(ramp), caged())
    assert not observed(logged(ramp), caged())
    assert not changes_field(logged(30e-6), caged())
    assert not changes_field(logged(30e-6 * (1 + 1e-5 * np.sin(T))), caged())
