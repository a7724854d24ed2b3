"""`equipoise demo`: the whole way, from unknown and unbalanced to balanced and verified."""

from pathlib import Path

from equipoise.app.arguments.types import Whole
from equipoise.app.console.terminal import busy, show_paths, stdout


def demo(*, out: Path = Path("equipoise-out/demo"), seed: Whole = 1) -> int:
    """Identify a simulated mock-up, balance it, test the result, and write a report.

    Parameters
    ----------
    out
        Folder for report, figures and balance.json.
    seed
        Seed of all that is drawn: the same seed gives the same run.
    """
    from equipoise.app.arguments.checks import seed_of
    from equipoise.io.files.atomic_folder import check_folder
    from equipoise.io.testbed.presets import read_preset

    bed, seed = read_preset("sputnix"), seed_of(seed)
    check_folder(out)
    with busy("preparing the bench", announce=False):
        from equipoise.app.report.write import write_run
        from equipoise.app.runs.demonstration import courses_of, run_demo
        from equipoise.app.views.balance_views import document_of, kept_of, show_result, show_step
        from equipoise.app.views.demo_views import account_of
        from equipoise.procedure.balancing.catalogue import OWN

    shown = run_demo(bed, seed, show_step)
    show_result(shown.balancing)
    with busy("drawing"):
        document = document_of(shown.balancing, seed)
        kept = kept_of(shown.balancing, OWN.name)
        account = account_of(shown, seed, courses_of(shown))
        paths = write_run(account, document, "balance", kept, out)
    stdout().print()
    show_paths(paths)
    return 0 if shown.balancing.verdict.passed else 1
