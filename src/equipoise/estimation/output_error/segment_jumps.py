"""Where a trajectory may jump: contacts, parts that shift, slow changes, gaps nobody watched.

A jump is an unknown of its own with a normal prior of mean zero; see ``segments`` for how it is
solved. Names are those of the layout's coordinates, sizes are one sd in SI.
"""

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from equipoise.dynamics.timeline import SAME
from equipoise.estimation.output_error.kernels.segments import Cuts
from equipoise.estimation.parameters.fit_parameters import Layout
from equipoise.model.arrays import Floats, Series1


class Jump(NamedTuple):
    """At this time these coordinates may change at once."""

    t: float  # s
    names: tuple[str, ...]
    sd: tuple[float, ...]
    is_event: bool = False  # something that happened, not process noise

    @property
    def is_noise(self) -> bool:
        """Say whether this is process noise; a cut at which nothing may jump is none."""
        return bool(self.names) and not self.is_event


UNCUT: tuple[Jump, ...] = ()


def walk(times: Series1, names: tuple[str, ...], sd: Floats) -> tuple[Jump, ...]:
    """Return the jumps of process noise: at each time, each coordinate by its sd."""
    alike = tuple(map(float, sd))
    return tuple(Jump(t, names, alike) for t in times.tolist())


def width(jumps: tuple[Jump, ...]) -> int:
    """Return how many coordinates jump at once, at most; at least 1."""
    return max((len(jump.names) for jump in jumps), default=1) or 1


def carried(old: tuple[Jump, ...], values: Floats, new: tuple[Jump, ...]) -> Floats:
    """Return the values of new jumps: those of old ones at the same time, else zero."""
    out, before = np.zeros((len(new), width(new))), {jump.t: k for k, jump in enumerate(old)}
    at = [before.get(jump.t, -1) for jump in new]
    alike = [k >= 0 and old[k].names == jump.names for k, jump in zip(at, new, strict=True)]
    rows = np.flatnonzero(alike)
    known = min(out.shape[1], values.shape[1])
    out[rows, :known] = values[np.array(at, dtype=np.int64)[rows], :known]
    for k, jump in enumerate(new):
        if at[k] >= 0 and not alike[k]:
            row = dict(zip(old[at[k]].names, values[at[k]], strict=False))
            out[k, : len(jump.names)] = [row.get(name, 0.0) for name in jump.names]
    return out


def inside(jumps: Iterable[Jump], start: float, end: float) -> tuple[Jump, ...]:
    """Return the jumps within a record, in order of time, those of one time as one.

    Times that the grid does not separate are one: no stretch is empty.
    """
    found: list[Jump] = []
    for jump in sorted(jumps, key=lambda j: j.t):
        if not start + SAME < jump.t < end - SAME:
            continue
        if found and jump.t - found[-1].t <= SAME:
            last = found.pop()
            either = last.is_event or jump.is_event
            jump = Jump(last.t, last.names + jump.names, last.sd + jump.sd, either)
        found.append(jump)
    return tuple(found)


def cuts_of(jumps: tuple[Jump, ...], t: Series1, layout: Layout) -> Cuts:
    """Return the cuts of a grid with nodes ``t`` that has a node at each jump."""
    where = {name: k for k, name in enumerate(layout.names)}
    most = width(jumps)
    free = np.full((len(jumps), most), -1, dtype=np.int64)
    weight: Floats = np.zeros((len(jumps), most))
    alike: dict[tuple[tuple[str, ...], tuple[float, ...]], list[int]] = {}  # few differ
    for k, jump in enumerate(jumps):
        alike.setdefault((jump.names, jump.sd), []).append(k)
    for (names, sd), rows in alike.items():
        free[rows, : len(names)] = [where[name] for name in names]
        weight[rows, : len(names)] = np.array(sd) ** -2.0
    inner = np.searchsorted(t, [jump.t - SAME for jump in jumps])
    nodes = np.concatenate([[0], inner, [len(t) - 1]]).astype(np.int64)
    return Cuts(nodes, free, weight)
