"""Which series the page shows of a testbed, and in which units."""

from dataclasses import dataclass

from equipoise.app.text.numbers import SHOWN, TRAVEL, Unit
from equipoise.model.devices import Device
from equipoise.model.testbed import Testbed
from equipoise.model.units import MILLIJOULE, PERCENT

AXES = ("x", "y", "z")
SHARE = Unit("%", PERCENT)
ENERGY = Unit("mJ", MILLIJOULE)
ENERGIES = ("kinetic", "potential (gravity)", "total")


@dataclass(frozen=True, slots=True)
class Series:
    """One series; the first column of its rows is the time (s), the last ones are the sds."""

    name: str
    title: str
    columns: tuple[str, ...]
    si: str
    bench: Unit  # as people at a bench think
    sd: bool = False
    chart: bool = True
    line: float | None = None  # a value that is drawn across, SI

    @property
    def width(self) -> int:
        """Return the number of columns of a row, time included."""
        return 1 + len(self.columns) * (2 if self.sd else 1)

    def document(self) -> dict[str, object]:
        """Return it for the page."""
        unit = {"bench": [self.bench.name, self.bench.size], "si": [self.si, 1.0]}
        return {"name": self.name, "title": self.title, "columns": list(self.columns),
                "sd": self.sd, "unit": unit, "chart": self.chart, "line": self.line}  # fmt: skip


def drawn_devices(testbed: Testbed) -> dict[str, tuple[Device, ...]]:
    """Return the devices whose reports are drawn, by the series that has them."""
    return {"wheels": testbed.wheels, "gimbals": testbed.cmgs}


def series_of(testbed: Testbed) -> list[Series]:
    """Return the series of a testbed, in the order of the charts."""
    limits = ("tilt",) if testbed.hardware is None else ("tilt", "rate")
    found = [
        Series("pose", "Attitude quaternion", ("w", "x", "y", "z"), "", Unit("", 1.0), chart=False),
        Series("com", "Centre of mass", AXES, "m", SHOWN["m"], sd=True),
        Series("attitude", "Attitude", ("roll", "pitch", "yaw"), "rad", SHOWN["rad"], sd=True),
        Series("rate", "Rate", AXES, "rad/s", SHOWN["rad/s"], sd=True),
        Series("torque", "Residual torque", AXES, "N m", SHOWN["N m"], sd=True),
        Series("energy", "Energy", ENERGIES, "J", ENERGY, sd=True),
        Series("masses", "Masses", testbed.mass_names, "m", TRAVEL),
        Series("limits", "Interlocks, share of limit", limits, "-", SHARE, line=1.0),
    ]
    units = {"wheels": ("rad/s", Unit("rad/s", 1.0)), "gimbals": ("rad", SHOWN["rad"])}
    for name, devices in drawn_devices(testbed).items():
        columns = tuple(device.name for device in devices)
        found.insert(-1, Series(name, name.capitalize(), columns, *units[name]))
    return [one for one in found if one.columns]
