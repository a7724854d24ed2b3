"""What happens at a moment: the platform touches something, or a part of it slips.

    contact   H_N += impulse         attitude and centre of mass go on as they were
    slip      mu  += m shift         attitude and H go on as they were, and so does J: the part is
                                     taken to slip by so little that m d^2 does not count

An event acts after its moment: the state and the rate at its node are those just before.
"""

from collections.abc import Sequence

import numpy as np

from equipoise.dynamics.modal_motion import Modes
from equipoise.dynamics.rigid_body import ROWS, Body
from equipoise.maths.attitude import to_matrix
from equipoise.model.arrays import Floats, Series1, Vector3
from equipoise.model.defects import ComStep, Contact
from equipoise.simulation.clock import tick, tick_one
from equipoise.simulation.flexible.modal_path import run_modes
from equipoise.simulation.motion import Path, in_pieces, run
from equipoise.simulation.stop import Stop

Event = Contact | ComStep


def times(events: Sequence[Event]) -> Series1:
    """Return when events happen, s on the bench's clock."""
    return tick(np.array([event.time for event in events], dtype=np.float64))


def struck(y: Floats, contacts: Sequence[Contact], t: float) -> Floats:
    """Return the state just after a moment (s) from that just before."""
    now = [contact.impulse for contact in contacts if tick_one(contact.time) == t]
    if not now:
        return y
    struck_by = to_matrix(y[:4]).T @ np.sum(now, axis=0)
    return np.concatenate([y[:4], y[4:ROWS] + struck_by, y[ROWS:]])


def com_moved(steps: Sequence[ComStep], t: float) -> Vector3:
    """Return how far the centre of mass has slipped just after a moment (s), m."""
    return np.sum([step.shift for step in steps if tick_one(step.time) <= t] or [np.zeros(3)], 0)


def slipped(body: Body, steps: Sequence[ComStep], t: float) -> Body:
    """Return the body as it is just after a moment (s)."""
    x, y, z = np.array(body.moment) + body.mass * com_moved(steps, t)
    return body._replace(moment=(float(x), float(y), float(z)))


def run_through(
    body: Body,
    maps: Floats,
    y: Floats,
    t: Series1,
    known: Floats,
    stop: Stop,
    contacts: Sequence[Contact],
    steps: Sequence[ComStep],
    modes: Modes | None = None,
) -> Path:
    """Return the motion as ``motion.run`` does; events that happen on the way must be nodes."""

    def between(body: Body, start: Floats, t: Series1, known: Floats) -> Path:
        if modes is None:
            return run(body, maps, start, t, known, stop)
        return run_modes(body, maps, modes, start, t, known, stop)

    if not contacts and not steps:
        return between(body, y, t, known)
    happens = np.isin(t[1:-1], times([*contacts, *steps]))

    def follow(here: Floats, piece: slice) -> Path:
        now = float(t[piece.start])
        start = struck(here, contacts, now)
        return between(slipped(body, steps, now), start, t[piece], known[piece])

    return in_pieces([0, *(np.flatnonzero(happens) + 1).tolist(), len(t) - 1], y, follow)
