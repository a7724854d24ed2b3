"""What a page may send as a request's values: nothing beside the schema gets to the runner."""

import dataclasses
import itertools
import math

import pytest

from equipoise.app.dashboard.protocol import requests
from equipoise.app.dashboard.protocol.requests import FASTEST, KINDS, LENGTH, LETTERS, sound
from equipoise.app.dashboard.server.authorisation import Guard
from equipoise.app.dashboard.server.broadcast import Watch
from equipoise.app.dashboard.server.request_queue import OBSERVER, Counter
from equipoise.model.errors import InputError

TOKEN, PAGE = "the-token", "a"
RIGHT = {
    "Balance": requests.Balance((0.0, 0.0, -1e-4), (2e-6, 2e-6, 3e-6), "measure_and_move"),
    "Stand": requests.Stand(True),
    "Identify": requests.Identify("auto"),
    "Stop": requests.Stop(),
    "Jog": requests.Jog("x", 0.003),
    "Mark": requests.Mark("a door was opened"),
    "Record": requests.Record(True),
    "Pause": requests.Pause(False),
    "Speed": requests.Speed(20.0),
    "Anew": requests.Anew(2),
    "Replay": requests.Replay(""),
    "Seek": requests.Seek(3.5),
}
# Of no kind that any field takes.
NEVER = (None, {}, {"a": 1}, [], [1.0], object(), b"x", 1j, 1e308, -1e308, math.nan, math.inf,
         10**400, -(10**5000), "a\x00b", "\x1b[31m", "a\nb", "\u202eabc", "a\u200bb", "\ufeffa",
         "\ud800", "x" * 70_000)  # fmt: skip


class Sent(list):
    """What got to the runner."""

    __call__ = list.append


@pytest.fixture
def counter(nanosat, tmp_path):
    made = Counter(nanosat, tmp_path, ("measure_and_move",), ("trajectory",), Watch(),
                   Guard(TOKEN), Sent())  # fmt: skip
    made.guard.take(PAGE, TOKEN)
    return made


def fields_of(kind):
    return [field.name for field in dataclasses.fields(kind)]


def test_every_kind_of_request_is_known_here():
    assert {kind.__name__ for kind in KINDS} == RIGHT.keys()


@pytest.mark.parametrize("request_", RIGHT.values(), ids=RIGHT)
def test_a_right_request_gets_to_the_runner_as_it_is(counter, request_):
    assert counter.request(PAGE, request_) == ""
    assert counter.send == [request_]


FIELDS = [(kind, name) for kind in KINDS for name in fields_of(kind)]


@pytest.mark.parametrize(("kind", "name"), FIELDS, ids=[f"{k.__name__}-{n}" for k, n in FIELDS])
def test_a_value_of_no_kind_is_refused_in_one_line(counter, kind, name):
    for value in NEVER:
        if kind is requests.Balance and name == "max_time" and value is None:
            continue  # the law's own time
        wrong = dataclasses.replace(RIGHT[kind.__name__], **{name: value})
        refused = counter.request(PAGE, wrong)
        assert kind.__name__.lower() in refused
        assert "wanted" in refused
        assert refused.isprintable()
        assert len(refused) < 200
    assert counter.send == []


def test_what_is_no_request_is_refused(counter):
    for value in (None, "Stop", 3, {"kind": "Stop"}, requests.Stop, object()):
        assert "request: found" in counter.request(PAGE, value)
    assert counter.send == []


BEYOND = (
    requests.Jog("x", math.nextafter(LENGTH, 1e9)), requests.Speed(math.nextafter(FASTEST, 200)),
    requests.Speed(-1e-9), requests.Anew(-1), requests.Anew(2**63), requests.Anew(True),
    requests.Anew(2.0), requests.Record(1), requests.Mark("a" * (LETTERS + 1)),
    requests.Balance((0.0, 0.0), (1.0, 1.0, 1.0), "measure_and_move"),
    requests.Balance((0.0, 0.0, 0.0), (1.0, 0.0, 1.0), "measure_and_move"),
    requests.Balance((0.0, 0.0, 0.0, 0.0), (1.0, 1.0, 1.0), "measure_and_move"),
)  # fmt: skip


@pytest.mark.parametrize("request_", BEYOND, ids=map(str, range(len(BEYOND))))
def test_just_beyond_a_range(request_):
    with pytest.raises(InputError, match="wanted"):
        sound(request_)


WITHIN = (
    requests.Jog("x", LENGTH), requests.Speed(0.0), requests.Speed(FASTEST), requests.Speed(1),
    requests.Anew(0), requests.Anew(2**63 - 1), requests.Mark("a" * LETTERS), requests.Seek(-3.0),
    requests.Mark("Tür auf, 3 µm"),
)  # fmt: skip


@pytest.mark.parametrize("request_", WITHIN, ids=map(str, range(len(WITHIN))))
def test_just_within_a_range(request_):
    assert sound(request_) == request_


UNKNOWN = (
    dataclasses.replace(RIGHT["Balance"], law="no_such_law"), requests.Identify("no_such_method"),
    requests.Jog("no_such_mass", 0.001), requests.Replay("../secret.csv"),
    requests.Replay("/etc/passwd"), requests.Replay("recordings/none.mcap"),
)  # fmt: skip


@pytest.mark.parametrize("request_", UNKNOWN, ids=map(str, range(len(UNKNOWN))))
def test_names_that_the_page_does_not_list_are_refused(counter, request_):
    assert "one that this page lists" in counter.request(PAGE, request_)
    assert counter.send == []


def test_a_recording_of_the_folder_is_known(counter):
    (counter.folder / "recordings").mkdir()
    (counter.folder / "recordings" / "a.mcap").write_text("")
    assert counter.request(PAGE, requests.Replay("recordings/a.mcap")) == ""


def test_an_observer_is_refused_before_anything_is_read(counter):
    for request, value in itertools.product(RIGHT.values(), (1, None)):
        assert counter.request("b", request if value else None) == OBSERVER
    assert counter.send == []
