"""The sensor whose bytes were saved: of a testbed, or as stated on the command line."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from equipoise.hardware.sensors.columns import ANGLES, QUATERNION, RATES
from equipoise.hardware.sensors.line_protocol import declared
from equipoise.model.errors import InputError, nearest
from equipoise.model.hardware import Gives, Laboratory, Port, SensorUnit, Setting
from equipoise.model.testbed import Testbed

LABORATORIES: dict[str, Laboratory] = {  # of each driver whose bytes can be saved; as is usual
    "vectornav": "ned",
    "mavlink": "ned",
    "natnet": "y_up",
    "lines": "z_up",
}
TURNS: dict[str, Laboratory] = {"z_up": "z_up", "ned": "ned", "y_up": "y_up"}
STREAM = "serial:file"  # a port that is never opened


@dataclass(frozen=True, slots=True)
class Stated:
    """What is stated of a sensor on the command line; it goes before a testbed."""

    laboratory: str | None = None
    settings: Mapping[str, Setting] = field(default_factory=dict[str, Setting])


def unit_of(driver: str, testbed: Testbed | None, stated: Stated) -> SensorUnit:
    """Return the sensor of a testbed that has this driver, or one in the body's axes."""
    if driver not in LABORATORIES:
        raise InputError("--as", f"'{driver}'", nearest(driver, list(LABORATORIES)))
    found = _of_testbed(driver, testbed) if testbed is not None else _plain(driver, stated.settings)
    laboratory = found.laboratory
    if stated.laboratory is not None:
        if stated.laboratory not in TURNS:
            wanted = nearest(stated.laboratory, list(TURNS))
            raise InputError("--laboratory", f"'{stated.laboratory}'", wanted)
        laboratory = TURNS[stated.laboratory]
    return replace(found, laboratory=laboratory, settings={**found.settings, **stated.settings})


def _of_testbed(driver: str, testbed: Testbed) -> SensorUnit:
    sensors = () if testbed.hardware is None else testbed.hardware.sensors
    found = [unit for unit in sensors if unit.driver == driver]
    if len(found) != 1:
        names = " and ".join(unit.name for unit in found) or "none"
        wanted = f'one [[hardware.sensor]] with driver = "{driver}"'
        raise InputError(testbed.source or testbed.name, names, wanted)
    return found[0]


def _plain(driver: str, settings: Mapping[str, Setting]) -> SensorUnit:
    """Return a sensor in the body's axes that gives all that its driver can."""
    gives: tuple[Gives, ...] = ("attitude",) if driver == "natnet" else ("attitude", "rate")
    columns = settings.get("columns", ())
    listed = columns if isinstance(columns, tuple) else ()
    names = {declared(name)[0] for name in listed if isinstance(name, str)}
    if driver == "lines":
        sets: dict[Gives, tuple[tuple[str, ...], ...]] = {
            "attitude": (QUATERNION, ANGLES),
            "rate": tuple(RATES),
        }
        gives = tuple(c for c, all_of in sets.items() if any(names & set(each) for each in all_of))
    if not gives:
        wanted = "names of attitude or rate, such as t_ms,qw,qx,qy,qz"
        raise InputError("--columns", " ".join(sorted(names)) or "nothing", wanted)
    return SensorUnit(driver, driver, Port(STREAM), gives, np.eye(3), LABORATORIES[driver])
