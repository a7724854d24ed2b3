"""A testbed: what is stated of platform, masses, sensors and devices."""

import tomllib
from collections.abc import Iterator

from equipoise.app.presentation import of_mass_properties
from equipoise.app.presentation.tables import Table
from equipoise.app.text.blocks import Blocks
from equipoise.app.text.json_shape import View
from equipoise.io.testbed.testbed_file import text_of_testbed
from equipoise.model.testbed import Testbed

SCHEMA = "equipoise/testbed/1"


def lines(bed: Testbed) -> Iterator[str]:
    """Yield name, body, masses and sensors."""
    yield f"Testbed {bed.name}, {bed.source or 'no file'}"
    yield from list(of_mass_properties.lines(bed.body))[1:]
    yield f"  masses     {', '.join(bed.mass_names) or 'none'}"
    sensors = {"attitude": bed.attitude, "gyro": bed.gyro, "accelerometer": bed.accelerometer,
               "sun": bed.sun, "magnetometer": bed.magnetometer,
               "position": bed.position}  # fmt: skip
    there = [f"{name} {each.rate:g} Hz" for name, each in sensors.items() if each is not None]
    yield f"  sensors    {', '.join(there) or 'none'}"
    if bed.devices:
        yield f"  devices    {', '.join(bed.device_names)}"


def blocks(bed: Testbed) -> Blocks:
    """Return the body and the masses."""
    from equipoise.app.report.build import masses_table

    return (*of_mass_properties.blocks(bed.body), masses_table("Sliding masses", bed.masses))


def document(bed: Testbed) -> View:
    """Return what a testbed file says, with the units in its keys."""
    return {"schema": SCHEMA, **tomllib.loads(text_of_testbed(bed))}


def table(bed: Testbed) -> Table:
    """Return a row a sliding mass."""
    masses = bed.masses
    return {
        "mass": [mass.name for mass in masses],
        "mass_kg": [mass.mass for mass in masses],
        **{f"home_{axis}_m": [float(m.home[k]) for m in masses] for k, axis in enumerate("xyz")},
        **{f"axis_{axis}": [float(m.axis[k]) for m in masses] for k, axis in enumerate("xyz")},
        "travel_low_m": [mass.travel[0] for mass in masses],
        "travel_high_m": [mass.travel[1] for mass in masses],
        "resolution_m": [mass.resolution for mass in masses],
        "accuracy_m": [mass.accuracy for mass in masses],
    }
