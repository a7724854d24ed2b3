"""The trend of a platform, from a logbook to a figure."""

from collections.abc import Mapping
from datetime import datetime
from pathlib import Path

import numpy as np

from equipoise.app.figures.base.files import write_figure
from equipoise.app.figures.study import trend
from equipoise.app.logbook import trend_bands
from equipoise.app.logbook.testbed_history import letters
from equipoise.io.documents.logbook import Choice, Logbook, RunTable
from equipoise.model.arrays import Floats, Ints
from equipoise.model.errors import InputError
from equipoise.model.estimate import COM, INERTIA

NAMES = (*COM, *INERTIA[:3])
COLUMNS = ("platform", "configuration", "made_at", "temperature")
Letters = Mapping[tuple[str, str], str]
FEWEST = 2
MOST = 1e9  # m, kg m2, chosen: beyond it no number is of a platform, and no axis can show it


def write_trend(book: Logbook, choice: Choice, path: Path) -> None:
    """Draw what runs of one platform found.

    Raises InputError if they are of several platforms, or if fewer than two found anything.
    """
    found = book.table(COLUMNS, ("home",), choice)
    platforms = sorted(set(found.columns["platform"]))
    if len(platforms) > 1:
        raise InputError(
            "--trend", f"runs of {', '.join(platforms)}", "--platform with one of them"
        )
    values, sd = _numbers(found)
    reported = np.flatnonzero(np.isfinite(values).any(axis=1))
    if len(reported) < FEWEST:
        raise InputError("--trend", f"{len(reported)} runs with an estimate", "two or more")
    letter = letters(book)
    write_figure(trend.draw(_trend(found, reported, (values, sd), letter)), path)


def _trend(
    found: RunTable, rows: Ints, numbers: tuple[Floats, Floats], letter: Letters
) -> trend.Trend:
    """Return what is drawn of these rows."""
    platform, configuration, made_at, warmth = (
        [found.columns[name][k] for k in rows] for name in COLUMNS
    )
    values, sd = (each[rows] for each in numbers)
    times = [datetime.fromisoformat(each).astimezone().replace(tzinfo=None) for each in made_at]
    temperature = np.array([np.nan if each is None else each for each in warmth])
    bands = trend_bands.over_time(times, values)
    return trend.Trend(
        platform[0],
        times,
        values,
        sd,
        [letter[key] for key in zip(platform, configuration, strict=True)],
        temperature,
        bands,
        trend_bands.over(temperature, values) if bands else (),
    )


def _numbers(found: RunTable) -> tuple[Floats, Floats]:
    """Return values and sd; NaN for what a run did not observe, or cannot have."""
    numbers = found.numbers("home", NAMES)
    known = numbers.observable & (np.abs(numbers.value) < MOST)
    sd = np.where(numbers.sd < MOST, numbers.sd, 0.0)
    return np.where(known, numbers.value, np.nan), np.where(numbers.observable, sd, 0.0)
