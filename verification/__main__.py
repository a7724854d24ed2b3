"""`python -m verification [NAME ...] [--seeds N]`: measure, print, and write the document.

Exit code 1 if a number is not as wanted.
"""

import argparse
import datetime
import sys
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from rich.console import Console

from equipoise.app.console.terminal import counted_pieces
from equipoise.app.engine.choice import LOCAL, engine_of
from equipoise.app.engine.pool import Engine
from equipoise.app.engine.spread import spread_over
from equipoise.io.files.atomic_file import check_writable, write_whole
from equipoise.model.errors import InputError
from verification import (
    any_bytes,
    balanced,
    board_in_real_time,
    board_soak,
    calibration,
    camera,
    compared,
    dashboard_hour,
    defective_logs,
    design_predictions,
    drift,
    efficiency,
    emulated_balancing,
    faulty_benches,
    feed_forward,
    floods,
    fully_actuated,
    independent_truth,
    interrupted_commands,
    keep,
    kept_hours,
    killed_recordings,
    laboratories,
    lagging_masses,
    lamp,
    latency,
    laws,
    laws_on_mujoco,
    laws_on_ports,
    lee,
    logbook_scale,
    long_emulation,
    long_record,
    long_tables,
    manual,
    method_intervals,
    method_table,
    modes,
    mujoco_platforms,
    one_micro,
    planar,
    planned,
    real_methods,
    real_record,
    robustness,
    siblings,
    starts,
    structures,
    sudden_faults,
    table1,
    torque_by_cause,
    tracker_honesty,
    tracker_knows,
    two_levels,
    undeclared_drift,
    vector_sensors,
    verdicts,
)
from verification.document import page, section, sections_of, table_of
from verification.result import Result, Spread

PAGE = Path(__file__).parents[1] / "docs" / "verification.md"


@dataclass(frozen=True, slots=True)
class Check:
    """A claim's measurement and the seeds that it is stated for."""

    measure: Callable[[Sequence[int], Spread], Result]
    seeds: int


CHECKS = {
    "independent_truth": Check(independent_truth.measure, 10),
    "mujoco_platforms": Check(mujoco_platforms.measure, 20),
    "vector_sensors": Check(vector_sensors.measure, 200),
    "planar": Check(planar.measure, 100),
    "lagging_masses": Check(lagging_masses.measure, 40),
    "lamp": Check(lamp.measure, 40),
    "modes": Check(modes.measure, modes.STATED),
    "efficiency": Check(efficiency.measure, 2000),
    "laboratories": Check(laboratories.measure, 6),
    "siblings": Check(siblings.measure, siblings.STATED),
    "starts": Check(starts.measure, 20),
    "tracker_honesty": Check(tracker_honesty.measure, 200),
    "tracker_knows": Check(tracker_knows.measure, 200),
    "defective_logs": Check(defective_logs.measure, 200),
    "calibration": Check(calibration.measure, calibration.STATED),
    "balanced": Check(balanced.measure, 500),
    "verdicts": Check(verdicts.measure, 500),
    "drift": Check(drift.measure, 20),
    "keep": Check(keep.measure, 50),
    "kept_hours": Check(kept_hours.measure, 8),
    "ledger": Check(torque_by_cause.measure, 10),
    "undeclared_drift": Check(undeclared_drift.measure, 100),
    "manual": Check(manual.measure, 200),
    "one_micro": Check(one_micro.measure, 60),
    "two_levels": Check(two_levels.measure, 200),
    "long_record": Check(long_record.measure, 5),
    "long_tables": Check(long_tables.measure, 1),
    "logbook_scale": Check(logbook_scale.measure, logbook_scale.STATED),
    "real_record": Check(real_record.measure, 1),
    "compared": Check(compared.measure, compared.STATED),
    "method_table": Check(method_table.measure, 20),
    "method_intervals": Check(method_intervals.measure, 200),
    "robustness": Check(robustness.measure, 20),
    "laws": Check(laws.measure, 100),
    "laws_on_mujoco": Check(laws_on_mujoco.measure, 3),
    "feed_forward": Check(feed_forward.measure, 20),
    "fully_actuated": Check(fully_actuated.measure, 50),
    "lee": Check(lee.measure, 100),
    "table1": Check(table1.measure, table1.STATED),
    "planned": Check(planned.measure, 100),
    "design_predictions": Check(design_predictions.measure, 400),
    "emulated_nanosat": Check(emulated_balancing.of("nanosat", "Grbl and VN-100"), 60),
    "emulated_sputnix": Check(emulated_balancing.of("sputnix", "Grbl and a drawn camera"), 80),
    "laws_on_ports": Check(laws_on_ports.measure, 3),
    "faulty_devices": Check(laws_on_ports.measure_faults, 112),
    "faulty_benches": Check(faulty_benches.measure, 306),
    "board_soak": Check(board_soak.measure, 50),
    "board_in_real_time": Check(board_in_real_time.measure, 10),
    "killed_recordings": Check(killed_recordings.measure, 200),
    "interrupted_commands": Check(interrupted_commands.measure, 300),
    "sudden_faults": Check(sudden_faults.measure, 300),
    "any_bytes": Check(any_bytes.measure, 1000),
    "structures": Check(structures.measure, 1000),
    "camera": Check(camera.measure, 25),
    "latency": Check(latency.measure, 3),
    "long_emulation": Check(long_emulation.measure, 8),
    "dashboard_hour": Check(dashboard_hour.measure, 60),
    "floods": Check(floods.measure, 1),
    "real_methods": Check(real_methods.measure, 1),
}


