"""`equipoise precompile`: all kernels, before somebody waits for them."""

from equipoise.app.arguments.options import Whole
from equipoise.app.console.terminal import counted_pieces, print_whole


def precompile(*, workers: Whole | None = None) -> int:
    """Compile all kernels now, so that no later command waits for it.

    Kernels are compiled once per computer, by the first command that needs them. This runs every
    such command once on a short simulated record, in a temporary folder.

    Parameters
    ----------
    workers
        Number of concurrent commands. If omitted: one per processor.
    """
    import os
    from pathlib import Path
    from tempfile import TemporaryDirectory

    from equipoise.app.arguments.checks import positive
    from equipoise.app.runs.kernel_rehearsal import COMMANDS, RECORDS, rehearsed
    from equipoise.maths.kernels.kernel_cache import kernels_folder
    from equipoise.model.units import MEGABYTE

    count = len(RECORDS) + len(COMMANDS)
    at_once = (os.cpu_count() or 1) if workers is None else int(positive("--workers", workers))
    with (
        TemporaryDirectory(prefix="equipoise-") as folder,
        counted_pieces("compiling kernels, once per computer") as report,
    ):
        report(0, count)
        for done, _ in enumerate(rehearsed(Path(folder), at_once), 1):
            report(done, count)
    kept = [path.stat().st_size for path in kernels_folder().rglob("*.nbc")]
    print_whole(
        f"{len(kept)} kernels, {sum(kept) / MEGABYTE:.1f} MB, are kept in {kernels_folder()}."
    )
    return 0
