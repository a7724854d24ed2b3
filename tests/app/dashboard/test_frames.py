"""What goes to the page byte for byte, and what waits for it."""

import json
import struct

import numpy as np

from equipoise.app.dashboard.protocol.frames import encoded
from equipoise.app.dashboard.runner.outbox import Post
from equipoise.app.dashboard.server.broadcast import BEHIND, GONE, MOST, Watch
from tests.app.dashboard.conftest import decoded


def test_a_frame_byte_for_byte():
    """The head is a multiple of 8 bytes, so that the page reads the numbers where they are."""
    message = encoded(1.5, [("com", np.array([[1.0, 2.0], [3.0, 4.0]])), ("b", np.zeros((0, 3)))])
    (size,) = struct.unpack_from("<I", message)
    head, numbers = message[4 : 4 + size], message[4 + size :]
    assert (4 + size) % 8 == 0
    assert json.loads(head) == {"t": 1.5, "parts": [["com", 2, 2], ["b", 0, 3]]}
    assert struct.unpack("<4d", numbers) == (1.0, 2.0, 3.0, 4.0)


def test_a_frame_comes_back_as_it_was():
    rows = np.array([[0.1, np.nan, -1e-300], [np.inf, 0.2, 7.0]])
    t, parts = decoded(encoded(12.25, [("a", rows), ("b", rows[:1])]))
    assert t == 12.25
    assert parts["a"].tobytes() == rows.tobytes()
    assert parts["b"].tobytes() == rows[:1].tobytes()


def test_rows_are_sent_together_and_before_the_step_that_follows_them():
    reported = []
    post = Post(lambda kind, what: reported.append((kind, what)))
    post.rows(1.0, [("com", np.ones((2, 2)))])
    post.rows(2.0, [("com", 2 * np.ones((1, 2)))])
    post.step({"index": 0})
    assert [kind for kind, _ in reported] == ["rows", "step"]
    t, parts = decoded(reported[0][1])
    assert t == 2.0
    assert parts["com"].tolist() == [[1, 1], [1, 1], [2, 2]]


def test_pending_rows_of_the_previous_view_are_dropped():
    reported = []
    post = Post(lambda kind, what: reported.append(kind))
    post.rows(1.0, [("com", np.ones((2, 2)))])
    post.about({"clock": 2})
    post.flush()
    assert reported == ["about"]


def test_the_state_is_sent_only_when_it_changes():
    reported = []
    post = Post(lambda kind, what: reported.append(what))
    for phase in ("idle", "idle", "balancing"):
        post.state({"phase": phase})
    assert [what["phase"] for what in reported] == ["idle", "balancing"]


# --- What is kept for pages that come later ------------------------------------------------------


def drained(page):
    found = []
    while not page.empty():
        found.append(page.get_nowait())
    return found


def test_who_comes_later_gets_what_is_kept_in_order():
    watch = Watch()
    watch.take("about", {"kind": "about", "clock": 1})
    watch.take("step", {"kind": "step", "index": 0})
    watch.take("rows", b"first")
    watch.take("state", {"kind": "state", "phase": "idle"})
    page = watch.join()
    watch.take("rows", b"second")
    kinds = [json.loads(m)["kind"] if isinstance(m, str) else m for m in drained(page)]
    assert kinds == ["about", "step", "state", b"first", b"second"]


def test_rows_are_kept_up_to_a_size_and_the_oldest_go():
    watch, one = Watch(), bytes(1_000_000)
    for k in range(50):
        watch.take("rows", one + bytes([k]))
    kept = drained(watch.join())
    assert MOST - 1_100_000 < sum(map(len, kept)) <= MOST
    assert kept[-1][-1] == 49
    assert [message[-1] for message in kept] == list(range(50 - len(kept), 50))


def test_another_platform_begins_anew():
    watch = Watch()
    watch.take("rows", bytes(MOST))
    watch.take("step", {"kind": "step", "index": 0})
    watch.take("about", {"kind": "about", "clock": 2})
    assert [json.loads(m)["kind"] for m in drained(watch.join())] == ["about"]
    watch.take("rows", bytes(MOST))  # there is room for it again
    assert len(drained(watch.join())[-1]) == MOST


def test_a_step_sent_again_replaces_the_earlier_one():
    watch = Watch()
    for sentence in ("a", "b"):
        watch.take("step", {"kind": "step", "index": 0, "sentence": sentence})
    assert [json.loads(m)["sentence"] for m in drained(watch.join())] == ["b"]


def test_a_page_that_does_not_keep_up_is_let_go():
    watch = Watch()
    slow = watch.join()
    for _ in range(5 * BEHIND):
        watch.take("state", {"kind": "state"})
    found = drained(slow)
    assert found[-1] == GONE
    assert len(found) < 2 * BEHIND


def test_the_end_of_the_runner_is_reported_to_pages():
    """Nothing is recorded any more; of two reasons the first says why."""
    watch = Watch()
    page = watch.join()
    watch.take("state", {"kind": "state", "recording": "recordings/run.mcap"})
    watch.take("failed", "an error that nobody has foreseen")
    watch.end("over")
    shown = json.loads(drained(page)[-1])
    assert shown["note"] == watch.ended == "an error that nobody has foreseen"
    assert (shown["phase"], shown["recording"]) == ("stopped", None)
