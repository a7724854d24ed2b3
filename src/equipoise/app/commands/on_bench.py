"""Options of a balancing on the real bench, and how it is begun."""

from collections.abc import Generator, Mapping
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from cyclopts import Parameter

from equipoise.app.arguments.options import Flag
from equipoise.app.console.terminal import agreed, busy, stderr
from equipoise.model.errors import InputError

if TYPE_CHECKING:
    from equipoise.app.runs.balancing import Goal, Limits
    from equipoise.model.bench import Bench
    from equipoise.model.testbed import Testbed


@Parameter(name="*")
@dataclass(frozen=True, slots=True)
class OnBench:
    """Balancing on the real bench.

    Attributes
    ----------
    bench
        Balance the real bench. The procedure is rehearsed in simulation, masses go home, then the
        platform is released. Ctrl-C, SIGTERM or a lost terminal halts the masses and saves; a
        second one exits.
    record
        With --bench: MCAP file to write as rows arrive, with every command and interlock.
    foxglove
        With --bench: also serve it live to Foxglove, Lichtblick or PlotJuggler on this computer.
    yes
        With --bench: skip the question whether a person holds the platform.
    """

    bench: Flag = False
    record: Path | None = None
    foxglove: Flag = False
    yes: Flag = False


SIMULATED = OnBench()


def check_on_bench(requested: OnBench) -> None:
    """Raise InputError for what only a real bench takes, and for a record that cannot be."""
    from equipoise.io.files.append_file import check_new

    given = {"--record": requested.record, "--foxglove": requested.foxglove, "--yes": requested.yes}
    for option in (option for option, value in given.items() if value and not requested.bench):
        raise InputError(option, "no --bench", "a real bench")
    if requested.record is not None:
        check_new(requested.record)


def prepare(bed: "Testbed", goal: "Goal", limits: "Limits", requested: OnBench) -> None:
    """Practise in simulation, say what comes of it, and ask whether the platform is held.

    Raises BenchStopped first where a device cannot be reached.
    """
    from equipoise.app.bench.emulation import hardware_of
    from equipoise.app.bench.port_check import check_reachable
    from equipoise.app.runs.rehearsal import practised

    check_reachable(hardware_of(bed))
    with busy("practice on a simulated platform", announce=True):
        verdict = practised(bed, goal, limits)
    if verdict is not None and not verdict.passed:
        stderr().print(f"In practice, simulated: {verdict.sentence}")
    question = "The masses will go home. Is the platform held level, and their way free?"
    if not requested.yes and not agreed(question):
        raise InputError(
            "the platform", "not ready", "a person who holds it; then answer yes, or give --yes"
        )


@contextmanager
def let_go(
    bed: "Testbed", requested: OnBench, standing: "Mapping[str, float] | None" = None
) -> "Generator[Bench]":
    """Return the real platform, let go, and every sensor giving rows.

    Masses are at home, or at displacements (m) where they stood before.
    """
    from equipoise.app.bench.open_bench import Wanted, real_bench

    def say() -> None:
        where = "at home" if standing is None else "where they stood"
        stderr().print(f"Masses are {where}: release the platform.", style="bold")

    with ExitStack() as held:
        with busy("the masses go home", announce=True):
            wanted = Wanted(bed, requested.record, requested.foxglove)
            bench = held.enter_context(real_bench(wanted, say, standing))
        yield bench
