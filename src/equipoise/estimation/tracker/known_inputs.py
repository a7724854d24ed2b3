"""What is known of a platform's inputs from one call of the tracker to the next.

Masses, stored momentum, known torque, temperature and lamp are straight lines between their rows,
constant outside them. A record that is read in parts has no row at its beginning: the last rows of
the part before belong to it.
"""

from dataclasses import replace

import numpy as np

from equipoise.dynamics.timeline import straight_lines
from equipoise.model.recording import Recording, Samples, join

LINES = ("masses", "momentum", "torque")
BEFORE = 2  # rows kept up to a time: the last, and the one before, which shows a mass that stops


def inputs_of(before: Recording | None, recording: Recording) -> Recording:
    """Return the inputs of a record, the rows before it included."""
    known = {name: getattr(recording, name) for name in (*LINES, "temperature", "lamp")}
    fresh = Recording(mass_names=recording.mass_names, **known)
    return fresh if before is None else join(before, fresh)


def with_inputs(recording: Recording, inputs: Recording) -> Recording:
    """Return the record with these rows of masses, momentum and torque."""
    return replace(recording, mass_names=inputs.mass_names,
                   **{name: getattr(inputs, name) for name in LINES})  # fmt: skip


def inputs_kept(inputs: Recording, since: float) -> Recording:
    """Return the rows that a record from ``since`` (s) on needs; of a lamp, all switches.

    The temperature at that moment is the one that was taken for it: what comes later does not
    change how warm it was.
    """
    lines = {name: _recent(getattr(inputs, name), since) for name in LINES}
    temperature, lamp = inputs.temperature, inputs.lamp
    if temperature is not None and len(temperature):
        first = straight_lines(temperature, np.array([since]), 1)
        later = temperature.where(temperature.t > since)
        temperature = Samples(np.append(since, later.t), np.vstack([first, later.values]))
    if lamp is not None and len(lamp):
        changes = np.diff(lamp.values[:, 0], prepend=np.nan) != 0
        lamp = lamp.where(changes | (lamp.t == lamp.t[-1]))
    return replace(inputs, temperature=temperature, lamp=lamp, **lines)


def _recent(rows: Samples | None, since: float) -> Samples | None:
    if rows is None:
        return None
    first = max(int(np.searchsorted(rows.t, since, side="right")) - BEFORE, 0)
    return rows.where(slice(first, None))
