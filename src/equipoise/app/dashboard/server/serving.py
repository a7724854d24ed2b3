"""What every page of ours is served with: its files, an address, the server until Ctrl-C."""

import socket
from collections.abc import Iterator
from pathlib import Path

import uvicorn

from equipoise.app.dashboard.server.gate import LARGEST, Gate
from equipoise.app.dashboard.server.limits import BACKLOG, Waiting, limited
from equipoise.hardware.bench.stop_signals import HANG_UP, handled
from equipoise.model.errors import InputError

STATIC = Path(__file__).parents[1] / "static"
VENDOR = STATIC / "vendor"


def check_libraries() -> None:
    """Raise InputError where the libraries of the page's scripts are not installed."""
    if not (VENDOR / "three.module.js").is_file():
        found = "no three.js and uPlot beside the page"
        raise InputError("dashboard", found, "them: `make test` in the source folder fetches them")


def listening(host: str, port: int) -> socket.socket:
    """Return a socket that listens; InputError where the port is taken or the address not ours."""
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    at = socket.socket(family, socket.SOCK_STREAM)
    at.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        at.bind((host, port))
        at.listen(64)
    except OSError as error:
        at.close()
        why = error.strerror or str(error)
        raise InputError(f"{host}:{port}", why, "a free address and port") from error
    return at


def names(host: str, port: int) -> Iterator[str]:
    """Yield what a browser may call the place where we listen."""
    yield f"{bracketed(host)}:{port}"
    if host == "127.0.0.1":
        yield f"localhost:{port}"


def bracketed(host: str) -> str:
    """Return an address as a URL has it."""
    return f"[{host}]" if ":" in host else host


def serve(app: Gate, at: socket.socket) -> None:
    """Serve until Ctrl-C and its like; the server knows of two of these signals by itself."""
    config = uvicorn.Config(
        app, log_level="error", ws_max_size=LARGEST, timeout_graceful_shutdown=1,
        access_log=False, http=limited(Waiting()), backlog=BACKLOG,  # type: ignore[arg-type]
    )  # fmt: skip
    server = uvicorn.Server(config)
    with handled(HANG_UP, server.handle_exit):
        server.run(sockets=[at])
