"""rosbridge: messages by hand, what is no row, subscriptions, and a real WebSocket."""

import copy
import json
import math
import time
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from equipoise.hardware.bench.open_port import open_port
from equipoise.hardware.emulated.counterpart import counterpart
from equipoise.hardware.emulated.rosbridge import EmulatedRosBridge
from equipoise.hardware.sensors.rosbridge import RosBridge
from equipoise.hardware.transport.port import PortLost
from equipoise.model.errors import InputError
from equipoise.model.hardware import Port
from equipoise.model.reading import Reading
from tests.support import thorough
from tests.support.sensor_units import unit

POSE = "geometry_msgs/msg/PoseStamped"


def vector(x, y, z):
    return {"x": x, "y": y, "z": z}


def header(sec=1700000000, nanosec=250000000):
    return {"stamp": {"sec": sec, "nanosec": nanosec}, "frame_id": "imu_link"}


def imu(turn=(0.5, -0.5, 0.5, 0.5), turn_cov=0.0, rate_cov=0.0, **stamp):
    """Return sensor_msgs/Imu as rosbridge writes it; ``turn`` is x y z w."""
    return {
        "header": header(**stamp),
        "orientation": vector(*turn[:3]) | {"w": turn[3]},
        "orientation_covariance": [turn_cov, 0, 0, 0, 4 * turn_cov, 0, 0, 0, 4 * turn_cov],
        "angular_velocity": vector(0.25, -0.5, 2),
        "angular_velocity_covariance": [rate_cov, 0, 0, 0, rate_cov, 0, 0, 0, rate_cov],
        "linear_acceleration": vector(0, 0, 9.8),
        "linear_acceleration_covariance": [0] * 9,
    }


def published(message, topic="/imu"):
    return json.dumps({"op": "publish", "topic": topic, "msg": message}).encode()


def test_a_message_by_hand_is_understood():
    driver = RosBridge(unit("rosbridge"))
    attitude, rate = driver.feed(published(imu(turn_cov=1e-4)))
    assert attitude.values == (0.5, 0.5, -0.5, 0.5)
    assert attitude.stamp == 1700000000.25
    assert rate == Reading("rate", (0.25, -0.5, 2.0), 1700000000.25)
    assert driver.counts.good == 1


def test_a_covariance_of_minus_one_says_that_there_is_none():
    driver = RosBridge(unit("rosbridge"))
    (rate,) = driver.feed(published(imu(turn=(0, 0, 0, 0), turn_cov=-1.0)))
    assert rate.channel == "rate"
    (attitude,) = driver.feed(published(imu(rate_cov=-1.0)))
    assert attitude.channel == "attitude"
    assert driver.feed(published(imu(turn_cov=-1.0, rate_cov=-1.0))) == []
    assert (driver.counts.good, driver.counts.foreign, driver.counts.corrupt) == (2, 1, 0)


def test_a_time_that_was_never_filled_in_is_none():
    attitude, _ = RosBridge(unit("rosbridge")).feed(published(imu(sec=0, nanosec=0)))
    assert attitude.stamp is None


def two_topics():
    return unit("rosbridge", topic_attitude="/mocap/pose", type_attitude=POSE, topic_rate="/imu")


def test_attitude_and_rate_may_come_from_two_topics():
    driver = RosBridge(two_topics())
    requested = [json.loads(line) for line in driver.due(0.0).splitlines()]
    assert requested == [
        {"op": "subscribe", "id": "/mocap/pose", "topic": "/mocap/pose", "type": POSE},
        {"op": "subscribe", "id": "/imu", "topic": "/imu", "type": "sensor_msgs/msg/Imu"},
    ]
    assert driver.due(0.1) == b""
    pose = {"position": vector(1, 2, 3), "orientation": vector(0, 0, 1) | {"w": 0}}
    (attitude,) = driver.feed(published({"header": header(), "pose": pose}, "/mocap/pose"))
    assert attitude == Reading("attitude", (0.0, 0.0, 0.0, 1.0), 1700000000.25)
    (rate,) = driver.feed(published(imu()))
    assert rate.channel == "rate"
    driver.opened()
    assert len(driver.due(1.0).splitlines()) == 2


def test_a_topic_is_subscribed_to_until_it_comes_and_an_error_is_reported():
    driver = RosBridge(two_topics())
    for k in range(60):
        driver.due(0.05 * k)
        driver.feed(published(imu()))
    error = {"op": "status", "level": "error", "id": "/mocap/pose", "msg": "no such type"}
    driver.feed(json.dumps(error).encode())
    (overdue,) = driver.requests.overdue
    assert (overdue.what, overdue.times, overdue.answer) == ("/mocap/pose", 3, "no such type")
    driver.feed(json.dumps(error | {"id": ["?"]}).encode())
    assert driver.counts.corrupt == 0


