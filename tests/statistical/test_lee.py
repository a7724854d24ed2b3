"""Lee et al.'s slews, whole: `verification/lee.py` with few seeds.

`make test` has shorter ones, in the tests of `reproduce` and of `study/papers`.
"""

from tests.support import thorough
from verification import lee


@thorough.whole
def test_lee_is_reproduced():
    assert lee.measure(range(1)).missed == ()
