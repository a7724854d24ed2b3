"""`equipoise demo`: the whole way, from unknown and unbalanced to balanced and verified."""

from pathlib import Path

from equipoise.app.arguments.options import Whole
from equipoise.app.console.terminal import busy


def demo(*, out: Path = Path("equipoise-out/demo"), seed: Whole = 1) -> int:
    """Identify and balance a simulated mock-up, and write a report.

    Parameters
    ----------
    out
        Folder for report, figures and balance.json.
    seed
        Random seed; the same seed gives the same run.
    """
    from equipoise.app.arguments.checks import check_outputs, seed_of
    from equipoise.io.testbed.presets import read_preset

    bed, seed = read_preset("sputnix"), seed_of(seed)
    check_outputs(out)
    with busy("preparing the bench", announce=False):
        from equipoise.app.logbook.output import hand_over
        from equipoise.app.runs.demonstration import run_demo
        from equipoise.app.runs.terminal_waiting import show_step
        from equipoise.app.views.demo_views import output_of

    shown = run_demo(bed, seed, show_step)
    hand_over(output_of(shown), json=False, out=out, below=True)
    return 0 if shown.balancing.verdict.passed else 1
