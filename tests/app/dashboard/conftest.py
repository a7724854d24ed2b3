"""A runner in this process, and all its messages."""

import json
from dataclasses import dataclass, field
from multiprocessing import Pipe
from typing import Any

import numpy as np
import pytest

from equipoise.app.dashboard.protocol import requests
from equipoise.app.dashboard.protocol.frames import HEAD
from equipoise.app.dashboard.runner.benches import simulated
from equipoise.app.dashboard.runner.outbox import Post
from equipoise.app.dashboard.runner.request_handler import Desk
from equipoise.app.dashboard.runner.runner import Runner
from equipoise.io.testbed.presets import read_preset

BALANCE = requests.Balance((0.0, 0.0, -100e-6), (2e-6, 2e-6, 3e-6), "measure_and_move")


def decoded(message):
    """Return bench time and the parts by name of a message of rows."""
    (size,) = HEAD.unpack_from(message)
    header = json.loads(message[HEAD.size : HEAD.size + size])
    values = np.frombuffer(message, "<f8", offset=HEAD.size + size)
    at, found = 0, {}
    for name, rows, columns in header["parts"]:
        found[name] = values[at : at + rows * columns].reshape(rows, columns)
        at += rows * columns
    return header["t"], found


@dataclass
class Reported:
    """Messages of the runner, by kind, and what is to be done at each."""

    about: list[dict] = field(default_factory=list)
    steps: list[dict] = field(default_factory=list)
    states: list[dict] = field(default_factory=list)
    parts: dict[str, list] = field(default_factory=dict)
    when: Any = lambda kind, what: None

    def __call__(self, kind, what):
        if kind == "rows":
            for name, values in decoded(what)[1].items():
                self.parts.setdefault(name, []).append(values)
        elif kind == "about":
            self.about.append(what)
            self.parts, self.steps = {}, []
        else:
            {"step": self.steps, "state": self.states}[kind].append(what)
        self.when(kind, what)

    def rows(self, name):
        return np.vstack(self.parts[name])

    @property
    def state(self):
        return self.states[-1]


class Room:
    """A runner, its desk, and a page's end of the pipe."""

    def __init__(self, station, folder, seed=1):
        self.page, remote = Pipe()
        self.reported, self.folder = Reported(), folder
        self.runner = Runner(station, Post(self.reported), folder, "session")
        self.runner.pace.at(0.0)
        self.desk = Desk(self.runner, remote, folder, seed)

    def request(self, *requests):
        for request in requests:
            self.page.send(request)

    def turn(self, times=1):
        for _ in range(times):
            self.runner.turn()
            self.desk.turn()
        self.runner.post.flush()

    def until(self, there, most=3000):
        for _ in range(most):
            if there():
                return
            self.turn()
        raise AssertionError(f"not within {most} turns: {self.reported.state}")


@pytest.fixture(scope="session")
def nanosat():
    return read_preset("nanosat")


@pytest.fixture
def room(nanosat, tmp_path, monkeypatch):
    """A simulated platform that is let go."""
    monkeypatch.setenv("EQUIPOISE_RUNS", "")
    made = Room(simulated(nanosat, 1), tmp_path)
    made.request(requests.Pause(False))
    made.turn()
    yield made
    made.runner.close()
