"""The gate in front of the server: which requests pass, and how large they may be.

    Host          one of the addresses at which it listens: another name means a foreign page that
                  was led here (DNS rebinding)
    Origin        where a browser says that a request comes from: the same addresses only
    token         beyond loopback: in the address (``?token=``) once, then in a cookie
    size          of a request's body

An ASGI middleware; a WebSocket is refused before it is accepted (403).
"""

from dataclasses import dataclass

from starlette.datastructures import MutableHeaders
from starlette.requests import HTTPConnection
from starlette.responses import JSONResponse
from starlette.types import ASGIApp, Message, Receive, Scope, Send
from starlette.websockets import WebSocketClose

from equipoise.app.dashboard.server.authorisation import Guard

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

    def __init__(self, app: ASGIApp, doors: Doors, guard: Guard) -> None:
        self._app, self._doors, self._guard = app, doors, guard

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Let a request pass, or answer it with what is wrong."""
        if scope["type"] == "lifespan":
            await self._app(scope, receive, send)
            return
        request, is_websocket = HTTPConnection(scope), scope["type"] == "websocket"
        why = self._refusal(request)
        if why is not None:
            status, sentence = why
            json = JSONResponse({"refused": sentence}, status)
            answer = WebSocketClose(reason=sentence, code=1008) if is_websocket else json
            await answer(scope, receive, send)
            return
        sender = send if is_websocket else self._marked(request, send)
        await self._app(scope, _limited(receive), sender)

    def _refusal(self, request: HTTPConnection) -> tuple[int, str] | None:
        """Return status and sentence for who may not pass."""
        host, origin = request.headers.get("host", ""), request.headers.get("origin")
        if host not in self._doors.hosts:
            return 403, f"This dashboard is not at {host or 'a host without a name'}."
        needs_origin = request.scope["type"] == "websocket" and self._doors.exposed
        if (origin is None and needs_origin) or not (
            origin is None or self._doors.welcomes(origin)
        ):
            return 403, f"A page of {origin or 'no origin'} may not use this dashboard."
        if self._doors.exposed and not self._guard.is_right(_token(request)):
            return 401, "The token is missing or wrong: open the address that was printed."
        size = request.headers.get("content-length", "0")
        if not size.isdigit() or int(size) > LARGEST:
            return 413, f"A request has at most {LARGEST} bytes."
        return None

    def _marked(self, request: HTTPConnection, send: Send) -> Send:
        """Return a sender that adds what a browser should keep to: the policy, the token."""
        given = request.query_params.get("token", "")

        async def marked(event: Message) -> None:
            if event["type"] == "http.response.start":
                headers = MutableHeaders(scope=event)
                headers["content-security-policy"] = POLICY
                headers["x-content-type-options"] = "nosniff"
                headers["referrer-policy"] = "no-referrer"
                if given and self._doors.exposed:
                    cookie = f"{COOKIE}={given}; HttpOnly; SameSite=Strict; Path=/"
                    headers.append("set-cookie", cookie)
            await send(event)

        return marked


def _token(request: HTTPConnection) -> str:
    """Return the token of the address, else of the cookie, else nothing."""
    return request.query_params.get("token", "") or request.cookies.get(COOKIE, "")


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
