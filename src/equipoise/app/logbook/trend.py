"""The trend of a platform, from a logbook to a figure."""

from collections.abc import Sequence
from datetime import datetime
from pathlib import Path

import numpy as np

from equipoise.app.figures.base.files import write_figure
from equipoise.app.figures.study import trend
from equipoise.app.logbook.testbed_history import letters
from equipoise.io.documents.logbook import Logbook
from equipoise.model.errors import InputError
from equipoise.model.estimate import COM, INERTIA
from equipoise.model.logged_run import LoggedRun

NAMES = (*COM, *INERTIA[:3])
FEWEST = 2
MOST = 1e9  # m, kg m2, chosen: beyond it no number is of a platform, and no axis can show it


def write_trend(book: Logbook, runs: Sequence[LoggedRun], path: Path) -> None:
    """Draw what runs of one platform found.

    Raises InputError if they are of several platforms, or if fewer than two found anything.
    """
    platforms = sorted({run.platform for run in runs})
    if len(platforms) > 1:
        raise InputError(
            "--trend", f"runs of {', '.join(platforms)}", "--platform with one of them"
        )
    rows = [_row(book, run) for run in runs]
    reported = [k for k, (values, _) in enumerate(rows) if np.isfinite(values).any()]
    if len(reported) < FEWEST:
        raise InputError("--trend", f"{len(reported)} runs with an estimate", "two or more")
    write_figure(
        trend.draw(_trend(book, [runs[k] for k in reported], [rows[k] for k in reported])), path
    )


Row = tuple[np.ndarray, np.ndarray]


def _trend(book: Logbook, runs: Sequence[LoggedRun], rows: Sequence[Row]) -> trend.Trend:
    letter = letters(book)
    warmth = [np.nan if run.temperature is None else run.temperature for run in runs]
    return trend.Trend(
        runs[0].platform,
        [datetime.fromisoformat(run.made_at).astimezone().replace(tzinfo=None) for run in runs],
        np.array([values for values, _ in rows]),
        np.array([sd for _, sd in rows]),
        [letter[run.platform, run.configuration] for run in runs],
        np.array(warmth),
    )


def _row(book: Logbook, run: LoggedRun) -> Row:
    """Return values and sd of a run; NaN for what it did not observe, or cannot have."""
    known = {p.name: p for p in book.numbers(run.name, "home") if p.observable}
    found = [(known[n].value, known[n].sd) if n in known else (np.nan, np.nan) for n in NAMES]
    values, sd = np.array(found).T
    values = np.where(np.abs(values) < MOST, values, np.nan)
    return values, np.where(sd < MOST, sd, 0.0)
