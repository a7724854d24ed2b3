"""The gate in front of the server: which requests pass, how large they may be, and how many.

    Host            one of the addresses at which it listens: another name means a foreign page
                    that was led here (DNS rebinding)
    Origin          where a browser says that a request comes from: the same addresses only
    Sec-Fetch-Site  what a browser says of a request without an origin: ``same-origin``, or
                    ``none`` for what a person has typed. A link on another site is refused like
                    any other request from there: nothing that another site begins is answered.
                    Browsers leave it out where the address is neither loopback nor encrypted.
    token           beyond loopback, in a cookie. ``/?token=`` sets it and leads to ``/``, so that
                    no address that a browser keeps has it
    path, method    what the page needs, GET and HEAD
    size            of a request's body, and of a message
    how often       see ``limits``; what was refused costs nobody else a place

An ASGI middleware; a WebSocket is refused before it is accepted (403).
"""

import secrets
from dataclasses import dataclass, field

from starlette.datastructures import MutableHeaders
from starlette.requests import HTTPConnection
from starlette.responses import JSONResponse, RedirectResponse, Response
from starlette.types import ASGIApp, Message, Receive, Scope, Send
from starlette.websockets import WebSocketClose

from equipoise.app.dashboard.server import policies, socket_messages
from equipoise.app.dashboard.server.authorisation import Guard
from equipoise.app.dashboard.server.limits import Bucket

LARGEST = 64 * 1024  # bytes of a request or message, chosen: many times what any control sends
SOCKETS = 64  # open at once, chosen: a page has two
COOKIE = "equipoise_token"
PAGE, SHELL_SOCKET = "/", "/_nicegui_ws/socket.io/"
FILES = ("/static/", "/runs/", "/replay/", "/_nicegui/")
OTHERS = frozenset({PAGE, "/live", "/favicon.ico", SHELL_SOCKET})
Refusal = tuple[int, str]


@dataclass(frozen=True, slots=True)
class Doors:
    """Where it listens."""

    hosts: frozenset[str]  # such as 'localhost:8080'
    exposed: bool  # beyond loopback

    def welcomes(self, origin: str) -> bool:
        """Say whether a page of this origin is one of ours."""
        return any(origin == f"http://{host}" for host in self.hosts)


def _often() -> Bucket:
    return Bucket(rate=200, burst=1000)  # chosen: a page loads about 80 files


def _pages() -> Bucket:
    return Bucket(rate=2, burst=30)  # chosen: each page takes memory until it is closed


