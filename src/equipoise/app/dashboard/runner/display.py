"""All that is made of a bench's rows for people: the recording, the estimate, the charts.

Each is made alone: one that fails ends, with a sentence on the page and in the record, and the
others go on. No guard is among them.
"""

from collections.abc import Callable, Mapping
from contextlib import suppress
from typing import Any, Protocol

from equipoise.app.dashboard.runner.chart_rows import parts_of
from equipoise.app.dashboard.runner.documents import estimated
from equipoise.app.dashboard.runner.outbox import Post
from equipoise.app.dashboard.runner.recorder import Recorder
from equipoise.app.live.live_estimate import LiveEstimate, grown
from equipoise.estimation.tracker.tracker import Track
from equipoise.hardware.bench.onlookers import Onlookers, why_lost
from equipoise.model.errors import EquipoiseError
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed

SLICE = 0.1  # s of the bench, chosen: as often as a person can follow numbers
REMEMBERED = 1200.0  # s, chosen: what an identification takes in at most
RECORDING = "the recording"


class OfRows(Protocol):
    """What is made of rows."""

    def __call__(self, t: float, rows: Recording) -> None:
        """Take rows up to bench time t (s)."""
        ...


class Display:
    """What is shown of one station; ``report`` takes a sentence on what has ended."""

    def __init__(
        self, testbed: Testbed, post: Post, recorder: Recorder, report: Callable[[str], None]
    ) -> None:
        self.observed: list[Recording] = []
        self.estimate: Mapping[str, Any] | None = None  # as a document
        self._testbed, self._post, self._report = testbed, post, report
        self._recorder, self._posterior = recorder, LiveEstimate(testbed)
        self._track: Track | None = None  # along the newest rows
        self._failed = False  # the estimate did, once or more
        self._all = Onlookers[OfRows](self._lost)
        self._all.add(RECORDING, recorder.rows)
        self._all.add("the memory of rows", self._remember)
        self._all.add("the live estimate", self._estimate)
        self._all.add("the charts", self._draw)

    def rows(self, t: float, rows: Recording) -> None:
        """Show rows up to bench time t (s)."""
        self._all.hand_on(lambda each: each(t, rows))

    def shown_only(self, t: float, rows: Recording) -> None:
        """Show rows that were recorded before: they are neither recorded nor remembered."""
        for each in ("the live estimate", "the charts"):
            self._all.hand_on(lambda onlooker: onlooker(t, rows), to=each)

    def event(self, t: float, kind: str, sentence: str) -> None:
        """Put what happened at bench time t (s) into the recording, if there is one."""
        self._all.hand_on(lambda _: self._recorder.event(t, kind, sentence), to=RECORDING)

    def _remember(self, t: float, rows: Recording) -> None:
        self.observed.append(rows)
        del self.observed[: -int(REMEMBERED / SLICE)]

    def _estimate(self, t: float, rows: Recording) -> None:
        """Let the estimate grow; one that fails restarts."""
        try:
            self._posterior, self._track = grown(self._posterior, rows)
            self.estimate = estimated(self._posterior)
        except Exception as error:
            self._posterior, self._track = LiveEstimate(self._testbed), None
            failed, self._failed = self._failed, True
            if not failed:
                self._report(f"The live estimate restarts: {error}")

    def _draw(self, t: float, rows: Recording) -> None:
        self._post.rows(t, parts_of(rows, self._testbed, self._posterior, self._track))

    def _lost(self, name: str, error: Exception) -> None:
        """Say what has ended; another recording may be begun."""
        if name == RECORDING:
            with suppress(EquipoiseError, OSError):
                self._recorder.end()
            self._all.add(RECORDING, self._recorder.rows)
        self._report(why_lost(name, error))
