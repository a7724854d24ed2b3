"""Shapes in annotations are checked while tests run, and only then."""

import numpy as np
import pytest
from jaxtyping import TypeCheckError

from equipoise.model.mass_properties import MassProperties, parallel_axis
from equipoise.model.recording import Samples


def test_wrong_length_is_caught():
    with pytest.raises(TypeCheckError):
        parallel_axis(1.0, np.zeros(4))


def test_wrong_number_type_is_caught():
    with pytest.raises(TypeCheckError):
        parallel_axis(1.0, np.array([1, 2, 3]))


def test_fields_of_records_are_checked():
    with pytest.raises(TypeCheckError):
        MassProperties(1.0, np.zeros(3), np.zeros((3, 2)))


def test_rows_of_a_channel_match_its_times():
    with pytest.raises(TypeCheckError):
        Samples(np.arange(3.0), np.zeros((4, 3)))
