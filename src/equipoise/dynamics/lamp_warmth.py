"""The warmth that a lamp brings, from its switch alone.

What it shines on follows its power u, held from row to row, with one time constant:

    tau dT/dt = warms u - T

which is solved exactly from node to node. Before the first row it is settled, as that row has it.

Cannot tell what it warms from how much the centre of mass moves by it: the product of ``warms`` and
the coefficients is found (``model.torque_terms``, thermal), however wrong the former.
"""

import numpy as np

from equipoise.model.devices import Lamp
from equipoise.model.recording import Recording, Samples
from equipoise.model.testbed import Testbed

FINE, MOST = 50, 10_000  # chosen: nodes in a time constant, where straight lines err by 5e-5
# of the end; and nodes of a record


def lamp_warmth(power: Samples, lamp: Lamp, end: float) -> Samples:
    """Return by how much (K) a lamp has warmed what it shines on, until ``end`` (s)."""
    start = float(power.t[0])
    end = max(end, float(power.t[-1]))
    nodes = int(np.clip(np.ceil(FINE * (end - start) / lamp.time_constant), 2, MOST))
    t = np.union1d(power.t, np.linspace(start, end, nodes))
    u = power.values[np.searchsorted(power.t, t, side="right") - 1, 0]
    share = -np.expm1(-np.diff(t) / lamp.time_constant)
    warm = [float(u[0])]
    for aim, part in zip(u[:-1].tolist(), share.tolist(), strict=True):
        warm.append(warm[-1] + part * (aim - warm[-1]))
    return Samples(t, lamp.warms * np.array(warm)[:, None])


def by_lamp(recording: Recording, testbed: Testbed) -> bool:
    """Say whether the switch of a lamp is all that says how warm it was."""
    power = recording.lamp
    is_logged = power is not None and len(power) > 0
    return testbed.lamp is not None and recording.temperature is None and is_logged


def temperature_until(recording: Recording, testbed: Testbed, end: float) -> Samples | None:
    """Return the temperature (degC, or K above the air's) as recorded, or as the lamp had it.

    That by the lamp reaches to ``end`` (s).
    """
    if not by_lamp(recording, testbed):
        return recording.temperature
    assert recording.lamp is not None
    assert testbed.lamp is not None
    return lamp_warmth(recording.lamp, testbed.lamp, end)


def temperature_of(recording: Recording, testbed: Testbed) -> Samples | None:
    """Return the same until the last row of any sensor of the motion."""
    end = recording.span[1] if by_lamp(recording, testbed) else 0.0
    return temperature_until(recording, testbed, end)


def warms(recording: Recording, testbed: Testbed) -> bool:
    """Say whether it is known to have become warmer or cooler."""
    rows = temperature_of(recording, testbed)
    return rows is not None and rows.varies
