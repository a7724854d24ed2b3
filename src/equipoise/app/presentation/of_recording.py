"""A recording: its channels, and how many rows each has."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from equipoise.app.presentation.tables import Arrays, Table, Variable
from equipoise.app.text.blocks import Blocks, Column, items, number, prose
from equipoise.app.text.blocks import table as text_table
from equipoise.app.text.json_lists import CHANNELS as DOCUMENT
from equipoise.app.text.json_shape import View
from equipoise.model.arrays import Floats
from equipoise.model.recording import CHANNELS, Recording, Samples, column_names

if TYPE_CHECKING:
    from matplotlib.figure import Figure

AXES = ("x", "y", "z")
SHOWN = 12  # columns of a channel that a line names; chosen
UNITS = {
    "rate": "rad/s",
    "masses": "m",
    "momentum": "N m s",
    "torque": "N m",
    "field": "T",
    "temperature": "degC",
    "accelerometer": "m/s2",
    "position": "m",
    "torque_by_cause": "N m",
}
PARTS = {
    "attitude": ("w", "x", "y", "z"),
    "rate": AXES,
    "momentum": AXES,
    "torque": AXES,
    "field": AXES,
    "temperature": ("air",),
    "lamp": ("power",),
    "accelerometer": AXES,
    "sun": AXES,
    "position": ("x", "y"),
}
OF_DEVICES = {"wheel": "rad/s", "gimbal": "rad", "dipole": "A m2", "cage": "T", "jet": "N m"}


def channels(recording: Recording) -> dict[str, Samples]:
    """Return the channels that have rows, by name."""
    every: dict[str, Samples | None] = {name: getattr(recording, name) for name in CHANNELS}
    return {name: rows for name, rows in every.items() if rows is not None and len(rows)}


def parts(recording: Recording, channel: str) -> tuple[str, ...]:
    """Return what the columns of a channel are called."""
    return PARTS[channel] if channel in PARTS else column_names(recording, channel)


def _listed(names: tuple[str, ...]) -> str:
    """Return names for a line of text, without those that do not fit."""
    more = f" and {len(names) - SHOWN} more" if len(names) > SHOWN else ""
    return ", ".join(names[:SHOWN]) + more


def lines(recording: Recording) -> Iterator[str]:
    """Yield source and span, and a line a channel."""
    found = channels(recording)
    yield f"Recording of {recording.source or 'no file'}: {_span(recording)}"
    for name, rows in found.items():
        pace = f", one in {rows.period:.3g} s" if len(rows) > 1 else ""
        names = _listed(parts(recording, name))
        yield f"  {name:11s} {len(rows)} rows of {names}{pace}"


def _span(recording: Recording) -> str:
    """Return from when to when there are sensor rows."""
    if not any(name in channels(recording) for name in ("attitude", "rate")):
        return "no sensor rows"
    first, last = recording.span
    return f"{first:.4g} to {last:.6g} s"


def blocks(recording: Recording) -> Blocks:
    """Return a row a channel, and what reading the file corrected."""
    rows = (
        (name, _listed(parts(recording, name)), str(len(c)), f"{c.t[0]:.4g}", f"{c.t[-1]:.6g}")
        for name, c in channels(recording).items()
    )
    columns = Column("channel"), prose("of"), number("rows"), number("from", "s"), number("to", "s")
    return (text_table("Channels", columns, rows), *items(recording.notes))


def document(recording: Recording) -> View:
    """Return every row of every channel, SI."""
    return DOCUMENT.write({
        "source": recording.source,
        "sha256": recording.sha256,
        "notes": recording.notes,
        "channels": {
            name: {"columns": parts(recording, name), "rows": rows}
            for name, rows in channels(recording).items()
        },
    })  # fmt: skip


def table(recording: Recording) -> Table:
    """Return one row a time at which any channel has one; nan where a channel has none."""
    found = channels(recording)
    t: Floats = np.unique(np.concatenate([rows.t for rows in found.values()] or [np.zeros(0)]))
    columns: dict[str, Floats] = {"time_s": t}
    for name, rows in found.items():
        values = np.full((len(t), rows.values.shape[1]), np.nan)
        values[np.searchsorted(t, rows.t)] = rows.values
        heads = (_head(name, part) for part in parts(recording, name))
        columns |= dict(zip(heads, values.T, strict=True))
    return columns


def _head(channel: str, part: str) -> str:
    """Return a column's name, with its unit."""
    unit = OF_DEVICES[part.split(":")[0]] if channel == "devices" else UNITS.get(channel, "")
    name = part if channel == "devices" else f"{channel}_{part}"
    return f"{name}_{unit.replace('/', '_').replace(' ', '_')}" if unit else name


def arrays(recording: Recording) -> Arrays:
    """Return each channel along its own times."""
    variables, coordinates = dict[str, Variable](), dict[str, Variable]()
    for name, rows in channels(recording).items():
        time, part = f"time_{name}", f"{name}_part"
        variables[name] = Variable((time, part), rows.values, UNITS.get(name, ""))
        coordinates[time] = Variable((time,), rows.t, "s")
        coordinates[part] = Variable((part,), list(parts(recording, name)))
    of = {"source": recording.source, "sha256": recording.sha256}
    return Arrays(variables, coordinates, of)


def figure(recording: Recording) -> "Figure | None":
    """Return the page that `equipoise inspect --figure` draws, without findings."""
    from equipoise.app.figures.recording import record

    shown = channels(recording)
    return record.draw(recording) if "attitude" in shown or "rate" in shown else None
