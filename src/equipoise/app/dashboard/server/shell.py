"""NiceGUI as this server needs it: under a strict policy, and with answers that cost little.

    template    each script and style of the page gets the number of its answer (see ``policies``),
                written into the template itself: no text that is filled in can get it
    not there   one sentence, in place of a whole page of NiceGUI's for each
    messages    one that names no element of its own page is dropped

NiceGUI evaluates texts as scripts in three places: ``run_javascript``, handlers in JavaScript, and
properties that begin with a colon; Vue does where a component has a template. The page has none of
these (``fields``), so that its policy needs no ``unsafe-eval``; a test in a browser would find one.
"""

from collections.abc import Mapping
from contextlib import suppress
from typing import Any

from jinja2 import Environment, FunctionLoader
from nicegui import app, core
from nicegui import client as nicegui_client
from starlette.requests import Request
from starlette.responses import JSONResponse

MARK = ' nonce="{{ request.scope.nonce }}"'
MARKED: Mapping[str, str] = {
    "<script": f"<script{MARK}",
    "<style": f"<style{MARK}",
    '<link rel="modulepreload"': f'<link{MARK} rel="modulepreload"',
    ' style="display: none"': " hidden",
    "{{ body_html | safe }}": "",  # styles of components that this page has not
}


def prepare() -> None:
    """Prepare NiceGUI, before its first page."""
    environment = nicegui_client.templates.env
    environment.loader = FunctionLoader(_template_of(environment))
    app.add_exception_handler(404, _not_there)
    core.sio.eio.transports = ["websocket"]
    served: Any = core.sio
    served.handlers["/"]["event"] = _own(served.handlers["/"]["event"])


def _template_of(environment: Environment) -> Any:
    """Return what gives NiceGUI's templates, with the number in each script and style."""
    original = environment.loader
    assert original is not None

    def marked(name: str) -> str:
        source = original.get_source(environment, name)[0]
        for found, wanted in MARKED.items():
            source = source.replace(found, wanted)
        return source

    return marked


def _not_there(_request: Request, _error: Exception) -> JSONResponse:
    return JSONResponse({"refused": "The dashboard has no such page."}, 404)


def _own(handle: Any) -> Any:
    """Return NiceGUI's handler of events, for those that concern an element of their own page."""

    def checked(sid: str, message: dict[str, Any]) -> None:
        if message["client_id"] not in core.sio.rooms(sid):
            return
        # NiceGUI catches what goes wrong in our own handlers; this is a message about no element.
        with suppress(KeyError, ValueError):
            handle(sid, message)

    return checked