@dataclass(slots=True)
class Gate:
    """See above."""

    app: ASGIApp
    doors: Doors
    guard: Guard
    requests: Bucket = field(default_factory=_often)
    pages: Bucket = field(default_factory=_pages)
    sockets: int = 0

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Let a request pass, or answer it with what is wrong."""
        if scope["type"] == "lifespan":
            await self.app(scope, receive, send)
        elif scope["type"] == "websocket":
            await self._socket(scope, receive, send)
        else:
            await self._request(scope, receive, send)

    async def _request(self, scope: Scope, receive: Receive, send: Send) -> None:
        request = HTTPConnection(scope)
        scope["nonce"] = secrets.token_urlsafe(16)  # the shell's page reads it there
        sender = self._marked(request, send)
        why = self._refusal(request)
        answer: ASGIApp = self.app
        if self._given(request) and (why is None or why[0] == 401):
            answer = self._led_to_the_page(request)
        elif why is not None:
            answer = JSONResponse({"refused": why[1]}, why[0])
        await answer(scope, _limited(receive), sender)

    async def _socket(self, scope: Scope, receive: Receive, send: Send) -> None:
        why = self._refusal(HTTPConnection(scope))
        if why is None and self.sockets >= SOCKETS:
            why = 503, f"There are {SOCKETS} sockets open: close a page."
        if why is not None:
            await WebSocketClose(reason=why[1], code=1008)(scope, receive, send)
            return
        if scope["path"] == SHELL_SOCKET:
            receive = socket_messages.admitted(receive)
        self.sockets += 1
        try:
            await self.app(scope, receive, send)
        finally:
            self.sockets -= 1

    def _refusal(self, request: HTTPConnection) -> Refusal | None:
        """Return status and sentence for who may not pass."""
        return (
            self._foreign(request)
            or self._unauthorised(request)
            or _unknown(request.scope)
            or _too_large(request)
            or self._too_often(request.scope)
        )

    def _foreign(self, request: HTTPConnection) -> Refusal | None:
        headers = request.headers
        host, origin = headers.get("host", ""), headers.get("origin")
        if host not in self.doors.hosts:
            return 403, "This dashboard is not served at that host: open the printed address."
        needs_origin = request.scope["type"] == "websocket" and self.doors.exposed
        if (origin is None and needs_origin) or not (origin is None or self.doors.welcomes(origin)):
            return 403, "A page of another origin may not use this dashboard."
        if headers.get("sec-fetch-site", "none") not in ("none", "same-origin"):
            return 403, "Another site linked here: type the printed address yourself."
        return None

    def _unauthorised(self, request: HTTPConnection) -> Refusal | None:
        if self.doors.exposed and not self.guard.is_right(request.cookies.get(COOKIE, "")):
            return 401, "The token is missing or wrong: open the printed address."
        return None

    def _too_often(self, scope: Scope) -> Refusal | None:
        pages = self.pages.take() if scope["path"] == PAGE else True
        if pages and self.requests.take():
            return None
        return 429, "Too many requests at once: wait a few seconds."

    def _given(self, request: HTTPConnection) -> bool:
        """Say whether the address brings the right token."""
        given = request.query_params.get("token", "")
        return self.doors.exposed and request.scope["path"] == PAGE and self.guard.is_right(given)

    def _led_to_the_page(self, request: HTTPConnection) -> Response:
        token = request.query_params["token"]
        answer = RedirectResponse(PAGE, 303, {"cache-control": "no-store"})
        answer.set_cookie(COOKIE, token, httponly=True, samesite="strict", path="/")
        return answer

    def _marked(self, request: HTTPConnection, send: Send) -> Send:
        """Return a sender that adds what a browser should keep to."""
        is_page = request.scope["path"] == PAGE
        host = request.headers.get("host", "")
        ours = is_page and host in self.doors.hosts
        policy = policies.of_page(request.scope["nonce"], host) if ours else policies.NOTHING

        async def marked(event: Message) -> None:
            if event["type"] == "http.response.start":
                headers = MutableHeaders(scope=event)
                for name, value in policies.added(set(headers.keys()), policy):
                    headers[name] = value
            await send(event)

        return marked


def _unknown(scope: Scope) -> Refusal | None:
    if scope["path"] not in OTHERS and not scope["path"].startswith(FILES):
        return 404, "The dashboard has no such page."
    if scope["path"] == SHELL_SOCKET and not (
        scope["type"] == "websocket" and socket_messages.opens(scope)
    ):
        return 404, "This address serves the socket of the page's own script only."
    if scope["type"] == "http" and scope["method"] not in ("GET", "HEAD"):
        return 405, "The dashboard is read with GET; a page commands through its socket."
    return None


def _too_large(request: HTTPConnection) -> Refusal | None:
    size = request.headers.get("content-length", "0")
    if not size.isdecimal() or len(size) > 9 or int(size) > LARGEST:
        return 413, f"A request has at most {LARGEST} bytes."
    return None


def _limited(receive: Receive) -> Receive:
    """Return a receiver that ends a request which turns out larger than it said."""
    received = 0

    async def limited() -> Message:
        nonlocal received
        event = await receive()
        if event["type"] == "http.request":
            received += len(event.get("body", b""))
            if received > LARGEST:
                return {"type": "http.disconnect"}
        return event

    return limited
