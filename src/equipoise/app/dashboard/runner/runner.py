"""The runner: it has the bench, balances it, shows it, and carries out the page's requests.

One thread. Between two slices of a reading it handles requests (``desk``). A running procedure is a
reading like any other, so that the view goes on and a stop acts at once. It knows no page and no
server; every receiver gets the same.
"""

import time
from collections.abc import Callable
from pathlib import Path

from equipoise.app.console.terminal import COMPILING
from equipoise.app.dashboard.runner.background_jobs import Fit, Job, Keep
from equipoise.app.dashboard.runner.benches import Station, let_go
from equipoise.app.dashboard.runner.display import SLICE, Display
from equipoise.app.dashboard.runner.documents import about, line_document, state_document
from equipoise.app.dashboard.runner.outbox import Post
from equipoise.app.dashboard.runner.recorder import Recorder
from equipoise.app.live.observed_bench import WatchedBench
from equipoise.app.live.pace import Pace
from equipoise.app.runs.balancing import HALTED, Balancing, Goal, Limits, Through, run
from equipoise.app.runs.rehearsal import practised
from equipoise.app.runs.waiting import as_they_come
from equipoise.hardware.bench.real_bench import RealBench
from equipoise.hardware.bench.replayed_bench import RecordingEnded
from equipoise.maths.attitude import tilt
from equipoise.maths.kernels.compile_events import compiler_notices
from equipoise.model.bench import Bench
from equipoise.model.errors import BenchStopped, EquipoiseError
from equipoise.model.permission import Permission
from equipoise.model.recording import Recording, joined
from equipoise.model.step import Step
from equipoise.model.verdict import VerdictOutcome

BY_HAND = f"stopped by hand: {HALTED}"


