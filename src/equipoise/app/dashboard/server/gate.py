"""What stands in front of the server: who may speak with it at all, and how much at once.

    Host          one of the addresses at which it listens: another name means a foreign page that
                  was led here (DNS rebinding)
    Origin        where a browser says that a request comes from: the same addresses only
    token         beyond loopback: in the address (``?token=``) once, then in a cookie
    size          of a request's body

An ASGI middleware; a WebSocket is refused before it is accepted (403).
"""

import json
from collections.abc import Awaitable, Callable, MutableMapping
from dataclasses import dataclass
from http.cookies import SimpleCookie
from typing import Any
from urllib.parse import parse_qs

from equipoise.app.dashboard.server.authorisation import Guard

Scope = MutableMapping[str, Any]
Event = MutableMapping[str, Any]
Receive = Callable[[], Awaitable[Event]]
Send = Callable[[Event], Awaitable[None]]
App = Callable[[Scope, Receive, Send], Awaitable[None]]

LARGEST = 64 * 1024  # bytes of a request or message, chosen: many times what any control sends
COOKIE = "equipoise_token"
# Nothing from outside, whatever a text holds; the shell makes its templates in the page.
POLICY = (
    "default-src 'self'; script-src 'self' 'unsafe-inline' 'unsafe-eval'; style-src 'self' "
    "'unsafe-inline'; img-src 'self' data: blob:; font-src 'self' data:; connect-src 'self' "
    "ws: wss:; frame-ancestors 'none'; form-action 'self'; base-uri 'self'"
)


@dataclass(frozen=True, slots=True)
class Doors:
    """Where it listens."""

    hosts: frozenset[str]  # such as 'localhost:8080'
    exposed: bool  # beyond loopback

    def welcomes(self, origin: str) -> bool:
        """Say whether a page of this origin is one of ours."""
        return any(origin == f"http://{host}" for host in self.hosts)


class Gate:
    """See above."""

    def __init__(self, app: App, doors: Doors, guard: Guard) -> None:
        self._app, self._doors, self._guard = app, doors, guard

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Let a request pass, or answer it with what is wrong."""
        if scope["type"] == "lifespan":
            await self._app(scope, receive, send)
            return
        headers = {name.decode("latin-1"): value.decode("latin-1")
                   for name, value in scope["headers"]}  # fmt: skip
        why = self._refusal(scope, headers)
        if why is not None:
            await _refuse(scope, send, *why)
            return
        sender = send if scope["type"] == "websocket" else self._marked(scope, send)
        await self._app(scope, _limited(receive), sender)

    def _refusal(self, scope: Scope, headers: dict[str, str]) -> tuple[int, str] | None:
        """Return status and sentence for who may not pass."""
        host, origin = headers.get("host", ""), headers.get("origin")
        if host not in self._doors.hosts:
            return 403, f"This dashboard is not at {host or 'a host without a name'}."
        needs_origin = scope["type"] == "websocket" and self._doors.exposed
        if (origin is None and needs_origin) or not (
            origin is None or self._doors.welcomes(origin)
        ):
            return 403, f"A page of {origin or 'no origin'} may not speak with this dashboard."
        if self._doors.exposed and not self._guard.is_right(_token(scope, headers)):
            return 401, "The token is missing or wrong: open the address that was printed."
        size = headers.get("content-length", "0")
        if not size.isdigit() or int(size) > LARGEST:
            return 413, f"A request has at most {LARGEST} bytes."
        return None

    def _marked(self, scope: Scope, send: Send) -> Send:
        """Return a sender that adds what a browser should keep to: the policy, the token."""
        given = _given(scope)

        async def marked(event: Event) -> None:
            if event["type"] == "http.response.start":
                more = [(b"content-security-policy", POLICY.encode()),
                        (b"x-content-type-options", b"nosniff"),
                        (b"referrer-policy", b"no-referrer")]  # fmt: skip
                if given and self._doors.exposed:
                    cookie = f"{COOKIE}={given}; HttpOnly; SameSite=Strict; Path=/"
                    more.append((b"set-cookie", cookie.encode()))
                event = {**event, "headers": [*event.get("headers", []), *more]}
            await send(event)

        return marked


def _given(scope: Scope) -> str:
    """Return the token of the address, if there is one."""
    return parse_qs(scope.get("query_string", b"").decode("latin-1")).get("token", [""])[0]


def _token(scope: Scope, headers: dict[str, str]) -> str:
    """Return the token of the address, else of the cookie, else nothing."""
    kept = SimpleCookie(headers.get("cookie", "")).get(COOKIE)
    return _given(scope) or ("" if kept is None else kept.value)


def _limited(receive: Receive) -> Receive:
    """Return a receiver that ends a request which turns out larger than it said."""
    received = 0

    async def limited() -> Event:
        nonlocal received
        event = await receive()
        if event["type"] == "http.request":
            received += len(event.get("body", b""))
            if received > LARGEST:
                return {"type": "http.disconnect"}
        return event

    return limited


async def _refuse(scope: Scope, send: Send, status: int, sentence: str) -> None:
    if scope["type"] == "websocket":
        await send({"type": "websocket.close", "code": 1008, "reason": sentence})
        return
    body = json.dumps({"refused": sentence}).encode()
    headers = [(b"content-type", b"application/json"), (b"content-length", b"%d" % len(body))]
    await send({"type": "http.response.start", "status": status, "headers": headers})
    await send({"type": "http.response.body", "body": body})
