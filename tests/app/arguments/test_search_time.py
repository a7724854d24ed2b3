"""Seconds of processor time, the compiler's left out; no test here waits for any."""

import pickle
from types import SimpleNamespace

import pytest

from equipoise.app.arguments import search_time
from equipoise.app.arguments.inputs import budget_from
from equipoise.app.arguments.search_time import CompilerTime, budget_of
from equipoise.app.console.terminal import busy, say_what_is_done
from equipoise.estimation.search_budget import Stage
from equipoise.model.errors import InputError


@pytest.fixture
def clock(monkeypatch):
    """A processor that takes as much time as a test says."""
    now, compiler = SimpleNamespace(seconds=100.0), CompilerTime()
    monkeypatch.setattr(search_time.time, "process_time", lambda: now.seconds)
    monkeypatch.setattr(search_time, "compiler_time", lambda: compiler)
    return now, compiler


def test_a_budget_is_spent_after_its_seconds_from_the_first_question_on(clock):
    now, _ = clock
    budget = budget_of(60.0)
    now.seconds = 1000.0
    assert budget.allows(Stage.MOTION)
    now.seconds = 1059.0
    assert budget.allows(Stage.EVENTS)
    now.seconds = 1060.0
    assert not budget.allows(Stage.EVENTS)
    assert budget.renewed().allows(Stage.EVENTS)


def test_the_compiler_spends_no_budget(clock):
    """50 s of 55 were its own: 5 s of 60 are spent."""
    now, compiler = clock
    budget = budget_of(60.0)
    budget.allows(Stage.MOTION)
    compiler.begin()
    now.seconds += 50.0
    compiler.end()
    now.seconds += 59.0
    assert budget.allows(Stage.MOTION)
    now.seconds += 1.0
    assert not budget.allows(Stage.MOTION)


def test_a_budget_goes_to_another_process():
    assert pickle.loads(pickle.dumps(budget_of(60.0))).allows(Stage.MOTION)


@pytest.mark.parametrize("seconds", [0.0, -1.0, float("nan")])
def test_no_search_takes_no_time(seconds):
    with pytest.raises(InputError, match="budget_s"):
        budget_from(seconds)


def test_each_stage_of_a_search_is_shown_once_beside_what_is_done(capsys):
    with busy("identifying"):
        for stage in (Stage.EVENTS, Stage.NOISE, Stage.EVENTS):
            say_what_is_done(stage.value)
    printed = capsys.readouterr().err.splitlines()
    assert printed == [
        "identifying ...",
        "identifying: seeking events ...",
        "identifying: weighing the noise ...",
    ]


def test_nothing_is_shown_when_nobody_waits(capsys):
    say_what_is_done(Stage.EVENTS.value)
    assert capsys.readouterr().err == ""
