"""The keeper in its own process, so that motors stop whatever happens to the commander.

The two communicate through a pipe. When it breaks, because the commander has ended, been killed or
crashed, the keeper halts every mass, closes the record and ends. Signals to stop reach the
commander alone. The keeper never waits for the commander: what it has to say waits in a queue.

    commander to keeper    (n, "go", targets)  (n, "drive", inputs)  (n, "home")  (n, "begin")
                           (n, "halt", why)    (n, "health")  (n, "note", kind, sentence, data)
                           n: counts the commands
    keeper to commander    ("news", News)      ("answer", (n, what came of it, or an error))
"""

import math
import queue
import threading
import traceback
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass
from multiprocessing import get_context
from multiprocessing.connection import Connection as Pipe
from typing import Any, Protocol

from equipoise.hardware.bench.atomic_message import whole_message
from equipoise.hardware.bench.bench_controller import BenchState, Keeper
from equipoise.hardware.bench.stop_signals import leave_to_commander
from equipoise.hardware.bench.wall_clock import WallClock
from equipoise.hardware.links.health import Health
from equipoise.model.errors import BenchStopped, EquipoiseError, UnforeseenError
from equipoise.model.reasons.reason import Reason
from equipoise.model.recording import Recording, joined
from equipoise.model.testbed import Testbed

BEAT = 0.05  # s, chosen: between news when nothing is new
BEGIN = 60.0  # s, chosen: for the keeper's process to begin, on a slow computer
ANSWER = 5.0  # s, chosen: for the keeper to carry out a command, or to say anything
ENDED = "the keeper of the bench has ended"
LEAVING = 2.0  # s, chosen: for the keeper to end


@dataclass(frozen=True, slots=True, eq=False)
class News:
    """What a commander knows of its keeper."""

    t: float  # s, on the keeper's clock
    state: BenchState
    rows: Recording | None  # since the last news


class Kept(Protocol):
    """What the process keeps: a keeper, and what is to be closed with it."""

    keeper: Keeper
    clock: WallClock  # the bench's time, from its one origin

    def close(self) -> None:
        """Stop every mass, close ports and records."""
        ...


def run_keeper(pipe: Pipe, make: Callable[[Any], Kept], what: Any) -> None:
    """Keep a bench until the pipe breaks; the process's whole life."""
    leave_to_commander()
    box: queue.SimpleQueue[tuple[str, Any] | None] = queue.SimpleQueue()
    try:
        kept = make(what)
    except Exception as error:
        pipe.send(("answer", (0, _declared(error))))
        return
    sender = threading.Thread(target=_send_all, args=(pipe, box), daemon=True)
    sender.start()
    box.put(("answer", (0, kept.clock.begun_ns)))
    try:
        _serve(pipe, kept, box)
    except Exception as error:
        box.put(("end", _declared(error)))
    finally:
        kept.close()
    box.put(None)
    sender.join(LEAVING)  # whatever is to be said is on its way


def _declared(error: Exception) -> EquipoiseError:
    """Return what a commander can be told; where it happened goes with it, for a crash file."""
    if isinstance(error, EquipoiseError):
        return error
    unforeseen = UnforeseenError("the keeper of the bench", error)
    unforeseen.add_note(traceback.format_exc())
    return unforeseen


def _serve(pipe: Pipe, kept: Kept, box: "queue.SimpleQueue[tuple[str, Any] | None]") -> None:
    keeper, clock, reported, before = kept.keeper, kept.clock, float("-inf"), None
    while True:
        keeper.turn(clock.now)
        answers: list[tuple[str, Any]] = []
        try:
            while pipe.poll():
                number, *command = pipe.recv()
                answers.append(("answer", (number, _carried_out(keeper, *command))))
        except (EOFError, OSError):
            return
        news = _news(keeper, clock.now)
        changed = answers or news.rows is not None or news.state != before
        if changed or news.t - reported > BEAT:
            box.put(("news", news))
            reported, before = news.t, news.state
        for answer in answers:  # after the news, so that a command's effect is known with it
            box.put(answer)
        clock.wait()


def _news(keeper: Keeper, t: float) -> News:
    rows = keeper.taken()
    any_rows = any(c is not None for c in (rows.attitude, rows.rate, rows.masses, rows.devices))
    return News(t, keeper.state, rows if any_rows else None)


