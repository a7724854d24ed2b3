"""Messages of the runner: rows, steps and its state, gathered and sent a few times a second."""

import time
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from equipoise.app.dashboard.protocol.frames import Part, encoded
from equipoise.model.arrays import Floats

Send = Callable[[str, Any], None]  # kind: "about", "step", "state" or "rows"; what
EVERY = 1 / 15  # s, chosen: as often as the page draws


class Post:
    """Rows are gathered by series; ``turn`` sends what has come together when it is time to."""

    def __init__(self, send: Send) -> None:
        self._send, self._waiting, self._t = send, dict[str, list[Floats]](), 0.0
        self._due = -np.inf
        self._state: Mapping[str, Any] = {}

    def about(self, document: Mapping[str, Any]) -> None:
        """Send what is shown from now on; pending rows belong to the previous view."""
        self._waiting = {}
        self._send("about", document)

    def step(self, document: Mapping[str, Any]) -> None:
        """Send a step, after the rows before it."""
        self.flush()
        self._send("step", document)

    def rows(self, t: float, parts: list[Part]) -> None:
        """Take rows up to bench time t (s); ValueError where a series changes its columns."""
        self._t = t
        for name, values in parts:
            waiting = self._waiting.setdefault(name, [])
            if waiting and waiting[0].shape[1:] != values.shape[1:]:
                raise ValueError(f"series {name}: {waiting[0].shape[1:]}, then {values.shape[1:]}")
            waiting.append(values)

    def state(self, document: Mapping[str, Any]) -> None:
        """Send the state of the runner, if it is new."""
        if document != self._state:
            self._state = document
            self._send("state", document)

    def turn(self) -> bool:
        """Send the rows if it is time to; say whether it was."""
        now = time.monotonic()
        if now < self._due:
            return False
        self._due = now + EVERY
        self.flush()
        return True

    def flush(self) -> None:
        """Send the rows that wait."""
        if self._waiting:
            parts = [(name, np.vstack(values)) for name, values in self._waiting.items()]
            self._waiting = {}
            self._send("rows", encoded(self._t, parts))
