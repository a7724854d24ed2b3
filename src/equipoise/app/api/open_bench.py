"""The real bench that a testbed's [hardware] declares."""

from collections.abc import Callable, Generator
from contextlib import contextmanager
from pathlib import Path

from equipoise.app.arguments.inputs import AnyTestbed, testbed_from
from equipoise.app.bench.open_bench import Wanted, real_bench
from equipoise.model.bench import Bench


@contextmanager
def open_bench(
    testbed: AnyTestbed,
    *,
    let_go: Callable[[], None] | None = None,
    record: str | Path | None = None,
    foxglove: bool = False,
) -> Generator[Bench]:
    """Open the real bench for a ``with`` block: every device answers, and sensors give rows.

    The ports belong to a process of its own, so a script guards its start by
    ``if __name__ == "__main__":``. When the block ends, however it ends, masses are halted.

    Parameters
    ----------
    testbed
        Testbed with a [hardware] table, its file, or a preset's name.
    let_go
        Called when the masses are at home, such as to ask a person to let the platform go; the
        platform counts as free a second later. None: masses stay, and nothing can be moved.
    record
        MCAP file to write as rows arrive, with every command and interlock.
    foxglove
        Serve it live to Foxglove, Lichtblick or PlotJuggler on this computer, too.

    Raises
    ------
    InputError
        For a testbed without hardware, and files that cannot be read or written.
    BenchStopped
        Where a device cannot be reached, and when an interlock stops the masses.
    """
    file = None if record is None else Path(record)
    with real_bench(Wanted(testbed_from(testbed), file, foxglove), let_go) as bench:
        yield bench