def _carried_out(keeper: Keeper, verb: str, *what: Any) -> Any:
    """Carry out a command; return what it gives, or what was wrong with it."""
    verbs: dict[str, Callable[..., Any]] = {
        "go": keeper.go,
        "drive": keeper.drive,
        "home": keeper.home,
        "begin": keeper.begin,
        "halt": keeper.halt,
        "health": keeper.health,
        "note": keeper.note,
    }
    try:
        return verbs[verb](*what)
    except EquipoiseError as error:
        return error


def _send_all(pipe: Pipe, box: "queue.SimpleQueue[tuple[str, Any] | None]") -> None:
    with suppress(OSError):
        while (message := box.get()) is not None:
            pipe.send(message)


class DistantKeeper:
    """A keeper in another process: the surface that ``RealBench`` needs, and its clock."""

    def __init__(self, testbed: Testbed, make: Callable[[Any], Kept], what: Any) -> None:
        context = get_context("spawn")
        self._pipe, remote = context.Pipe()
        self._process = context.Process(target=run_keeper, args=(remote, make, what), daemon=True)
        self._process.start()
        remote.close()
        self.testbed = testbed
        self._news = News(0.0, BenchState(), None)
        self._parts: list[Recording] = []
        self._requested = 0  # commands so far
        try:
            self.begun_ns: int = self._answer(BEGIN)  # UTC at bench time zero, ns since 1970
        except BaseException:  # Ctrl-C too: nobody else would close it, and it waits for the pipe
            self.close()
            raise

    @property
    def now(self) -> float:
        """The keeper's time by the last news, s."""
        return self._news.t

    def wait(self) -> None:
        """Wait for news; a keeper that is well has some each ``BEAT``."""
        if not self._pipe.poll(ANSWER):
            raise BenchStopped(f"the keeper of the bench has not spoken for {ANSWER:g} s")

    def turn(self, t: float) -> None:
        """Take in the news; the keeper has its own clock, so ``t`` is not asked."""
        while self._pipe.poll():
            self._taken_in()

    @property
    def state(self) -> BenchState:
        """What is known of the bench by the last news."""
        return self._news.state

    def taken(self) -> Recording:
        """Return the rows received since the last call."""
        parts, self._parts = self._parts, []
        return joined([Recording(mass_names=self.testbed.mass_names), *parts])

    def begin(self) -> None:
        """Note that the platform is free from now on, and forget the rows before."""
        self._request("begin")
        self._parts = []

    def go(self, targets: Mapping[str, float], speed: float = math.inf) -> None:
        """Send masses to displacements (m), no faster than ``speed`` (m/s): all or none."""
        self._request("go", dict(targets), speed)

    def drive(self, inputs: Mapping[str, float]) -> None:
        """Give devices their inputs: all or none."""
        self._request("drive", dict(inputs))

    def home(self) -> None:
        """Let every board find its position."""
        self._request("home")

    def halt(self, why: Reason | None = None) -> None:
        """Stop every mass; with a reason, masses stay until ``home``."""
        self._request("halt", why)

    def health(self) -> list[Health]:
        """Return how well each device answers."""
        return self._request("health")

    def note(self, kind: str, sentence: str, data: Mapping[str, object]) -> None:
        """Put what happened into the record and the live view."""
        self._request("note", kind, sentence, dict(data))

    def close(self) -> None:
        """Stop every mass and end the keeper."""
        self._pipe.close()
        self._process.join(LEAVING)
        if self._process.is_alive():
            self._process.kill()

    def _request(self, *command: object) -> Any:
        self._requested += 1
        try:
            with whole_message():
                self._pipe.send((self._requested, *command))
        except OSError as error:
            raise BenchStopped(ENDED) from error
        return self._answer()

    def _answer(self, patience: float = ANSWER) -> Any:
        """Wait until the keeper has carried out the command; return or raise its answer.

        What somebody asked who was interrupted before the answer came is nobody's any more.
        """
        while self._pipe.poll(patience):
            answer = self._taken_in()
            if answer is None or answer[0] != self._requested:
                continue
            if isinstance(answer[1], EquipoiseError):
                raise answer[1]
            return answer[1]
        raise BenchStopped(f"the keeper of the bench has not answered for {patience:g} s")

    def _taken_in(self) -> tuple[int, Any] | None:
        """Read a message; keep it if it is news, return it if it is an answer."""
        try:
            with whole_message():
                kind, what = self._pipe.recv()
                if kind == "answer":
                    return what
                if kind == "end":
                    raise what
                self._news = what
                if what.rows is not None:
                    self._parts.append(what.rows)
        except (EOFError, OSError) as error:
            raise BenchStopped(ENDED) from error
        return None
