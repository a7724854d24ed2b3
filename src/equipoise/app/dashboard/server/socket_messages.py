"""What the shell's socket may bring: the messages that a page sends, and no others.

    3                pong
    40, 41           the socket begins, and ends
    42["ack", ..]    so many messages of the server have come
    42["event", ..]  a person has done something with an element; its values are checked by
                     the element (``fields``) and by the schema of the requests

What is none of these is dropped, and so is what comes oftener than a person can do. The shell
itself would raise an error for it, or write what the page wants written into the log.
"""

import re
from collections.abc import Mapping
from typing import Annotated, Any
from urllib.parse import parse_qsl

from pydantic import Field, Json, TypeAdapter, ValidationError
from starlette.types import Message, Receive, Scope
from typing_extensions import TypedDict

from equipoise.app.dashboard.server.limits import Bucket

PLAIN = re.compile(r"3|4[01]|40\{\}")
PREFIX = "42"
RATE, BURST = 50, 300  # messages of a socket, chosen: a person types ten keys a second
ARGUMENT = 4096  # characters, chosen: many times what an element sends

Identity = Annotated[str, Field(max_length=64)]
Count = Annotated[int, Field(ge=0, lt=2**53)]
Argument = Annotated[str, Field(max_length=ARGUMENT)]


class Ack(TypedDict):
    """So many messages have come."""

    client_id: Identity
    next_message_id: Count


class Event(TypedDict):
    """Something was done with an element; each argument is a text of JSON."""

    id: Count
    client_id: Identity
    listener_id: Identity
    args: Annotated[list[Argument | None], Field(max_length=4)]


EVENTS: Mapping[str, TypeAdapter[Any]] = {
    "ack": TypeAdapter(Ack),
    "event": TypeAdapter(Event),
}
NAMED = TypeAdapter(tuple[str, Any])
VALUE = TypeAdapter(Json[Any])
QUERY: Mapping[str, re.Pattern[str]] = {
    "EIO": re.compile("4"),
    "transport": re.compile("websocket"),
    "client_id": re.compile(r"[\w-]{1,64}"),
    "next_message_id": re.compile(r"\d{1,15}"),
    "implicit_handshake": re.compile("true"),
    "document_id": re.compile(r"[\w-]{1,64}"),
    "tab_id": re.compile(r"[\w-]{1,64}"),
    "old_tab_id": re.compile(r"[\w-]{0,64}"),
    "t": re.compile(r"[\w.-]{1,32}"),
}


def opens(scope: Scope) -> bool:
    """Say whether the address of a socket is one that the shell's own script makes."""
    pairs = parse_qsl(scope["query_string"].decode("latin-1"), keep_blank_values=True)
    names = [name for name, _ in pairs]
    known = all(name in QUERY and QUERY[name].fullmatch(value) for name, value in pairs)
    return known and len(set(names)) == len(names) and {"EIO", "transport"} <= set(names)


def is_ours(text: str) -> bool:
    """Say whether a message is one that a page sends."""
    if not text.startswith(PREFIX):
        return PLAIN.fullmatch(text) is not None
    try:
        name, content = NAMED.validate_json(text.removeprefix(PREFIX))
        message = EVENTS[name].validate_python(content, strict=True)
        for argument in message.get("args", ()):
            if argument is not None:
                VALUE.validate_python(argument)
    except (ValidationError, KeyError):
        return False
    return True


def admitted(receive: Receive) -> Receive:
    """Return a receiver of the messages of a page; others are dropped."""
    bucket = Bucket(RATE, BURST)

    async def checked() -> Message:
        while True:
            event = await receive()
            if event["type"] != "websocket.receive":
                return event
            text = event.get("text")
            if text is not None and bucket.take() and is_ours(text):
                return event

    return checked
