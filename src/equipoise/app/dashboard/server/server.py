"""The server: the page, what it draws from, the live rows and the files of runs."""

import asyncio
import threading
from collections.abc import AsyncGenerator
from contextlib import asynccontextmanager, suppress
from functools import partial
from multiprocessing import get_context
from multiprocessing.connection import Connection as Pipe

from fastapi import FastAPI, WebSocket, WebSocketDisconnect
from fastapi.responses import FileResponse, JSONResponse
from fastapi.staticfiles import StaticFiles
from nicegui import core, ui

from equipoise.app.dashboard.protocol.data_folder import within
from equipoise.app.dashboard.runner.request_handler import LEAVE
from equipoise.app.dashboard.runner.runner_process import Opening, run_runner
from equipoise.app.dashboard.server.broadcast import GONE, Watch
from equipoise.app.dashboard.server.gate import LARGEST, Doors, Gate
from equipoise.app.dashboard.server.layout import open_page
from equipoise.app.dashboard.server.policies import of_file
from equipoise.app.dashboard.server.request_queue import Counter
from equipoise.app.dashboard.server.serving import STATIC
from equipoise.app.dashboard.server.shell import prepare
from equipoise.model.errors import EquipoiseError, InputError

LEAVING = 5.0  # s, chosen: for the runner to halt a bench and end
ENDED = "The runner has ended; start the dashboard again."


class RemoteRunner:
    """The runner's process, and the pipe of its messages."""

    def __init__(self, opening: Opening) -> None:
        context = get_context("spawn")
        self.pipe, remote = context.Pipe()
        self._process = context.Process(target=run_runner, args=(remote, opening))
        self._process.start()
        remote.close()

    def wait_until_ready(self) -> None:
        """Wait until it shows something; EquipoiseError where it cannot."""
        try:
            kind, what = self.pipe.recv()
        except (EOFError, OSError):
            raise EquipoiseError("the runner of the dashboard ended at once") from None
        if kind == "failed":
            raise EquipoiseError(what)

    def close(self) -> None:
        """Let it halt the bench and end.

        It is told so, and its end of the pipe closes with it. Ours stays: a thread that reads from
        it would meet TypeError where it is closed between two of its steps.
        """
        with suppress(OSError):
            self.pipe.send(LEAVE)
        self._process.join(LEAVING)
        if self._process.is_alive():
            self._process.kill()
            self._process.join()


def listen(pipe: Pipe, watch: Watch, loop: asyncio.AbstractEventLoop) -> None:
    """Pass the runner's messages to the watch until it ends; a thread's whole life."""
    with suppress(RuntimeError):  # the loop is closed: the server has ended
        try:
            while True:
                loop.call_soon_threadsafe(watch.take, *pipe.recv())
        except (EOFError, OSError):
            loop.call_soon_threadsafe(watch.end, ENDED)


def application(counter: Counter, pipe: Pipe, doors: Doors) -> Gate:
    """Return the whole server behind its gate."""

    @asynccontextmanager
    async def living(_app: FastAPI) -> AsyncGenerator[None]:
        loop = asyncio.get_running_loop()
        args = (pipe, counter.watch, loop)
        threading.Thread(target=listen, args=args, daemon=True).start()
        yield

    app = FastAPI(lifespan=living, docs_url=None, redoc_url=None, openapi_url=None)
    _routes(app, counter)
    ui.page("/", title=f"Equipoise: {counter.testbed.name}")(partial(open_page, counter))
    ui.run_with(
        app,
        language="en-US",
        binding_refresh_interval=None,
        tailwind=False,
        show_welcome_message=False,
    )
    core.sio.eio.max_http_buffer_size = LARGEST
    prepare()
    return Gate(app, doors, counter.guard)  # type: ignore[arg-type]


def _routes(app: FastAPI, counter: Counter) -> None:
    app.mount("/static", StaticFiles(directory=STATIC))

    @app.get("/runs/{name:path}")
    def run_file(name: str) -> FileResponse:
        path = within(counter.folder, name)
        return FileResponse(path, headers={"content-security-policy": of_file(path.name)})

    @app.exception_handler(InputError)
    def not_there(_request: object, error: InputError) -> JSONResponse:
        return JSONResponse({"refused": str(error)}, status_code=404)

    @app.websocket("/live")
    async def live(page: WebSocket) -> None:
        await page.accept()
        await _shown(page, counter.watch)


async def _shown(page: WebSocket, watch: Watch) -> None:
    """Send a page all messages; a page that sends anything here is disconnected."""
    reported = watch.join()
    silent = asyncio.ensure_future(page.receive())
    try:
        while not silent.done():
            following = asyncio.ensure_future(reported.get())
            await asyncio.wait({silent, following}, return_when=asyncio.FIRST_COMPLETED)
            if not following.done():
                following.cancel()
                break
            message = following.result()
            if message == GONE:
                break
            await (
                page.send_bytes(message) if isinstance(message, bytes) else page.send_text(message)
            )
        if not silent.done() or silent.result()["type"] == "websocket.receive":
            await page.close(1008)
    except (WebSocketDisconnect, RuntimeError):
        pass
    finally:
        silent.cancel()
        watch.leave(reported)
