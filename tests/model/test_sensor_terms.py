import pytest

from equipoise.model.sensor_terms import TERMS, among, unit_of


def test_terms_are_picked_from_names_of_any_kind():
    """In the package's order, each once; a torque is nothing that a sensor has wrong."""
    names = ("gyro_yx", "swirl", "camera_delay", "plumb", "plumb_y", "gyro_yx")
    assert among(names) == ("plumb_y", "camera_delay", "gyro_yx")


@pytest.mark.parametrize("term", TERMS)
def test_every_term_has_a_unit(term):
    assert unit_of(term)


def test_units_by_hand():
    assert unit_of("heading3_cos_x") == "rad"
    assert unit_of("camera_delay") == "s"
    assert unit_of("gyro_zy") == "1"
