"""What the shell's socket lets in: the frames of its own script, and not too many of them."""

import asyncio
import json
import re
from pathlib import Path

import nicegui
import pytest

from equipoise.app.dashboard.server.socket_messages import ARGUMENT, BURST, admitted, is_ours, opens
from equipoise.app.dashboard.server.socket_messages import EVENTS as EVENTS_OF_THE_SOCKET

EVENT = {"id": 3, "client_id": "a-b", "listener_id": "c-d", "args": ['"x"', None, "1.5", "{}"]}
RIGHT = ("3", "40", "40{}", "41", "42" + json.dumps(["event", EVENT]),
         '42["ack",{"client_id":"a-b","next_message_id":7}]')  # fmt: skip
DEEP = "[" * 20_000
WRONG = (
    "", "0", "1", "2", "4", "5", "6", "43", "44", "45", "46", "40,", "40/other,", "41\n", "2probe",
    "42", "42{", "42[", "42[]", '42["event"]', "42null", '42["event",null]', '42["event",{}]',
    '420["event",{}]', '42["disconnect"]', '42["connect",{}]', '42["handshake",{}]',
    '42["log",{"client_id":"a-b","level":"error","message":"\\u001b[2J"}]',
    '42["javascript_response",{"request_id":"a","client_id":"a-b","result":1}]',
    '42["ack",{"client_id":"a-b","next_message_id":"7"}]',
    '42["ack",{"client_id":"a-b","next_message_id":-1}]',
    '42["ack",{"client_id":null,"next_message_id":1}]',
    "42" + DEEP, '42["event",' + DEEP, "451-[]", "45999999999-[]", "4" * 60_000, "\x00", "\ud800",
)  # fmt: skip
EVENTS = (
    {"id": "3"}, {"id": -1}, {"id": None}, {"id": 1e308}, {"client_id": 3}, {"client_id": "x" * 65},
    {"listener_id": []}, {"args": "x"}, {"args": None}, {"args": {}}, {"args": [1]},
    {"args": ["{"]}, {"args": ["nope"]}, {"args": [DEEP]}, {"args": ["1"] * 5},
    {"args": ['"' + "x" * ARGUMENT + '"']},
)  # fmt: skip


@pytest.mark.parametrize("text", RIGHT, ids=range(len(RIGHT)))
def test_what_the_script_sends_passes(text):
    assert is_ours(text)


@pytest.mark.parametrize("text", WRONG, ids=range(len(WRONG)))
def test_what_it_never_sends_does_not(text):
    assert not is_ours(text)


@pytest.mark.parametrize("part", EVENTS, ids=range(len(EVENTS)))
def test_an_event_of_another_shape_does_not(part):
    assert not is_ours("42" + json.dumps(["event", EVENT | part]))


def received(messages):
    """Return what comes through of messages that come at once."""
    coming = iter([*messages, {"type": "websocket.disconnect"}])

    async def receive():
        return next(coming)

    async def all_of_them():
        checked, found = admitted(receive), []
        while (event := await checked())["type"] != "websocket.disconnect":
            found.append(event)
        return found

    return asyncio.run(all_of_them())


def texts(*of):
    return [{"type": "websocket.receive", "text": text} for text in of]


def test_the_rest_is_dropped_and_the_socket_stays():
    connect, binary = {"type": "websocket.connect"}, {"type": "websocket.receive", "bytes": b"3"}
    assert received([connect, *texts("3", *WRONG), binary, *texts("40")]) == [
        connect, *texts("3"), *texts("40"),
    ]  # fmt: skip


def test_more_than_a_person_can_do_is_dropped():
    assert BURST <= len(received(texts(*["3"] * (BURST + 500)))) <= BURST + 100


def scope(query):
    return {"query_string": query.encode("latin-1", "replace")}


OWN = ("EIO=4&transport=websocket&client_id=a-1&next_message_id=0&implicit_handshake=true"
       "&document_id=b-2&tab_id=c-3&old_tab_id=&t=Px.1-a")  # fmt: skip


def test_the_address_of_the_socket():
    assert opens(scope(OWN))
    assert opens(scope("EIO=4&transport=websocket"))
    for wrong in ("", "EIO=3&transport=websocket", "EIO=4&transport=polling", OWN + "&next=1",
                  OWN + "&EIO=4", OWN.replace("id=0", "id=x"), OWN.replace("a-1", "a%00"),
                  OWN.replace("true", "false"),
                  OWN.replace("id=0", "id=" + "9" * 5000)):  # fmt: skip
        assert not opens(scope(wrong))


def test_what_the_installed_script_sends_is_known():
    """Its log, its answers and a late handshake are not wanted; a new word would be found here."""
    script = (Path(nicegui.__file__).parent / "static" / "nicegui.js").read_text()
    sent = set(re.findall(r'socket\??\.emit\("(\w+)"', script))
    assert sent == {*EVENTS_OF_THE_SOCKET, "log", "javascript_response", "handshake"}
