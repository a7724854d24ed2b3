"""`equipoise record`: what a real bench shows, into a file that survives anything."""

from pathlib import Path

from equipoise.app.commands.kinds import Flag
from equipoise.app.terminal import counted, stdout

OFTEN = 0.5  # s, between signs of life


def record(testbed: str, /, *, out: Path, duration_s: float = 60.0, foxglove: Flag = False) -> int:
    """Record every sensor of a real bench; masses stay where they are.

    Rows are written as they arrive: what is older than a second is safe whatever happens. Ctrl-C
    ends the record early.

    Parameters
    ----------
    testbed
        Testbed file with a [hardware] table.
    out
        MCAP file to write.
    duration_s
        How long.
    foxglove
        Also serve it live to Foxglove, Lichtblick or PlotJuggler, on this computer.
    """
    from equipoise.app.kept_bench import Wanted, real_bench
    from equipoise.app.options import positive
    from equipoise.app.wiring import testbed_of
    from equipoise.io.durable_file import check_new

    duration = positive("--duration-s", duration_s)
    bed = testbed_of(testbed)
    check_new(out)
    with (
        real_bench(Wanted(bed, out, foxglove)) as bench,
        counted("recording") as so_far,
    ):
        begin = bench.time
        try:
            while (passed := bench.time - begin) < duration:
                bench.read(min(OFTEN, duration - passed))
                so_far(min(passed / duration, 1.0))
        except KeyboardInterrupt:
            pass
    stdout().print(f"wrote {out}", markup=False)
    return 0
