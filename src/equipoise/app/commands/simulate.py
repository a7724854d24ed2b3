"""`equipoise simulate`: a record of the simulated bench."""

from pathlib import Path
from typing import TYPE_CHECKING

from equipoise.app.arguments.options import Names, Whole
from equipoise.app.console.terminal import busy, show_paths
from equipoise.model.errors import InputError

if TYPE_CHECKING:
    from equipoise.simulation.bench import SimulatedBench


def simulate(
    testbed: str,
    /,
    *,
    out: Path,
    duration_s: float | None = None,
    plan: Path | None = None,
    move: Names = (),
    seed: Whole = 1,
) -> int:
    """Simulate a platform in free motion or a planned manoeuvre, and write what its sensors record.

    A platform that would swing to its stop is let go nearer to where it hangs. One that meets its
    stop even so, or as a plan or [truth] starts it, is said to, and when.

    Parameters
    ----------
    testbed
        Testbed file, or a preset's name. Its [truth] says what the simulated platform is like.
    out
        File to write: .csv, .parquet, .mcap or .mat.
    duration_s
        Length of the record: 120, or as the plan has it.
    plan
        Plan file: how the platform is let go, by a hand that errs, and what is done then.
    move
        Move of masses, "seconds: mass=mm mass=mm", as displacements from home. May be repeated.
    seed
        Seed of all that is drawn: the same seed gives the same record.
    """
    from equipoise.app.arguments.checks import positive, seed_of
    from equipoise.app.arguments.inputs import move_of, plan_from, testbed_from
    from equipoise.io.files.atomic_file import check_writable
    from equipoise.io.recording.recording_file import write_recording

    bed = testbed_from(testbed)
    duration = positive("--duration-s", 120.0 if duration_s is None else duration_s)
    moves, drawn = [move_of(text, bed) for text in move], seed_of(seed)
    planned = None if plan is None else plan_from(plan, bed)
    if planned is not None and (moves or duration_s is not None):
        raise InputError("--plan", "--move or --duration-s beside it", "the plan alone")
    check_writable(out)
    with busy("simulating"):
        from equipoise.simulation.carried_out import bench_for, carried_out, recorded
        from equipoise.simulation.free_start import freely

        if planned is None:
            bench, recording = freely(bed, drawn, lambda bench: recorded(bench, duration, moves))
        else:
            bench = bench_for(bed, planned.manoeuvre, drawn)
            recording = carried_out(bench, planned.manoeuvre)
        write_recording(recording, out)
    _show_touches(bench)
    show_paths([out])
    return 0


def _show_touches(bench: "SimulatedBench") -> None:
    """Say when the platform met its stop."""
    from equipoise.app.console.rich_blocks import show
    from equipoise.app.text.run_blocks import finding_items
    from equipoise.assessment.findings.stop_findings import touch_findings

    spans = [(touch.start, touch.end) for touch in bench.touches]
    show(finding_items(touch_findings(spans, bench.testbed.tilt_limit)))
