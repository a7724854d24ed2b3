"""`equipoise record`: what a real bench shows, into a file that survives anything."""

from contextlib import ExitStack, suppress
from pathlib import Path
from typing import TYPE_CHECKING

from equipoise.app.arguments.feeding import NOT_FED, Feeding, receiver_of
from equipoise.app.arguments.options import Flag
from equipoise.app.console.terminal import announced, busy, show_paths

if TYPE_CHECKING:
    from equipoise.model.bench import Bench


def record(
    testbed: str,
    /,
    *,
    out: Path,
    duration_s: float = 60.0,
    foxglove: Flag = False,
    feeding: Feeding = NOT_FED,
) -> int:
    """Record every sensor of a real bench without moving a mass.

    Rows are written as they arrive: what is older than a second survives any failure. Ctrl-C ends
    the record early.

    Parameters
    ----------
    testbed
        Testbed file with a [hardware] table.
    out
        MCAP file to write.
    duration_s
        Length of the record.
    foxglove
        Also serve it live to Foxglove, Lichtblick or PlotJuggler on this computer.
    """
    from equipoise.app.arguments.checks import positive
    from equipoise.app.arguments.inputs import testbed_from
    from equipoise.app.bench.open_bench import Wanted, real_bench
    from equipoise.app.live.feed_forward import fed
    from equipoise.io.files.append_file import check_new

    duration = positive("--duration-s", duration_s)
    bed = announced(testbed_from(testbed))
    check_new(out)
    receiver = receiver_of(feeding)
    with ExitStack() as held:
        with busy("reaching the bench", announce=False):
            bench = held.enter_context(real_bench(Wanted(bed, out, foxglove)))
        _record(held.enter_context(fed(bench, receiver, bench.note)), out, duration)
    show_paths([out])
    return 0


def _record(bench: "Bench", out: Path, duration: float) -> None:
    """Read for so long (s), or until Ctrl-C; the bench itself writes the rows."""
    from equipoise.app.live.status_block import SLICE, RecordingView, watched_by

    begin = bench.time
    view = RecordingView(bench.testbed, out, begin, duration)
    observed = watched_by(view, bench)
    with suppress(KeyboardInterrupt), busy("recording", above=view):
        while (passed := bench.time - begin) < duration:
            observed.read(min(SLICE, duration - passed))
