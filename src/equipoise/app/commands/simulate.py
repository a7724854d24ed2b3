"""`equipoise simulate`: a record of the simulated bench."""

from pathlib import Path

from equipoise.app.commands.kinds import Names, Whole
from equipoise.app.terminal import busy, stdout


def simulate(
    testbed: str,
    /,
    *,
    out: Path,
    duration_s: float = 120.0,
    move: Names = (),
    seed: Whole = 1,
) -> int:
    """Simulate a platform in free motion, and write what its sensors record.

    Parameters
    ----------
    testbed
        Testbed file, or a preset's name. Its [truth] says what the simulated platform is like.
    out
        File to write, .csv or .parquet.
    duration_s
        Length of the record.
    move
        Move of masses, "seconds: mass=mm mass=mm", as displacements from home. May be repeated.
    seed
        Seed of all that is drawn: the same seed gives the same record.
    """
    from equipoise.app.options import positive, seed_of
    from equipoise.app.wiring import move_of, testbed_of
    from equipoise.io.recording_file import write_recording
    from equipoise.io.whole_file import check_writable

    bed = testbed_of(testbed)
    duration = positive("--duration-s", duration_s)
    moves = [move_of(text, bed) for text in move]
    check_writable(out)
    with busy("simulating"):
        from equipoise.simulation.record import record

        recording = record(bed, duration, moves, seed_of(seed))
        write_recording(recording, out)
    stdout().print(f"wrote {out}", markup=False)
    return 0