def test_what_is_no_row_is_counted():
    driver = RosBridge(unit("rosbridge"))
    others = [{"op": "status", "level": "error", "msg": "no topic"}, [1], 3, None,
              {"op": "fragment", "id": "0", "data": "{", "num": 0, "total": 2}]  # fmt: skip
    for other in others:
        assert driver.feed(json.dumps(other).encode()) == []
    assert driver.feed(published(imu(), "/other")) == []
    assert driver.counts.foreign == len(others) + 1
    empty = imu()
    empty["orientation_covariance"] = [0, 0]
    broken = [imu(turn=(1, 1, 0, 0)), imu(turn=(None, 0, 0, 1)), imu(turn=(math.nan, 0, 0, 1)),
              imu(turn=(True, 0, 0, 0)), imu(turn=("1", 0, 0, 0)), {}, [], "x", empty]  # fmt: skip
    for bad in broken:
        assert driver.feed(published(bad)) == []
    assert driver.feed(published(imu())[:-1]) == []
    assert driver.feed(b"[" * 100_000) == []
    assert driver.counts.corrupt == len(broken) + 2


ANY_JSON = st.recursive(
    st.none() | st.booleans() | st.floats() | st.integers() | st.text(max_size=3),
    lambda inner: st.lists(inner, max_size=9) | st.dictionaries(st.sampled_from("wxyz"), inner),
    max_leaves=9,
)


def places(reported, path=()):
    """Return the paths to everything in a message."""
    found = [path]
    inner = reported.items() if isinstance(reported, dict) else enumerate(reported)
    for key, value in inner if isinstance(reported, (dict, list)) else ():
        found += places(value, (*path, key)) if isinstance(value, (dict, list)) else [(*path, key)]
    return found


WHOLE = json.loads(published(imu()))


@settings(max_examples=thorough.count(200, 60), deadline=None)
@given(st.sampled_from(places(WHOLE)[1:]), ANY_JSON)
def test_anything_in_the_place_of_anything_raises_nothing(path, value):
    reported = copy.deepcopy(WHOLE)
    at = reported
    for key in path[:-1]:
        at = at[key]
    at[path[-1]] = value
    for reading in RosBridge(unit("rosbridge")).feed(json.dumps(reported).encode()):
        assert np.all(np.isfinite(reading.values))


@pytest.mark.parametrize(
    ("reported", "said"),
    [
        ({"topic_attitude": "/imu"}, "'rate'; wanted a setting topic_"),
        ({"topic_attitude": "/a", "topic_rate": "/a", "type_attitude": POSE}, "two topics"),
        ({"topic_attitude": "/a", "topic_rate": "/b", "type_attitude": "Imu"}, "sensor_msgs"),
        ({"topic": "/a"}, "'topic'"),
    ],
)
def test_a_declaration_that_cannot_be_is_named(reported, said):
    with pytest.raises(InputError, match=said):
        RosBridge(unit("rosbridge", **reported))


# --- A real WebSocket ------------------------------------------------------------------------


def until(take, patience=2.0):
    """Return what ``take`` gives first; nothing after two seconds."""
    end = time.monotonic() + patience
    while not (found := take()) and time.monotonic() < end:
        time.sleep(1e-3)
    return found


@pytest.fixture
def socket():
    remote = counterpart(Port("ws://ros:9090/bridge"))
    near = open_port(Port(remote.address))
    yield near, remote
    near.close()
    remote.close()


def test_messages_arrive_whole_both_ways(socket):
    """A message of 200 kB is still one; two lines that are sent are two messages."""
    near, remote = socket
    assert remote.address.endswith("/bridge")
    big = json.dumps({"name": "ä" * 100_000}, ensure_ascii=False).encode()
    remote.send(big)
    remote.send(b"second")
    found = []
    assert until(lambda: found.extend(near.receive()) or len(found) == 2)
    assert found == [big, b"second"]
    near.send(b'{"a": 1}\n{"b": 2}\n')
    received = []
    assert until(lambda: received.extend(remote.receive().splitlines()) or len(received) == 2)
    assert received == [b'{"a": 1}', b'{"b": 2}']


def test_a_listener_who_takes_nothing_keeps_nobody_waiting(socket):
    """40 MB to one who takes nothing yet: who sends returns, what is too much is left out whole."""
    near, remote = socket
    for _ in range(400):
        remote.send(b"x" * 100_000)  # would never return if it waited for the other end
    found = []
    while until(lambda: (remote.receive(), found.extend(fresh := near.receive()), fresh)[-1], 0.2):
        pass
    assert 10 < len(found) < 400
    assert set(found) == {b"x" * 100_000}
    remote.send(b"last")
    assert until(near.receive) == [b"last"]


def test_a_server_that_goes_is_a_port_that_is_lost(socket):
    near, remote = socket
    remote.close()
    with pytest.raises(PortLost):
        until(lambda: near.receive() and False)


def test_the_newest_listener_counts(socket):
    _, remote = socket
    other = open_port(Port(remote.address))
    remote.send(b"hello")
    assert until(other.receive) == [b"hello"]
    other.close()


def test_topics_without_subscription_are_not_sent():
    device = replace(two_topics(), gives=("rate",))
    remote = EmulatedRosBridge(device)
    status = json.loads(remote.take(b'{"op": "subscribe", "topic": "/x", "type": "y"}\n', 0.0))
    assert status["op"] == "status"
    assert remote.take(RosBridge(device).due(0.0), 0.0) == b""
