"""Whoever connects sees the rows of the bench, and cannot do anything to it."""

import base64
import json
import socket
import struct
import time
from contextlib import suppress

import numpy as np
import pytest
from websockets.exceptions import InvalidStatus
from websockets.sync.client import connect

from equipoise.io.mcap.foxglove_server import LAYOUT, LiveView, drawn_address
from equipoise.io.stream.gravity_message import message_of
from equipoise.io.testbed.presets import read_preset
from equipoise.model.errors import InputError
from equipoise.model.gravity_torque import GravityTorque, TorqueStatus
from equipoise.model.recording import Recording, Samples
from tests.support.protobuf_by_schema import decoded

PROTOCOL = "foxglove.sdk.v1"
ZERO = 1_750_000_000_000_000_000
PATIENCE = 5.0  # s


def rows(t: float) -> Recording:
    at = np.array([t])
    return Recording(Samples(at, np.array([[1.0, 0, 0, 0]])), Samples(at, np.array([[0.1, 0, -2]])))


def test_a_client_receives_rows_with_their_times():
    """Public protocol: channels are advertised as JSON; a message is 01, subscription (4), time
    (8), the payload."""
    with LiveView(ZERO, port=0) as view:
        view.rows(rows(0.0))  # opens the topics
        with connect(view.address, subprotocols=[PROTOCOL]) as client:
            assert client.subprotocol == PROTOCOL
            offered = {}
            while "/rate" not in offered:
                reported = json.loads(client.recv(PATIENCE))
                offered |= {c["topic"]: c for c in reported.get("channels", [])}
            assert offered["/attitude"]["schemaName"] == "foxglove.FrameTransform"
            assert "clientPublish" not in reported.get("capabilities", [])
            wanted = {"id": 7, "channelId": offered["/rate"]["id"]}
            client.send(json.dumps({"op": "subscribe", "subscriptions": [wanted]}))
            until = time.monotonic() + PATIENCE
            observed = b""
            while not observed and time.monotonic() < until:
                view.rows(rows(0.25))
                try:
                    message = client.recv(0.05)
                except TimeoutError:
                    continue
                observed = message if isinstance(message, bytes) and message[0] == 1 else b""
    kind, subscription, ns = struct.unpack_from("<BIQ", observed)
    assert (kind, subscription, ns) == (1, 7, ZERO + 250_000_000)
    assert json.loads(observed[13:]) == {
        "timestamp": {"sec": ZERO // 10**9, "nsec": 250_000_000},
        "x_rad_s": 0.1, "y_rad_s": 0.0, "z_rad_s": -2.0,
    }  # fmt: skip


def offered_by(client, *wanted):
    """Return the channels that are advertised, once the wanted ones are."""
    offered = {}
    while not set(wanted) <= offered.keys():
        reported = json.loads(client.recv(PATIENCE))
        offered |= {c["topic"]: c for c in reported.get("channels", [])}
    return offered


def test_every_topic_of_a_bench_is_offered_before_its_first_row():
    """Attitude, rate and masses of the testbed, by name; events, log and scene of any."""
    bed = read_preset("nanosat")
    with (
        LiveView(ZERO, bed, port=0) as view,
        connect(view.address, subprotocols=[PROTOCOL]) as client,
    ):
        topics = ("/attitude", "/rate", "/masses", "/events", "/log", "/scene")
        offered = offered_by(client, *topics)
    assert offered["/scene"]["schemaName"] == "foxglove.SceneUpdate"
    parts = json.loads(offered["/masses"]["schema"])["properties"]
    assert parts.keys() == {"timestamp", "x_m", "y_m", "z_m"}


def test_who_comes_late_is_shown_the_scene():
    """It was sent before anybody was there, and nothing has changed since."""
    with LiveView(ZERO, read_preset("nanosat"), port=0) as view:
        view.rows(rows(0.0))
        with connect(view.address, subprotocols=[PROTOCOL]) as client:
            scene = offered_by(client, "/scene")["/scene"]
            wanted = {"id": 3, "channelId": scene["id"]}
            client.send(json.dumps({"op": "subscribe", "subscriptions": [wanted]}))
            until = time.monotonic() + PATIENCE
            shown = []
            while not shown and time.monotonic() < until:
                view.turn(2.5)
                with suppress(TimeoutError):
                    message = client.recv(0.02)
                    shown += [message] if isinstance(message, bytes) and message[0] == 1 else []
            for k in range(20):  # and is not shown it over and over
                view.turn(2.5 + k)
            with pytest.raises(TimeoutError):
                client.recv(0.2)
    assert struct.unpack_from("<BIQ", shown[0]) == (1, 3, ZERO + 2_500_000_000)
    update = decoded(base64.b64decode(scene["schema"]), "foxglove.SceneUpdate", shown[0][13:])
    names = {entity["id"] for entity in update["entities"]}
    assert names == {"platform", "masses", "centre of mass", "gravity"}


FOREIGN = ("http://evil.example", "https://app.foxglove.dev.evil.example", "null",
           "http://app.foxglove.dev", "http://localhost.evil.example",
           "https://foxglove.dev")  # fmt: skip


@pytest.mark.parametrize("origin", FOREIGN)
def test_a_page_of_a_foreign_origin_does_not_observe(origin):
    with (
        LiveView(ZERO, port=0) as view,
        pytest.raises(InvalidStatus) as refused,
    ):
        connect(view.address, subprotocols=[PROTOCOL], origin=origin)
    assert refused.value.response.status_code == 403


OWN = (None, "file://", "https://app.foxglove.dev", "http://localhost:8080", "http://127.0.0.1")


@pytest.mark.parametrize("origin", OWN)
def test_the_programs_that_show_it_do(origin):
    with (
        LiveView(ZERO, port=0) as view,
        connect(view.address, subprotocols=[PROTOCOL], origin=origin) as client,
    ):
        assert json.loads(client.recv(PATIENCE))["op"] == "serverInfo"


def test_another_name_for_this_computer_is_refused():
    """A foreign page may have its own name lead to 127.0.0.1."""
    with LiveView(ZERO, port=0) as view:
        port = int(view.address.rsplit(":", 1)[1])
        with (
            socket.create_connection(("127.0.0.1", port)) as raw,
            pytest.raises(InvalidStatus) as refused,
        ):
            connect(f"ws://evil.example:{port}", subprotocols=[PROTOCOL], sock=raw)
    assert refused.value.response.status_code == 403


def test_the_server_behind_the_gate_is_at_no_address_that_a_page_guesses():
    assert len({drawn_address() for _ in range(20)}) > 1


def test_it_listens_on_this_computer_alone():
    with LiveView(ZERO, port=0) as view:
        assert view.address.startswith("ws://127.0.0.1:")


def test_an_occupied_port_is_reported():
    with LiveView(ZERO, port=0) as view:
        port = int(view.address.rsplit(":", 1)[1])
        with pytest.raises(InputError, match="a port that is free"):
            LiveView(ZERO, port=port)


def test_the_layout_that_is_shipped_shows_the_topics_there_are():
    """A 3-D panel of the scene in the laboratory's frame, plots, and the log (called RosOut)."""
    layout = LAYOUT.read_text(encoding="utf-8")
    panels = json.loads(layout)["configById"]
    (scene,) = [panel for name, panel in panels.items() if name.startswith("3D!")]
    assert scene["topics"]["/scene"] == {"visible": True}
    assert scene["followTf"] == "laboratory"
    assert {name.partition("!")[0] for name in panels} >= {"3D", "Plot", "RosOut"}
    for topic in ("/rate", "/masses", "/log", "/scene"):
        assert topic in layout


def test_a_torque_to_feed_forward_has_a_topic_of_its_own():
    """Its numbers by the names of the datagram; it is no event, of which people read a sentence."""
    numbers = np.arange(15.0).reshape(5, 3)
    data = message_of(GravityTorque(0.25, 0.06, *numbers, TorqueStatus.USABLE))
    with LiveView(ZERO, port=0) as view:
        view.event(0.25, "gravity_torque", "", data)
        with connect(view.address, subprotocols=[PROTOCOL]) as client:
            offered = offered_by(client, "/gravity_torque")
            assert offered.keys() == {"/gravity_torque"}
            schema = json.loads(offered["/gravity_torque"]["schema"])
            assert schema["properties"].keys() == {"timestamp", *data}
            wanted = {"id": 1, "channelId": offered["/gravity_torque"]["id"]}
            client.send(json.dumps({"op": "subscribe", "subscriptions": [wanted]}))
            until, observed = time.monotonic() + PATIENCE, b""
            while not observed and time.monotonic() < until:
                view.event(0.25, "gravity_torque", "", data)
                with suppress(TimeoutError):
                    message = client.recv(0.05)
                    observed = message if isinstance(message, bytes) and message[0] == 1 else b""
    sent = json.loads(observed[13:])
    assert sent["timestamp"] == {"sec": ZERO // 10**9, "nsec": 250_000_000}
    assert sent["torque_sd_N_m"] == [3.0, 4.0, 5.0]
    assert (sent["status"], sent["bench_time_s"], sent["lead_s"]) == ("usable", 0.25, 0.06)
