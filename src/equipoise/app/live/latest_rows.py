"""The newest that is known of each channel of a bench, and how it tilted of late."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from equipoise.maths.attitude import tilt
from equipoise.model.arrays import Vector3
from equipoise.model.recording import CHANNELS, Recording, Samples
from equipoise.model.units import DEG, MM

SPAN = 60  # s, chosen: so far back tilts are kept


@dataclass(frozen=True, slots=True, eq=False)
class Newest:
    """Never changed: another thread that draws it gets numbers that belong together."""

    time: float = 0.0  # s, of the newest row
    tilt: float | None = None  # rad
    rate: float | None = None  # rad/s, its magnitude as the gyro gave it
    masses: Mapping[str, float] = field(default_factory=dict[str, float])  # m
    counts: Mapping[str, int] = field(default_factory=dict[str, int])  # rows of each channel
    tilts: Mapping[int, float] = field(default_factory=dict[int, float])  # rad, most in each second


def after(known: Newest, rows: Recording, up: Vector3) -> Newest:
    """Return what is known after some rows; ``up`` is the body axis that should point up."""
    found = {name: _rows_of(rows, name) for name in CHANNELS}
    attitude, rate, masses = found["attitude"], found["rate"], found["masses"]
    if attitude is not None:
        late = attitude.t > attitude.t[-1] - SPAN
        angles = np.asarray(tilt(attitude.values[late], up))
        tilts = _most_by_second(known.tilts, attitude.t[late], angles)
        known = replace(known, tilt=float(angles[-1]), tilts=tilts)
    if rate is not None:
        known = replace(known, rate=float(np.linalg.norm(rate.values[-1])))
    if masses is not None:
        stand = dict(zip(rows.mass_names, map(float, masses.values[-1]), strict=True))
        known = replace(known, masses=stand)
    ends = [float(each.t[-1]) for each in (attitude, rate, masses) if each is not None]
    counts = {name: known.counts.get(name, 0) + len(new) for name, new in found.items() if new}
    return replace(known, time=max([known.time, *ends]), counts={**known.counts, **counts})


def time_of(known: Newest) -> str:
    """Return the time as a text."""
    return f"{known.time:9.2f} s"


def tilt_of(known: Newest) -> str:
    """Return the tilt as a text; nothing where it is not known."""
    return "" if known.tilt is None else f"tilt {known.tilt / DEG:6.2f} deg"


def masses_of(known: Newest) -> list[str]:
    """Return where each mass is as a text."""
    return [f"{name} {at / MM:7.2f} mm" for name, at in known.masses.items()]


def _rows_of(rows: Recording, name: str) -> Samples | None:
    channel: Samples | None = getattr(rows, name)
    return channel if channel is not None and len(channel) else None


def _most_by_second(
    kept: Mapping[int, float], t: "np.ndarray", angles: "np.ndarray"
) -> dict[int, float]:
    """Return the greatest angle of each second, of those that are not too old."""
    second = np.floor(t).astype(int)
    most = dict(kept)
    for s in map(int, np.unique(second)):
        most[s] = max(most.get(s, 0.0), float(angles[second == s].max()))
    return {s: most[s] for s in sorted(most) if s > second[-1] - SPAN}
