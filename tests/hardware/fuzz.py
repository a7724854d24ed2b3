"""Drivers of sensors as fuzz targets: each takes any bytes, and raises nothing."""

from collections.abc import Callable

import numpy as np

from equipoise.hardware.emulated.registry import SENSORS
from equipoise.hardware.sensors.registry import DRIVERS
from equipoise.model.recording import Recording, Samples
from tests.hardware.sensor_units import unit


def heard(name: str) -> Callable[[bytes], None]:
    """Return a target: what a driver hears, at once and in two halves, and then what it says."""

    def target(content: bytes) -> None:
        driver = DRIVERS[name](unit(name))
        for half in (content, content[: len(content) // 2], content[len(content) // 2 :]):
            for reading in driver.feed(half):
                assert len(reading.values) == {"attitude": 4, "rate": 3}[reading.channel]
                assert np.all(np.isfinite(reading.values))
        driver.due(1.0)
        driver.feed(b"\n")
        driver.opened()
        driver.due(2.0)

    return target


def told(name: str) -> bytes:
    """Return three rows of each channel as a driver's far side tells them."""
    t = np.arange(3) * 0.025
    q = np.stack([np.cos(t), np.sin(t), 0 * t, 0 * t], axis=1)
    rows = Recording(Samples(t, q), Samples(t, np.stack([t, 1 - t, t / 7], axis=1)))
    far, driver = SENSORS[name](unit(name)), DRIVERS[name](unit(name))
    driver.opened()
    far.take(driver.due(0.0), 0.0)
    return b"".join(far.tell(rows))


PARSERS: list[tuple[str, Callable[[bytes], None]]] = [(name, heard(name)) for name in DRIVERS]
