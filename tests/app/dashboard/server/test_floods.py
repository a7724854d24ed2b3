"""Floods of a real server: the page that is open stays so, and what was taken is given back.

``verification/floods.py`` measures the same with more of each.
"""

import json
import time
from http.client import HTTPConnection
from urllib.request import urlopen

import pytest
from websockets.sync.client import connect

from tests.support.dashboard_program import dashboard
from tests.support.floods import (
    is_closed,
    malformed,
    open_files,
    requested,
    resident,
    silent,
)
from tests.support.page_by_hand import opened

PATIENCE = 60.0  # s
GROWN = 1.2  # of memory


@pytest.fixture(scope="module")
def running(tmp_path_factory):
    with dashboard(tmp_path_factory.mktemp("flooded"), "nanosat") as there:
        yield there


@pytest.fixture
def live(running):
    """The rows of a page that is open all the time."""
    own = f"127.0.0.1:{running.port}"
    with connect(f"ws://{own}/live", origin=f"http://{own}", open_timeout=PATIENCE) as socket:
        json.loads(socket.recv(PATIENCE))
        yield socket
        socket.ping().wait(PATIENCE)
        assert socket.close_code is None


def until(there):
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        if there():
            return
        time.sleep(0.2)
    raise AssertionError("not in time")


def test_what_only_fetches_the_page_gets_it_empty(running):
    """Its elements are made once its socket is there: until then it costs little."""
    with urlopen(running.url, timeout=PATIENCE) as answer:
        html = answer.read().decode()
    assert "Start balancing" not in html
    assert "page.js" in html


def test_silent_connections_give_way_and_are_closed(running, live):
    before = open_files(running)
    lines = silent(running, 600)
    assert requested(running, 3, "/static/page.js") == {200: 3}  # amid them
    assert open_files(running) <= before + 250
    until(lambda: all(map(is_closed, lines)))
    until(lambda: open_files(running) <= before + 2)
    for line in lines:
        line.close()


def test_requests_for_pages_are_limited_and_leave_nothing(running, live):
    requested(running, 5)
    before = resident(running)
    found = requested(running, 300)
    assert set(found) == {200, 429}
    assert found[200] < 60
    assert resident(running) < GROWN * before
    until(lambda: requested(running, 1) == {200: 1})


def test_a_kept_connection_is_closed_in_time(running):
    line = HTTPConnection("127.0.0.1", running.port, timeout=PATIENCE)
    line.request("GET", "/static/page.js")
    line.getresponse().read()
    assert line.sock.recv(1) == b""
    line.close()


def test_malformed_messages_of_a_commander_end_nothing(running, live):
    """To each element each value; that no fault was printed is seen where the program ends."""
    for _ in range(4):
        until(lambda: requested(running, 1) != {429: 1})
        with opened(running.url, running.port) as page:
            page.commands(running.token)
            assert malformed(page, 230) >= 230
            page.read(0.3)
            for name in ("Start balancing", "Mark", "Move x", "Another simulated platform"):
                page.does(page.named(name), "click")
            page.releases()
            assert any("wanted" in note for note in page.notes)


REFUSED = (
    ("Seed", {"a": 1}, None, "number: found a value of kind dict"),
    ("Speed", 1e308, None, "choice: found 1e+308"),
    ("Token", ["x"], None, "text: found a value of kind list"),
    ("x in mm", "1e300", "Move x", "jog, displacement: found"),
    ("What happened", "\x1b[2J", "Mark", "mark: found '\\x1b[2J'"),
    ("Seed", 1e300, "Another simulated platform", "anew: found a number of"),
)


def test_what_a_commander_may_not_have_is_refused_in_a_sentence(running, live):
    with opened(running.url, running.port) as page:
        page.commands(running.token)
        for name, value, button, sentence in REFUSED:
            page.does(page.named(name), "update:modelValue", value)
            if button:
                page.does(page.named(button), "click")
            page.until(lambda words=sentence: any(note.startswith(words) for note in page.notes))
        page.does(page.named("Time of the recording"), "seek", {"detail": 1e308})
        page.until(lambda: any(note.startswith("seek: found 1e+308") for note in page.notes))
        page.does(page.named("View"), "themed", {"detail": 1e308})
        page.does(page.named("What happened"), "update:modelValue", "a door")
        page.does(page.named("Mark"), "click")
        while "a door" not in str(live.recv(PATIENCE)):
            pass  # the runner lives, and marks it
        page.releases()
