"""The runner's process: it has the bench, and lives as long as the server that started it.

It receives requests and sends its messages through one pipe. When the pipe breaks, because the
server has ended or crashed, a running procedure is ended, every mass is halted, and the process
ends.
Signals to stop reach the server alone.
"""

from collections.abc import Generator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from multiprocessing.connection import Connection as Pipe
from pathlib import Path
from uuid import uuid4

from equipoise.app.console.crash_file import crash_of
from equipoise.app.dashboard.runner.background_jobs import COMMAND
from equipoise.app.dashboard.runner.benches import Station, real, replayed, simulated
from equipoise.app.dashboard.runner.outbox import Post
from equipoise.app.dashboard.runner.request_handler import Desk
from equipoise.app.dashboard.runner.runner import Runner
from equipoise.app.live.live_estimate import LiveEstimate, grown
from equipoise.hardware.bench.stop_signals import leave_to_commander
from equipoise.model.errors import EquipoiseError
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed
from equipoise.simulation.bench import SimulatedBench


@dataclass(frozen=True, slots=True, eq=False)
class Opening:
    """What the dashboard begins with."""

    testbed: Testbed
    folder: Path  # of runs and recordings
    seed: int
    on_bench: bool = False  # the real one
    recording: Recording | None = None  # to show
    title: str = ""


def run_runner(pipe: Pipe, opening: Opening) -> None:
    """Run until the pipe breaks; the process's whole life."""
    leave_to_commander()
    try:
        with _opened(opening) as station:
            pipe.send(("ready", None))
            _serve(pipe, station, opening)
    except EquipoiseError as error:
        with suppress(OSError):  # the server is gone, too
            pipe.send(("failed", str(error)))
    except (EOFError, OSError):
        return
    except Exception as error:
        with suppress(OSError):
            pipe.send(("failed", crash_of(error, COMMAND).sentence))


def _serve(pipe: Pipe, station: Station, opening: Opening) -> None:
    post = Post(lambda kind, what: pipe.send((kind, what)))
    runner = Runner(station, post, opening.folder, uuid4().hex)
    desk = Desk(runner, pipe, opening.folder, opening.seed)
    try:
        while True:
            runner.turn()
            desk.turn()
    finally:
        station.bench.stop()
        runner.close()


@contextmanager
def _opened(opening: Opening) -> Generator[Station]:
    """Lend the station to begin with."""
    warm_up(opening.testbed)
    if opening.on_bench:
        with real(opening.testbed) as station:
            yield station
    elif opening.recording is not None:
        yield replayed(opening.testbed, opening.recording, opening.title)
    else:
        yield simulated(opening.testbed, opening.seed)


def warm_up(testbed: Testbed) -> None:
    """Compile the kernels before anything is shown: a bench does not wait for a compiler."""
    bench = SimulatedBench(testbed, 0)
    grown(LiveEstimate(testbed), bench.read(1.0))
