"""Requests: sent until confirmed, one by one, deadlines on attended time."""

import pytest

from equipoise.hardware.transport.requests import ONCE, Requests

TURN = 0.05  # s


def run(requests, start, end):
    """Return when each request was sent, by name, from turn to turn."""
    turns = (start + TURN * k for k in range(round((end - start) / TURN)))
    return [(name, round(t, 2)) for t in turns for name in requests.due(t)]


def test_a_request_is_sent_each_second_until_it_is_confirmed():
    requests = Requests(["a", "b"])
    assert run(requests, 0.0, 1.5) == [("a", 0.0), ("b", 0.0), ("a", 1.0), ("b", 1.0)]
    requests.confirmed("a")
    assert run(requests, 1.5, 2.5) == [("b", 2.0)]
    requests.begin()
    assert run(requests, 2.5, 3.0) == [("a", 2.5), ("b", 2.5)]


def test_an_unconfirmed_request_is_reported_with_what_was_observed():
    requests = Requests(["the message"])
    run(requests, 0.0, 1.5)
    assert requests.overdue == ()
    run(requests, 1.5, 2.65)
    (overdue,) = requests.overdue
    assert overdue.sentence == "the message was requested 3 times in 2.6 s and not confirmed"
    requests.refused("VNERR,03")
    assert requests.overdue[0].sentence.endswith("; the answer was VNERR,03")


def test_a_pause_of_the_host_is_no_silence_of_the_device():
    requests = Requests(["a"])
    requests.due(0.0)
    requests.due(10.0)
    assert requests.overdue == ()


def test_one_by_one_the_next_waits_for_an_answer_and_a_refused_one_goes_behind():
    requests = Requests(["a", "b"], one_by_one=True)
    assert run(requests, 0.0, 1.5) == [("a", 0.0), ("a", 1.0)]
    requests.refused("no", "a")
    assert run(requests, 1.5, 1.6) == [("b", 1.5)]
    requests.confirmed("b")
    assert run(requests, 1.6, 2.2) == [("a", 2.0)]


@pytest.mark.parametrize(("again", "sent"), [(1.0, 1), (ONCE, 0)])
def test_a_device_that_was_quiet_for_long_gets_its_requests_anew(again, sent):
    """It may have restarted; not over a line on which twice would be two requests."""
    requests = Requests(["a"], again)
    run(requests, 0.0, 0.5)
    requests.confirmed("a")
    for k in range(10):
        assert run(requests, 0.5 + k, 1.5 + k) == []
        requests.alive()
    assert len(run(requests, 10.5, 14.0)) == sent
