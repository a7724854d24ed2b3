"""Lee et al.'s slews, whole: `verification/lee.py` with few seeds."""

from verification import lee


def test_lee_is_reproduced():
    assert lee.measure(range(1)).missed == ()
