"""The magnetic field of a law's sample, by hand."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.estimation.motion.attitude_filter import first_state
from equipoise.io.testbed.presets import read_preset
from equipoise.model.devices import CoilPair
from equipoise.model.recording import Recording, Samples
from equipoise.procedure.steps.sampler import field_of, opened

QUARTER = np.array([np.cos(np.pi / 4), 0.0, 0.0, np.sin(np.pi / 4)])  # about z, body to laboratory


@pytest.fixture(scope="module")
def bed():
    """The reference table, jets and all, between coils along x."""
    pair = CoilPair("cx", np.eye(3)[0], 2e-4)
    return replace(read_preset("reference-table"), magnetic_field=None, coil_pairs=(pair,))


def test_what_the_coils_report_is_turned_into_body_axes(bed):
    """Turned by 90 deg about z, x of the laboratory points along -y of the body."""
    states = opened(bed).states.copy()
    states[bed.device_names.index("cage:cx")] = 80e-6
    found = field_of(first_state(0.0, QUARTER, bed), Recording(), bed, states)
    np.testing.assert_allclose(found, [0.0, -80e-6, 0.0], atol=1e-18)


def test_a_magnetometer_is_in_body_axes_already(bed):
    rows = Samples(np.arange(2.0), np.array([[1e-5, 0.0, 0.0], [3e-5, 0.0, 2e-5]]))
    found = field_of(first_state(0.0, QUARTER, bed), Recording(field=rows), bed, np.zeros(9))
    np.testing.assert_allclose(found, [2e-5, 0.0, 1e-5])


def test_without_an_attitude_nothing_is_known(bed):
    assert field_of(None, Recording(), bed, opened(bed).states) is None
