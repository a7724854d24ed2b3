"""Blocks that a page shows to be used: lines over a common axis, a replay, correlations.

Numbers stand in the unit that is shown. PDF, print and pages without scripts show the still form of
a block: a chart's drawing if it has one, correlations as a table, a replay not at all.
"""

from dataclasses import dataclass
from typing import Literal

Numbers = tuple[float | None, ...]  # None: not known, where a line has a gap
Triple = tuple[float, float, float]
Mark = Literal["line", "dots", "bars", "stems"]


@dataclass(frozen=True, slots=True)
class Rows:
    """Columns at the same abscissae."""

    names: tuple[str, ...]
    x: tuple[float, ...]
    columns: tuple[Numbers, ...]
    low: tuple[Numbers, ...] = ()  # of a band about each column; empty: there is none
    high: tuple[Numbers, ...] = ()
    mark: Mark = "line"


@dataclass(frozen=True, slots=True)
class Panel:
    """Rows under one title and on one ordinate."""

    title: str
    unit: str
    rows: tuple[Rows, ...]
    band: float | None = None  # half the height of a shaded band about zero
    scale: tuple[float, float] | None = None  # of the ordinate at first; None: that of its lines


@dataclass(frozen=True, slots=True)
class Chart:
    """Panels that share their abscissa. Charts of one ``record`` share cursor and range too."""

    name: str
    caption: str
    panels: tuple[Panel, ...]
    axis: str = "time"
    axis_unit: str = "s"
    record: str = ""
    shaded: tuple[tuple[float, float], ...] = ()  # from, to
    drawing: str = ""  # caption of the figure of its name, its still form; empty: there is none
    kind: Literal["chart"] = "chart"


@dataclass(frozen=True, slots=True)
class MovingMass:
    """A sliding mass of a replay: its place at home and its axis in body axes (m)."""

    name: str
    home: Triple
    axis: Triple
    travel: tuple[float, float]


@dataclass(frozen=True, slots=True)
class Ellipsoid:
    """The ellipsoid of even density with a body's inertia."""

    semi_axes: Triple  # m
    directions: tuple[Triple, Triple, Triple]  # of these, unit vectors in body axes


@dataclass(frozen=True, slots=True)
class Replay:
    """A recorded motion with centre of mass and inertia, where they are known. SI, body axes."""

    name: str
    caption: str
    record: str
    layout: str
    up: Triple
    t: tuple[float, ...]
    attitude: tuple[tuple[float, float, float, float], ...]  # body to laboratory, scalar first
    masses: tuple[MovingMass, ...]
    displacements: tuple[tuple[float, ...], ...]  # a row a time, of each mass
    com: Triple | None
    com_covariance: tuple[float, ...]  # nine numbers by rows, m^2; empty: not known
    ellipsoid: Ellipsoid | None
    kind: Literal["replay"] = "replay"


@dataclass(frozen=True, slots=True)
class Heatmap:
    """A correlation for each pair of names, by rows; None where it is not known."""

    title: str
    names: tuple[str, ...]
    values: tuple[Numbers, ...]
    note: str = ""
    kind: Literal["heatmap"] = "heatmap"


Drawn = Chart | Replay


def numbers_within(block: Chart | Replay | Heatmap) -> int:
    """Return how many numbers a block holds."""
    if isinstance(block, Chart):
        rows = (rows for panel in block.panels for rows in panel.rows)
        return sum(len(r.x) * (1 + len(r.columns) + 2 * len(r.low)) for r in rows)
    if isinstance(block, Replay):
        return len(block.t) * (5 + len(block.masses))
    return len(block.names) ** 2


def fault_of(block: Chart | Replay | Heatmap) -> str:
    """Say what keeps a block from being drawn: columns of unequal length; nothing if all fit."""
    if isinstance(block, Chart):
        every = [rows for panel in block.panels for rows in panel.rows]
        return "" if every and all(map(_fits, every)) else "columns of unequal length"
    if isinstance(block, Replay):
        fits = len(block.t) == len(block.attitude) == len(block.displacements) > 0
        fits = fits and {len(row) for row in block.displacements} == {len(block.masses)}
        known = len(block.com_covariance) == (0 if block.com is None else 9)
        return "" if fits and known else "rows of unequal length"
    sizes = {len(block.values), *map(len, block.values)}
    return "" if sizes == {len(block.names)} else "a table that is not square"


def _fits(rows: Rows) -> bool:
    bands = (len(rows.low), len(rows.high))
    lengths = {len(column) for column in (*rows.columns, *rows.low, *rows.high)}
    return (
        len(rows.columns) == len(rows.names) > 0
        and bands in ((0, 0), (len(rows.names), len(rows.names)))
        and lengths == {len(rows.x)}
    )
