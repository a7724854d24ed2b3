"""Folders of many runs, as a laboratory has them after ten years: what each is, by its number."""

import math
import os
from collections.abc import Iterable
from datetime import UTC, datetime, timedelta
from pathlib import Path

from equipoise.io.documents.run_file import text_of_run
from equipoise.io.documents.run_folder import TESTBED
from equipoise.io.documents.run_shards import month_of
from equipoise.model.estimate import COM, INERTIA, Parameter
from equipoise.model.logged_run import RUN, LoggedRun, Usability
from equipoise.model.verdict import VerdictOutcome

FIRST, YEARS, DAYS = datetime(2016, 1, 1, tzinfo=UTC), 10, 365.25
PLATFORMS = ("nanosat", "sputnix", "reference-table", "kau", "lab-3", "cubesat-6u")
REBUILT = 8  # testbed files of a platform, one after the other
METHODS = ("simplified", "batch", "output_error", "recursive")
LAW = "measure_and_move"
OUTCOMES = (VerdictOutcome.PASSED, VerdictOutcome.PASSED, VerdictOutcome.PASSED,
            VerdictOutcome.FAILED, VerdictOutcome.UNDECIDED)  # fmt: skip


def made(k: int, count: int) -> datetime:
    """Return when the k-th of so many runs was made."""
    seconds = k * timedelta(days=YEARS * DAYS).total_seconds() / count
    return FIRST + timedelta(seconds=int(seconds))


def build(k: int, count: int) -> int:
    """Return how often the platform of the k-th run had been rebuilt."""
    return k * REBUILT // count


def run_of(k: int, count: int) -> LoggedRun:
    """Return the k-th of so many runs: each third one a balancing, numbers about a place."""
    time, platform = made(k, count), PLATFORMS[k % len(PLATFORMS)]
    balances = k % 3 == 0
    home = tuple(
        Parameter(name, "m" if name in COM else "kg m2", 1e-5 * math.sin(k + i), 1e-7)
        for i, name in enumerate((*COM, *INERTIA))
    )
    provenance = {
        "command to repeat": f"equipoise identify run.csv --testbed {platform} --seed {k}",
        "equipoise": "1.0.0", "made with": "Python 3.11.7, numpy 2.4.0, scipy 1.17.0, on Linux",
        "made at": time.isoformat(),
    }  # fmt: skip
    return LoggedRun(
        name="",
        kind="balance" if balances else "identify",
        made_at=time.isoformat(),
        platform=platform,
        configuration=f"{build(k, count):032x}{k % len(PLATFORMS):032x}",
        method=LAW if balances else METHODS[k % len(METHODS)],
        bench="simulated",
        outcome=OUTCOMES[k % len(OUTCOMES)] if balances else Usability.USABLE,
        sentence="The centre of mass is within the tolerance, as likely as was requested.",
        parameters=home,
        standing=home[:3] if balances else (),
        temperature=20.0 + k % 7 / 7,
        provenance=provenance,
    )


def put(runs: Path, k: int, count: int) -> Path:
    """Write the folder of one run, as old as it is said to be; return it.

    A testbed file stands beside the first run of each build: to read it once is all it takes.
    """
    run, time = run_of(k, count), made(k, count)
    name = f"{time:%Y-%m-%d_%H-%M-%S}_{run.kind}_{run.platform}_{k}"
    folder = runs / month_of(time) / name
    folder.mkdir(parents=True)
    if k < len(PLATFORMS) or build(k, count) != build(k - len(PLATFORMS), count):
        (folder / TESTBED).write_text(f"name = '{run.platform}'\n", encoding="utf-8")
    path = folder / RUN
    path.write_text(text_of_run(run), encoding="utf-8")
    os.utime(path, (time.timestamp(), time.timestamp()))
    return folder


def write_runs(runs: Path, numbers: Iterable[int], count: int) -> None:
    """Write folders of runs, and set the time of each month to that of its last one."""
    last: dict[Path, float] = {}
    for k in numbers:
        last[put(runs, k, count).parent] = made(k, count).timestamp()
    for month, time in last.items():
        os.utime(month, (time, time))
