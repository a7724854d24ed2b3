"""Requests to the runner: carried out, kept for later, or refused."""

from multiprocessing.connection import Connection as Pipe
from pathlib import Path
from typing import Any

import numpy as np

from equipoise.app.arguments.inputs import fitting_recording_of
from equipoise.app.arguments.options import WHOLE
from equipoise.app.console.crash_file import crash_of
from equipoise.app.dashboard.protocol import requests
from equipoise.app.dashboard.protocol.data_folder import within
from equipoise.app.dashboard.runner.background_jobs import COMMAND
from equipoise.app.dashboard.runner.benches import replayed, simulated
from equipoise.app.dashboard.runner.runner import Runner
from equipoise.app.runs.balancing import Goal, Limits
from equipoise.app.runs.keeping import EVERY, SAVED
from equipoise.model.errors import EquipoiseError, InputError
from equipoise.model.permission import Permission
from equipoise.model.units import MM
from equipoise.procedure.balancing.motion_budget import USUAL
from equipoise.procedure.balancing.schedule import Schedule

LEAVE = None  # a request of the server alone: a page has no word for it


class Desk:
    """Receives requests from a pipe; the result of each is a note."""

    def __init__(self, runner: Runner, pipe: Pipe, folder: Path, seed: int) -> None:
        self._runner, self._pipe, self._folder, self._seed = runner, pipe, folder, seed
        self._next: requests.Request | None = None  # what is to be done once nothing else is
        runner.handling(self.handle)

    def handle(self, longest: float) -> None:
        """Wait so long (s) at most for a request, and carry out what has come.

        Raises EOFError where the other end of the pipe is closed, or says that it leaves.
        """
        wait = longest
        while self._pipe.poll(wait):
            request = self._pipe.recv()
            if request is LEAVE:
                raise EOFError
            self._deal(request)
            wait = 0.0

    def turn(self) -> None:
        """Begin what has waited for the bench."""
        request, self._next = self._next, None
        if request is not None:
            self._guarded(request, self._begin)

    @property
    def _busy(self) -> bool:
        return self._runner.phase in ("balancing", "held")

    def _deal(self, request: requests.Request) -> None:
        """Carry out at once what needs no free bench; let the rest wait, or refuse it."""
        at_once = (
            requests.Stop | requests.Stand | requests.Mark | requests.Record | requests.Speed
            | requests.Pause
        )  # fmt: skip
        if isinstance(request, at_once):
            self._guarded(request, self._at_once)
        elif self._busy:
            self._runner.say("Balancing is in progress: stop it first.")
        else:
            self._next = request

    def _guarded(self, request: requests.Request, do: Any) -> None:
        try:
            do(requests.sound(request))
        except EquipoiseError as error:
            self._runner.say(str(error))
        except (EOFError, ConnectionError):  # the server is gone: nothing is left to do here
            raise
        except Exception as error:  # a request that fails ends neither runner nor view
            self._runner.say(crash_of(error, COMMAND).sentence)

    def _at_once(self, request: requests.Request) -> None:
        runner = self._runner
        if isinstance(request, requests.Stop):
            self._stop()
        elif isinstance(request, requests.Stand):
            runner.permission = Permission.HOLD if request.on else Permission.FREE
        elif isinstance(request, requests.Mark):
            runner.mark(request.text)
        elif isinstance(request, requests.Record):
            self._record(request.on)
        elif isinstance(request, requests.Speed):
            runner.pace.at(request.factor)
        elif isinstance(request, requests.Pause):
            self._pause(request.on)
        runner.report_state()

    def _stop(self) -> None:
        runner = self._runner
        runner.stop_work()
        if self._busy:
            runner.stopping, runner.phase = True, "balancing"
        else:
            runner.station.bench.stop()
            runner.note = "Every mass was halted."

    def _record(self, on: bool) -> None:
        runner = self._runner
        if on:
            runner.recorder.begin(runner.station.bench)
        else:
            runner.recorder.end()

    def _pause(self, on: bool) -> None:
        runner = self._runner
        if not runner.station.paced:
            raise InputError(
                "hold", "a real bench", "a hand: only a simulated platform can be held here"
            )
        if self._busy:
            runner.phase = "held" if on else "balancing"
        else:
            runner.phase = "paused" if on else "idle"
        runner.note = ""

    def _begin(self, request: requests.Request) -> None:
        runner = self._runner
        if isinstance(request, requests.Balance):
            self._balance(request)
        elif isinstance(request, requests.Identify):
            runner.identify(request.method)
        elif isinstance(request, requests.Jog):
            self._jog(request)
        elif isinstance(request, requests.Anew):
            self._seed = request.seed
            self._show(request)
        elif isinstance(request, requests.Replay | requests.Seek):
            self._show(request)

    def _balance(self, request: requests.Balance) -> None:
        station = self._runner.station
        if station.kind == "replayed":
            raise InputError("balance", "a recording", "a platform: a replay cannot be moved")
        if station.kind == "real" and not request.held:
            raise InputError(
                "the platform", "not confirmed to be held", "a person who holds it level"
            )
        goal = Goal(np.array(request.target), np.array(request.tolerance))
        limits = Limits(
            None, request.max_time, request.keep, request.law, motion=USUAL, every=EVERY,
            schedule=Schedule(lambda: self._runner.permission), report=SAVED,
        )  # fmt: skip
        self._runner.balance(goal, limits)

    def _jog(self, request: requests.Jog) -> None:
        runner = self._runner
        runner.station.bench.move({request.mass: request.displacement})
        reported = f"{request.mass} sent to {request.displacement / MM:.2f} mm by hand"
        runner.mark(reported)
        runner.say("")

    def _show(self, request: requests.Anew | requests.Replay | requests.Seek) -> None:
        """Show another platform, a recording, or another time of it."""
        runner, bed = self._runner, self._runner.station.testbed
        if runner.station.kind == "real":
            raise InputError("another view", "a real bench", "a separate dashboard for it")
        runner.note = ""
        if isinstance(request, requests.Anew) or (
            isinstance(request, requests.Replay) and not request.name
        ):
            runner.show(simulated(bed, self._seed))
        elif isinstance(request, requests.Replay):
            path = within(self._folder, request.name)
            runner.show(replayed(bed, fitting_recording_of(str(path), WHOLE, bed), request.name))
            self._pause(False)
            runner.report_state()
        elif (source := runner.station.source) is not None:
            held = runner.phase
            runner.show(replayed(bed, source, runner.station.title, request.t))
            runner.phase = held
            runner.report_state()
