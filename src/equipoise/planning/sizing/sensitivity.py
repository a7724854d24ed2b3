"""What limits the result, and the result if one thing were better.

Each change makes one thing half as bad, or adds one that is missing, and the whole budget is
computed anew, with the measurement. Half is chosen so that changes compare; their cost is for the
reader to judge. Where one change is not enough, they are combined (``combined_changes``).
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from equipoise.actuators.mass_allocation import rails_of
from equipoise.model.testbed import AttitudeSensor, Gyro, SlidingMass
from equipoise.model.vector_sensors import Accelerometer, Magnetometer, SunSensor
from equipoise.planning.sizing.budget import Budget
from equipoise.planning.sizing.case import Case

VectorSensor = Accelerometer | SunSensor | Magnetometer
Sensor = AttitudeSensor | Gyro | VectorSensor

HALF = 0.5
LIGHTER = 60.0  # chosen: a fine mass is 1 g beside 60 g, and makes up for stops of 0.3 mm
MASS_LENGTHS = {"steps": "resolution", "stops": "accuracy", "backlash": "backlash"}  # by line
BETTER_MASSES = {"steps": "steps half as long", "stops": "masses with half the positioning error",
                 "backlash": "half the backlash"}  # fmt: skip
VECTOR_SENSORS = {"accelerometer": "accelerometer", "sun": "sun sensor",
                  "magnetometer": "magnetometer"}  # fmt: skip
GYRO = Gyro(100.0, np.radians(0.05), np.radians(0.1))  # chosen: 0.005 deg/s/rtHz, a good MEMS gyro


class Change(NamedTuple):
    """One thing that can be made better."""

    name: str
    line: str  # of the budget, that is mended by it
    case: Case


@dataclass(frozen=True, slots=True, eq=False)
class Bettered:
    """A change and the result with it."""

    name: str
    line: str
    torque: float  # N m rms
    within: float  # share of the platforms within reach


def with_masses(case: Case, masses: Iterable[SlidingMass]) -> Case:
    """Return the case with other masses."""
    return replace(case, testbed=replace(case.testbed, masses=tuple(masses)))


def with_half(case: Case, length: str) -> Case:
    """Return the case with half of one length of every mass."""
    masses = case.testbed.masses
    return with_masses(case, (replace(m, **{length: HALF * getattr(m, length)}) for m in masses))


def mass_changes(case: Case) -> Iterator[Change]:
    """Yield better masses and rails."""
    for line, length in MASS_LENGTHS.items():
        if any(getattr(mass, length) > 0 for mass in case.testbed.masses):
            yield Change(BETTER_MASSES[line], line, with_half(case, length))
    if case.rail_lean > 0:
        yield Change("rails twice as true", "rails", replace(case, rail_lean=HALF * case.rail_lean))
    longer = [replace(m, travel=(2 * m.travel[0], 2 * m.travel[1])) for m in case.testbed.masses]
    yield Change("twice the travel", "out of reach", with_masses(case, longer))
    fine = f"a mass {LIGHTER:g} times lighter beside each of the finest"
    yield Change(fine, "stops", with_fine_masses(case))
    yield Change("one move more", "stops", replace(case, moves=case.moves + 1))


def with_fine_masses(case: Case) -> Case:
    """Return the case with a light mass beside each of the finest, on a rail like its own."""
    masses = case.testbed.masses
    tiers = rails_of(masses, case.testbed.body.mass).tier
    finest = [mass for mass, tier in zip(masses, tiers, strict=True) if tier == 0]
    light = (replace(m, name=f"fine_{m.name}", mass=m.mass / LIGHTER) for m in finest)
    return with_masses(case, (*masses, *light))


def sensor_changes(case: Case) -> Iterator[Change]:
    """Yield better sensors, and more time for them."""
    testbed = case.testbed
    camera, gyro = testbed.attitude, testbed.gyro

    def observed_by(**sensors: Sensor) -> Case:
        return replace(case, testbed=replace(testbed, **sensors))

    if camera is not None:
        sharper = replace(camera, noise=HALF * camera.noise)
        yield Change("half the camera's noise", "measurement", observed_by(attitude=sharper))
        if camera.plumb_sd > 0:
            plumb = replace(camera, plumb_sd=HALF * camera.plumb_sd)
            yield Change(
                "a camera with half the levelling error", "measurement", observed_by(attitude=plumb)
            )
    if gyro is None:
        yield Change("a good MEMS gyro", "measurement", observed_by(gyro=GYRO))
    else:
        quieter = replace(gyro, noise=HALF * gyro.noise)
        yield Change("half the gyro's noise", "measurement", observed_by(gyro=quieter))
    for name, called in VECTOR_SENSORS.items():
        sensor: VectorSensor | None = getattr(testbed, name)
        if sensor is not None:
            finer = replace(sensor, noise=HALF * sensor.noise)
            yield Change(f"half the {called}'s noise", "measurement", observed_by(**{name: finer}))
    yield Change(
        "records twice as long",
        "measurement",
        replace(case, measurement_time=2 * case.measurement_time),
    )


def surrounding_changes(case: Case) -> Iterator[Change]:
    """Yield better surroundings, of what is stated."""
    around = case.around
    better = (
        ("half the temperature variation", "warmth", {"temperature": HALF * around.temperature}),
        ("a deck that swings twice as fast", "sag", {"bending": 2 * around.bending}),
        (
            "a bearing with half the form error",
            "sphericity",
            {"form_error": HALF * around.form_error},
        ),
        ("air twice as steady", "buoyancy", {"air_change": HALF * around.air_change}),
        ("half the air's torque", "air", {"air": HALF * around.air}),
    )
    for name, line, changed in better:
        if all(changed.values()):
            yield Change(name, line, replace(case, around=replace(around, **changed)))


def changes(case: Case) -> Iterator[Change]:
    """Yield all that can be better."""
    yield from mass_changes(case)
    yield from sensor_changes(case)
    yield from surrounding_changes(case)


def what_to_buy(all_: Iterable[Change], budgets: Iterable[Budget]) -> tuple[Bettered, ...]:
    """Return changes by their budgets, the one that leaves least first.

    Of equals the one with more reach comes first.
    """
    found = [
        Bettered(change.name, change.line, budget.torque, budget.within)
        for change, budget in zip(all_, budgets, strict=True)
    ]
    return tuple(sorted(found, key=lambda b: (b.torque, -b.within)))
