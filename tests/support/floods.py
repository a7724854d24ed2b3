"""Floods of a dashboard: silent connections, requests, malformed messages."""

import itertools
import json
import socket
from collections import Counter
from http.client import HTTPConnection
from pathlib import Path

from tests.support.dashboard_program import Dashboard
from tests.support.page_by_hand import ByHand

HALVES = (b"", b"GET / HTTP/1.1\r\nHost: 127.0.0.1", b"GET /static/page.js HTTP/1.1\r\n")
VALUES = (None, True, 0, -1, 2.5, 1e308, 10**30, "", "x", "1e999", "nan", "\x1b[2J", "a\x00",
          "y" * 3000, [], [1, [2]], {}, {"value": 10**9, "label": "x"}, {"detail": 1e308},
          {"detail": None})  # fmt: skip
FRAMES = ("", "42", "42[", "42[]", "42null", '42["event"]', '42["event",null]', '42["event",{}]',
          '42["log",{"level":"error","message":"\\u001b[2J"}]', '42["ack",{}]', "451-[]", "5", "9",
          '42["handshake",{}]', "42" + "[" * 9000, "40/other,", "44", "\x00")  # fmt: skip


def silent(running: Dashboard, count: int) -> list[socket.socket]:
    """Open connections that never finish a request."""
    opened = []
    for half in itertools.islice(itertools.cycle(HALVES), count):
        line = socket.create_connection(("127.0.0.1", running.port), timeout=30)
        line.sendall(half)
        opened.append(line)
    return opened


def is_closed(line: socket.socket) -> bool:
    """Say whether the other end has closed a connection."""
    line.setblocking(False)
    try:
        return line.recv(4096) == b""
    except BlockingIOError:
        return False
    except OSError:
        return True


def requested(running: Dashboard, count: int, path: str = "/") -> Counter[int]:
    """Return how often each status was answered to requests that follow each other at once."""
    line, found = HTTPConnection("127.0.0.1", running.port, timeout=30), Counter[int]()
    for _ in range(count):
        line.request("GET", path)
        answer = line.getresponse()
        answer.read()
        found[answer.status] += 1
    line.close()
    return found


def malformed(page: ByHand, count: int) -> int:
    """Send values of no kind to every element of a page, and frames of no kind; return how many."""
    events = [
        (number, event["listener_id"])
        for number, element in page.elements.items()
        for event in element.get("events", ())
        if event["type"] != "click"
    ]
    sent = 0
    for value, (number, listener) in itertools.product(VALUES, events):
        if sent >= count:
            return sent
        page.event(number, listener, [json.dumps(value)])
        sent += 1
    for frame in FRAMES:
        page.socket.send(frame)
    return sent + len(FRAMES)


def resident(running: Dashboard) -> float:
    """Return the server's memory, MB."""
    status = Path(f"/proc/{running.process.pid}/status").read_text()
    (line,) = (line for line in status.splitlines() if line.startswith("VmRSS"))
    return int(line.split()[1]) / 1000


def open_files(running: Dashboard) -> int:
    """Return how many files and connections the server has open."""
    return len(list(Path(f"/proc/{running.process.pid}/fd").iterdir()))
