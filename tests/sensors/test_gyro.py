"""What a gyro triad says of a rate: the entries of its matrix, one by one."""

import numpy as np
import pytest

from equipoise.dynamics.sensitivities import dot
from equipoise.model.sensor_terms import TERMS
from equipoise.sensors.camera import CLOCK, GYRO, N_SENSOR
from equipoise.sensors.gyro import entry, gyro_matrix


def test_entries_by_hand():
    """Scales on the diagonal, misalignments beside it, in the order xy xz yx yz zx zy."""
    sensor = np.zeros(N_SENSOR)
    sensor[GYRO:CLOCK] = np.arange(1, 10) / 100
    expected = [[1.01, 0.04, 0.05], [0.06, 1.02, 0.07], [0.08, 0.09, 1.03]]
    np.testing.assert_allclose(np.reshape(gyro_matrix(sensor), (3, 3)), expected, atol=1e-15)


def test_a_misaligned_axis_measures_another_axis_rate():
    """gyro_xy = 0.02: a rate about y is measured about x, not the other way round."""
    sensor = 0.02 * (np.array(TERMS) == "gyro_xy")
    said = dot(gyro_matrix(sensor), (0.0, 3.0, 0.0))
    np.testing.assert_allclose(said, [0.06, 3, 0], atol=1e-15)
    np.testing.assert_allclose(dot(gyro_matrix(sensor), (3.0, 0.0, 0.0)), [3, 0, 0], atol=1e-15)


@pytest.mark.parametrize("term", range(GYRO, CLOCK), ids=TERMS[GYRO:CLOCK])
def test_each_coefficient_is_the_entry_of_its_name(term):
    """By its name, by the matrix, and by where ``entry`` says that it is."""
    row, other = ("xyz".index(letter) for letter in TERMS[term][-2:])
    assert entry(term) == (row, other)
    sensor = 1.0 * (np.arange(N_SENSOR) == term)
    expected = np.outer(np.eye(3)[row], np.eye(3)[other])
    found = np.reshape(gyro_matrix(sensor), (3, 3)) - np.eye(3)
    np.testing.assert_array_equal(found, expected)


@pytest.mark.parametrize("term", range(GYRO))
def test_the_camera_has_no_entry(term):
    """Plumb, harmonics and delay are not the gyro's."""
    assert entry(term)[0] < 0