class Runner:
    """A station, and all that is done with it."""

    def __init__(self, station: Station, post: Post, folder: Path, session: str) -> None:
        self.station, self.post, self.session = station, post, session
        self.recorder, self.pace = Recorder(folder), Pace()
        self.phase, self.note, self.working = "idle", "", ""
        self.goal: Goal | None = None
        self.trip: str | None = None
        self.kept: str | None = None  # folder of the last run that was kept
        self.stopping = False
        self.permission = Permission.FREE  # of the masses while a balance is kept
        self._receive: Callable[[float], None] = lambda _: None
        self._clock, self._steps, self._due = 0, 0, 0.0
        self._jobs: list[Job] = []
        self.show(station)

    def handling(self, receive: Callable[[float], None]) -> None:
        """Set what handles requests between two slices; it waits so long (s) at most for one."""
        self._receive = receive

    # --- What is shown -----------------------------------------------------------------------

    def show(self, station: Station) -> None:
        """Show a station from its beginning; simulated platforms and recordings begin held.

        What is recorded of the one before ends with it.
        """
        ended = self.end_recording()
        self.station = station
        self._clock, self._steps = self._clock + 1, 0
        self._display = Display(station.testbed, self.post, self.recorder, self._report)
        self._watched = WatchedBench(station.bench, self._rows, SLICE, self._between, self._guard)
        self.post.about(about(station, self._clock, self.session))
        self.goal, self.trip, self.kept = None, None, None
        self.phase = "paused" if station.paced else "idle"
        if station.before is not None:
            self._display.shown_only(station.bench.time, station.before)
        self._report(ended) if ended else self.report_state()

    def report_state(self) -> None:
        """Send the state."""
        self.post.state(state_document(
            self.station, self._display.estimate, self.goal, phase=self.phase,
            speed=self.pace.speed, recording=self.recorder.name, trip=self.trip, note=self.note,
            kept=self.kept, working=self.working,
        ))  # fmt: skip

    def say(self, sentence: str) -> None:
        """Send a sentence at once."""
        self.note = sentence
        self.report_state()

    def mark(self, text: str) -> None:
        """Note that something happened now."""
        self._line("mark", self.station.bench.time, text)

    def step(self, step: Step) -> None:
        """Send a step."""
        outcome = None if step.verdict is None else step.verdict.outcome
        self._line(step.kind, step.time, step.sentence, outcome)

    def _line(self, of: str, t: float, sentence: str, outcome: str | None = None) -> None:
        self.post.step(line_document(self._steps, of, t, sentence, outcome))
        self._steps += 1
        self._display.event(t, of, sentence)

    def _report(self, sentence: str) -> None:
        """Say what has ended, where it stays to be read and in the record."""
        self._line("note", self.station.bench.time, sentence)
        self.say(sentence)

    def end_recording(self) -> str:
        """End the recording; return a sentence on it, and none where nothing is recorded."""
        name = self.recorder.name
        try:
            self.recorder.end()
        except EquipoiseError as error:
            return str(error)
        return (
            ""
            if name is None
            else f"{name}: the recording ended, since another source is shown now."
        )

    # --- Time passes -------------------------------------------------------------------------

    def turn(self) -> None:
        """Handle requests and let a slice of time pass."""
        if self.phase == "paused":
            self._idle(SLICE)
            return
        try:
            self._watched.read(SLICE)
        except RecordingEnded:
            self.phase, self.note = "paused", "The recording has ended."
        except BenchStopped as stopped:
            self.trip = self.note = str(stopped)

    def _between(self) -> None:
        """Handle requests until the next slice is due; a stop ends the reading."""
        while (left := self._due - time.monotonic()) > 0:
            self._idle(left)
        self._idle(0.0)
        while self.phase == "held":
            self._idle(SLICE)
        if self.stopping:
            self.stopping = False
            self.station.bench.stop()
            raise BenchStopped(BY_HAND)

    def _idle(self, longest: float) -> None:
        """Handle requests, for so long (s) at most, and send what is due."""
        self._receive(longest)
        self._work()
        if self.post.turn():
            self.report_state()

    def _rows(self, rows: Recording) -> None:
        self._display.rows(self.station.bench.time, rows)

    def _guard(self, rows: Recording) -> None:
        """Let a simulated bench and a replay wait for their time, and catch what falls.

        Comes before all that is shown, and depends on nothing of it.
        """
        if self.station.paced:
            self._due = time.monotonic() + self.pace.wait(SLICE)
            self._catch(rows)

    def _catch(self, rows: Recording) -> None:
        """Hold a simulated platform that falls while nothing is done with it."""
        idle, bed = self.phase == "idle", self.station.testbed
        if not idle or self.station.kind != "simulated" or rows.attitude is None:
            return
        if not tilt(rows.attitude.values[-1], bed.up) <= bed.tilt_at_stop:  # nor what is no number
            self.phase = "paused"
            self.note = "The platform was caught at its tilt limit."

    # --- What is done ------------------------------------------------------------------------

    def balance(self, goal: Goal, limits: Limits) -> None:
        """Balance, and have the report written by a background job; a stop is the last step."""
        self.phase, self.goal, self.trip, self.kept, self.note = "balancing", goal, None, None, ""
        self.report_state()
        try:
            with compiler_notices(lambda: self.say(f"{COMPILING} ..."), lambda: self.say("")):
                done = self._balanced(goal, limits)
        except EquipoiseError as error:
            self.note = str(error)
        else:
            self.note = done.verdict.sentence
            self.trip = self.note if done.verdict.outcome is VerdictOutcome.HALTED else None
            self._begin(Job(Keep(done)), "writing the report")
        self.phase, self.stopping = "idle", False
        self.report_state()

    def _balanced(self, goal: Goal, limits: Limits) -> Balancing:
        """Balance; a real platform after a practice in simulation, once its masses are home."""
        bench = self.station.bench
        if isinstance(bench, RealBench):
            self.say("Practice on a simulated platform ...")
            practised(bench.testbed, goal, limits)
            let_go(bench, self.say)
        return run(bench, goal, limits, self.step, Through(self._replayed, as_they_come))

    def identify(self, method: str) -> None:
        """Identify from the recent rows, as a background job; a note where there are none."""
        if not self._display.observed:
            self.say("Nothing has been recorded yet.")
            return
        task = Fit(joined(self._display.observed), self.station.testbed, method)
        self._begin(Job(task), f"identifying ({method})")

    def stop_work(self) -> None:
        """End the background jobs."""
        for job in self._jobs:
            job.end()
        self._jobs, self.working = [], ""

    def close(self) -> None:
        """End recordings and background jobs."""
        self.stop_work()
        self.end_recording()

    def _replayed(self, bench: Bench) -> Bench:
        """Return the bench as a procedure gets it: shown, and stopped by requests."""
        assert bench is self.station.bench
        return self._watched

    def _begin(self, job: Job, what: str) -> None:
        self._jobs.append(job)
        self.working = what
        self.report_state()

    def _work(self) -> None:
        """Send what the background jobs have reported."""
        for job in self._jobs:
            for kind, what in job.news():
                self._received_of(job, kind, what)
        self._jobs = [job for job in self._jobs if not job.over]
        if not self._jobs:
            self.working = ""

    def _received_of(self, job: Job, kind: str, what: object) -> None:
        if isinstance(what, Step):
            self.step(what)
            return
        job.end()
        if kind == "kept":
            self.kept = None if what is None else str(what)
        else:
            self.note = str(what)
