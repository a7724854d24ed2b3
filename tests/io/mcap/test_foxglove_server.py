"""Whoever connects sees the rows of the bench, and cannot do anything to it."""

import json
import struct
import time

import numpy as np
import pytest
from websockets.sync.client import connect

from equipoise.io.mcap.foxglove_server import LAYOUT, LiveView
from equipoise.model.errors import InputError
from equipoise.model.recording import Recording, Samples

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
    stamp = {"timestamp": {"sec": ZERO // 10**9, "nsec": ZERO % 10**9 + 250_000_000}}
    assert json.loads(observed[13:]) == {**stamp, "x_rad_s": 0.1, "y_rad_s": 0.0, "z_rad_s": -2.0}


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
