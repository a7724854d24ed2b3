import pytest

from equipoise.model.errors import InputError
from equipoise.model.torque_terms import GROUPS, TERMS, among, expand, unit_of


def test_group_expands_to_its_terms():
    assert expand(("viscous",)) == ("viscous_x", "viscous_y", "viscous_z")


def test_order_is_the_packages_not_the_askers():
    assert expand(("swirl", "constant_y", "viscous_z")) == ("viscous_z", "constant_y", "swirl")


def test_duplicate_terms_expand_once():
    assert expand(("swirl", "swirl")) == ("swirl",)
    assert expand(("sag", "sag_xx")) == GROUPS["sag"]


def test_no_terms_expand_to_none():
    assert expand(()) == ()


def test_terms_are_picked_from_names_of_any_kind():
    """No group is a term but one that has its name; what a sensor may have wrong is no torque."""
    names = ("swirl", "gyro_xx", "sag_xz", "viscous", "viscous_y", "swirl")
    assert among(names) == ("viscous_y", "swirl", "sag_xz")


def test_all_groups_are_all_terms():
    assert expand(tuple(GROUPS)) == TERMS


def test_misspelt_term_names_the_nearest_and_the_place():
    with pytest.raises(InputError, match=r"did you mean 'viscous'\?$") as caught:
        expand(("viscos",), where="my.toml: [disturbance] consider")
    assert str(caught.value).startswith("my.toml: [disturbance] consider: found 'viscos'; ")


def test_unknown_term_lists_what_there_is():
    with pytest.raises(InputError, match=r"'magnetism'; wanted one of viscous, quadratic, .*"):
        expand(("magnetism",))


@pytest.mark.parametrize("term", TERMS)
def test_every_term_has_a_unit(term):
    assert unit_of(term)


def test_units_by_hand():
    assert unit_of("viscous_y") == "N m s"
    assert unit_of("sag_xz") == "m"
    assert unit_of("drift_z") == "m/s"
