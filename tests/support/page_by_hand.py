"""A page of the dashboard without a browser: it speaks as the shell's own script does, or worse."""

import json
import re
import urllib.request
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any
from uuid import uuid4

from websockets.sync.client import ClientConnection, connect

PATIENCE = 30.0  # s


@dataclass
class ByHand:
    """An open page; ``elements`` as the server has described them."""

    socket: ClientConnection
    client: str
    elements: dict[str, dict[str, Any]] = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)
    switch: str = ""  # the element that takes command and releases it

    def read(self, seconds: float = 0.5) -> None:
        """Read what has come until nothing comes for so long."""
        while True:
            try:
                text = self.socket.recv(seconds)
            except TimeoutError:
                return
            self._take(str(text))

    def until(self, there: Any) -> None:
        """Read until something is there."""
        while not there():
            self._take(str(self.socket.recv(PATIENCE)))

    def _take(self, text: str) -> None:
        if text == "2":
            self.socket.send("3")
        if not text.startswith("42"):
            return
        kind, what = json.loads(text[2:])
        if kind == "update":
            self.elements |= {k: v for k, v in what.items() if k != "_id" and v}
        if kind == "notify":
            self.notes.append(what["message"])

    def named(self, words: str) -> str:
        """Return the element with a label of these words."""
        for number, element in self.elements.items():
            props = element.get("props", {})
            if words in (props.get("label"), props.get("aria-label")):
                return number
        raise AssertionError(f"no {words} in {sorted(self.elements)}")

    def does(self, number: str, kind: str, *values: Any) -> None:
        """Do something with an element, with values of any kind."""
        for event in self.elements[number]["events"]:
            if event["type"] == kind:
                self.event(number, event["listener_id"], [json.dumps(v) for v in values])

    def event(self, number: str, listener: str, args: Any) -> None:
        """Send an event as it is given."""
        what = {"id": int(number), "client_id": self.client, "listener_id": listener, "args": args}
        self.socket.send("42" + json.dumps(["event", what]))

    def commands(self, token: str) -> None:
        """Take command."""
        self.switch = self.named("Command")
        self.does(self.named("Token"), "update:modelValue", token)
        self.does(self.named("Token"), "keydown")
        self.until(lambda: any("commands now" in note for note in self.notes))

    def releases(self) -> None:
        """Release the command to others."""
        self.does(self.switch, "click")
        self.read()


@contextmanager
def opened(url: str, port: int) -> Iterator[ByHand]:
    """Lend a page on this computer that is open and built."""
    with urllib.request.urlopen(url, timeout=PATIENCE) as answer:
        html = answer.read().decode()
    client = re.search(r"['\"]client_id['\"]: ['\"]([\w-]+)['\"]", html)[1]
    query = (
        f"EIO=4&transport=websocket&client_id={client}&next_message_id=0&implicit_handshake=true"
        f"&document_id={uuid4()}&tab_id={uuid4()}&old_tab_id="
    )
    address = f"ws://127.0.0.1:{port}/_nicegui_ws/socket.io/?{query}"
    with connect(address, origin=f"http://127.0.0.1:{port}", open_timeout=PATIENCE) as socket:
        socket.send("40")
        page = ByHand(socket, client)
        page.until(lambda: any(e.get("tag") == "q-input" for e in page.elements.values()))
        page.read()
        yield page
