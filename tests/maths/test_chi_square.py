"""The chi-square distribution against tables, and against sums of squares."""

import math

import pytest

from equipoise.maths.chi_square import chi_square_chance, chi_square_limit

TABLE = [(1, 0.05, 3.8415), (3, 0.05, 7.8147), (3, 0.001, 16.2662), (30, 0.95, 18.4927)]


@pytest.mark.parametrize(("freedom", "chance", "limit"), TABLE)
def test_it_is_as_in_tables(freedom, chance, limit):
    assert chi_square_limit(freedom, chance) == pytest.approx(limit, abs=5e-5)
    assert chi_square_chance(freedom, limit) == pytest.approx(chance, rel=1e-4)


@pytest.mark.parametrize("value", [1e-6, 1.0, 20.0, 600.0])
def test_of_two_it_is_exponential(value):
    assert chi_square_chance(2, value) == pytest.approx(math.exp(-value / 2), rel=1e-12)
