"""`equipoise simulate`: a record of the simulated bench."""

from pathlib import Path
from typing import TYPE_CHECKING

from equipoise.app.arguments.options import Names, Whole
from equipoise.app.console.terminal import announced, busy, counted, show_paths
from equipoise.model.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from equipoise.model.recording import Recording
    from equipoise.model.testbed import Testbed
    from equipoise.simulation.carried_out import MadeBench


def simulate(
    testbed: str,
    /,
    *,
    out: Path,
    duration_s: float | None = None,
    plan: Path | None = None,
    move: Names = (),
    seed: Whole = 1,
    series: Whole | None = None,
) -> int:
    """Simulate a platform, and write what its sensors record.

    A series is of one platform, each run with its own start and noise, as `identify` accepts it. A
    platform that would swing to its stop is released closer to its equilibrium. If it still reaches
    its stop, or a plan or [truth] starts it there, the command states when.

    Parameters
    ----------
    testbed
        Testbed file, or a preset's name. Its [truth] defines the simulated platform.
    out
        File to write: .csv, .parquet, .mcap or .mat. With --series: a folder for run_01.csv and so
        on.
    duration_s
        Length of the record: 120, or as planned.
    plan
        Plan file: how the platform is released, with a person's errors, and what is done then.
    move
        Move of masses, "seconds: mass=mm mass=mm", as displacements from home. May be repeated.
    seed
        Random seed; the same seed gives the same record.
    series
        Simulate this many runs of the platform of the seed, with consecutive seeds.
    """
    from equipoise.app.arguments.checks import duration_of, positive, seed_of
    from equipoise.app.arguments.inputs import move_of, plan_from, testbed_from
    from equipoise.io.files.atomic_file import check_writable
    from equipoise.io.recording.recording_file import write_recording

    bed = announced(testbed_from(testbed))
    duration = duration_of("--duration-s", 120.0 if duration_s is None else duration_s, bed)
    moves, drawn = [move_of(text, bed) for text in move], seed_of(seed)
    planned = None if plan is None else plan_from(plan, bed)
    if planned is not None and (moves or duration_s is not None):
        raise InputError("--plan", "--move or --duration-s beside it", "the plan alone")

    def made(bed: "Testbed", seed: int) -> "tuple[MadeBench, Recording]":
        from equipoise.simulation.carried_out import performed

        manoeuvre = None if planned is None else planned.manoeuvre
        return performed(bed, seed, manoeuvre, duration, moves)

    if series is not None:
        return _series(bed, drawn, int(positive("--series", series)), made, out)
    check_writable(out)
    with busy("simulating"):
        bench, recording = made(bed, drawn)
        write_recording(recording, out)
    _show_touches([bench])
    show_paths([out])
    return 0


def _series(
    bed: "Testbed",
    seed: int,
    runs: int,
    made: "Callable[[Testbed, int], tuple[MadeBench, Recording]]",
    out: Path,
) -> int:
    """Write the recordings of a series into a folder, all of them or none."""
    from equipoise.app.arguments.checks import check_outputs
    from equipoise.app.report.series_files import check_series_folder, recordings_of
    from equipoise.io.files.atomic_file import write_folder
    from equipoise.simulation.series import seeds_of, with_drawn_platform

    check_series_folder("--out", out)
    check_outputs(out)
    platform = with_drawn_platform(bed, seed)
    runs_made = list[tuple["MadeBench", "Recording"]]()
    with counted(f"simulating {runs} runs") as progress:
        for k, each in enumerate(seeds_of(runs, seed), 1):
            runs_made.append(made(platform, each))
            progress(k / runs)
    show_paths(write_folder(out, recordings_of([recording for _, recording in runs_made])))
    _show_touches([bench for bench, _ in runs_made])
    return 0


def _show_touches(benches: "Sequence[MadeBench]") -> None:
    """Say when platforms met their stop."""
    from equipoise.app.console.rich_blocks import show
    from equipoise.app.text.run_blocks import finding_items
    from equipoise.assessment.findings.stop_findings import touch_findings

    for bench in benches:
        spans = [(touch.start, touch.end) for touch in bench.touches]
        show(finding_items(touch_findings(spans, bench.testbed.tilt_limit)))
