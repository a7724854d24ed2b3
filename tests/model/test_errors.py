"""Errors say the same in whatever process they are printed."""

import pickle

import pytest

from equipoise.model.errors import DriveRefused, InputError, MoveRefused

ERRORS = [
    InputError("here", "this", "that"),
    MoveRefused("x1", 0.0, 0.06, -0.05, 0.05),
    DriveRefused("wheel x", 2.0, 1.0, "N m"),
]


@pytest.mark.parametrize("error", ERRORS, ids=lambda error: type(error).__name__)
def test_an_error_comes_back_whole_from_another_process(error):
    again = pickle.loads(pickle.dumps(error))
    assert type(again) is type(error)
    assert str(again) == str(error)
    assert vars(again) == vars(error)
    assert vars(error)