def arguments(words: Sequence[str]) -> argparse.Namespace:
    """Return what was asked for."""
    parser = argparse.ArgumentParser(prog="python -m verification", description=__doc__)
    parser.add_argument("names", nargs="*", metavar="NAME", help=", ".join(CHECKS))
    parser.add_argument("--seeds", type=int, help="instead of those that a claim is stated for")
    parser.add_argument("--workers", type=int, default=2, help="processes (2)")
    parser.add_argument(
        "--on", default=LOCAL, help="local, dask-local or dask://HOST:PORT, with all its workers"
    )
    parser.add_argument("--date", default=None, help="to write into the sections (today)")
    parser.add_argument(
        "--output", type=Path, default=None,
        help=f"page to write ({PAGE.name}); other sections that it has stay as they are",
    )  # fmt: skip
    requested = parser.parse_args(words)
    unknown = [name for name in requested.names if name not in CHECKS]
    if unknown:
        parser.error(f"no check is called {unknown[0]}; there are {', '.join(CHECKS)}")
    if requested.workers < 1 or (requested.seeds is not None and requested.seeds < 1):
        parser.error("--workers and --seeds must be 1 or more")
    return requested


def command_of(name: str, seeds: int) -> str:
    """Return the command that measures the same again."""
    own = "" if seeds == CHECKS[name].seeds else f" --seeds {seeds}"
    return f"python -m verification {name}{own}"


def measured(name: str, seeds: int, engine: Engine) -> tuple[Result, float]:
    """Measure one claim with a progress bar; return the result and the time it took."""
    began = time.perf_counter()
    with engine() as pool:
        spread = spread_over(pool, partial(counted_pieces, name))
        result = CHECKS[name].measure(
            range(seeds), lambda work, items: list(spread(work, list(items)))
        )
    return result, time.perf_counter() - began


def kept_in(target: Path) -> dict[str, str]:
    """Return the sections that a page has already."""
    return sections_of(target.read_text(encoding="utf-8")) if target.exists() else {}


def main(words: Sequence[str]) -> int:
    """Measure what was asked for; the page is written when everything was, or at --output."""
    requested = arguments(words)
    console = Console()
    engine = engine_of(requested.on, requested.workers)
    names = requested.names or list(CHECKS)
    whole = not requested.names and requested.seeds is None
    target = requested.output or (PAGE if whole else None)
    if target is not None:
        check_writable(target)
    date = requested.date or datetime.datetime.now(tz=datetime.UTC).date().isoformat()
    results: list[Result] = []
    sections: dict[str, str] = {}
    for name in names:
        seeds = requested.seeds or CHECKS[name].seeds
        result, seconds = measured(name, seeds, engine)
        console.print(table_of(result))
        results.append(result)
        sections[name] = section(result, command_of(name, seeds), seconds, date)
    if target is not None:
        sections = ({} if whole else kept_in(target)) | sections  # others may have written since
        write_whole(target, page(sections[name] for name in CHECKS if name in sections))
        console.print(f"Wrote {target}.")
    return 1 if any(result.missed for result in results) else 0


if __name__ == "__main__":
    try:
        sys.exit(main(sys.argv[1:]))
    except InputError as error:
        print(error, file=sys.stderr)
        sys.exit(2)
