"""The viewer: a recording as a page of its own, which reads and commands nothing.

It has no runner, no token and no socket: the page fetches the whole recording once.
"""

from contextlib import AbstractContextManager
from html import escape

from fastapi import FastAPI, Request
from fastapi.responses import HTMLResponse, JSONResponse, Response
from fastapi.staticfiles import StaticFiles

from equipoise.app.dashboard.runner.whole_recording import WholeRecording
from equipoise.app.dashboard.server.authorisation import Guard, new_token
from equipoise.app.dashboard.server.gate import Doors, Gate
from equipoise.app.dashboard.server.serving import (
    STATIC,
    bracketed,
    check_libraries,
    listening,
    names,
    serve,
)

LOOPBACK = "127.0.0.1"  # nobody else opens it
TITLE, NONCE = "{title}", "{nonce}"  # what the page's text leaves open


class Viewer(AbstractContextManager["Viewer"]):
    """A page of one recording, from its port to Ctrl-C."""

    def __init__(self, shown: WholeRecording, port: int) -> None:
        check_libraries()
        self._socket = listening(LOOPBACK, port)
        self._port: int = self._socket.getsockname()[1]
        doors = Doors(frozenset(names(LOOPBACK, self._port)), exposed=False)
        self._app = Gate(application(shown), doors, Guard(new_token()))  # type: ignore[arg-type]

    @property
    def address(self) -> str:
        """Return where a browser finds it."""
        return f"http://{bracketed(LOOPBACK)}:{self._port}"

    def serve(self) -> None:
        """Serve until Ctrl-C."""
        serve(self._app, self._socket)

    def __exit__(self, *_raised: object) -> None:
        """Free the port."""
        self._socket.close()


def application(shown: WholeRecording) -> FastAPI:
    """Return what answers: the page, its modules, and the recording in two parts."""
    app = FastAPI(docs_url=None, redoc_url=None, openapi_url=None)
    app.mount("/static", StaticFiles(directory=STATIC))
    text = (STATIC / "replay.html").read_text(encoding="utf-8")

    @app.get("/")
    def page(request: Request) -> HTMLResponse:
        filled = text.replace(NONCE, request.scope["nonce"])
        return HTMLResponse(filled.replace(TITLE, escape(shown.title)))

    @app.get("/replay/document")
    def document() -> JSONResponse:
        return JSONResponse(shown.document)

    @app.get("/replay/rows")
    def rows() -> Response:
        return Response(shown.rows, media_type="application/octet-stream")

    return app
