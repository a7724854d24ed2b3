"""A testbed with camera and gyro."""

import pytest

from equipoise.io.testbed.presets import read_preset


@pytest.fixture(scope="session")
def nanosat():
    return read_preset("nanosat")
