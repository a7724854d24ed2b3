"""A gate in front of a WebSocket server of this computer: foreign pages do not get through.

A page in a browser may open a WebSocket to this computer, wherever the page is from; the browser
says so in ``Origin``, which a page cannot change. The gate reads the head of each connection and
passes on those that are welcome, byte by byte. It has a thread and an event loop of its own.
"""

import asyncio
import socket
import threading
from collections.abc import Callable
from contextlib import suppress

HEAD, IN_TIME = 8192, 5.0  # bytes of a head, and s for it; chosen: ten times what a browser sends
CLIENTS = 32  # at once, chosen
PIECE = 65536  # bytes
REFUSED = b"HTTP/1.1 403 Forbidden\r\nContent-Length: 0\r\nConnection: close\r\n\r\n"
Head = dict[str, list[str]]  # values by name in lower case


class OriginGate:
    """See above; ``welcome`` judges a connection by the head of its request."""

    def __init__(
        self, at: socket.socket, behind: tuple[str, int], welcome: Callable[[Head], bool]
    ) -> None:
        self._at, self._behind, self._welcome = at, behind, welcome
        self._clients = set[asyncio.Task[None]]()
        self._loop = asyncio.new_event_loop()
        self._over = asyncio.Event()
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()

    def close(self) -> None:
        """End all connections."""
        with suppress(RuntimeError):  # the loop has ended
            self._loop.call_soon_threadsafe(self._over.set)
        self._thread.join()

    def _run(self) -> None:
        self._loop.run_until_complete(self._serve())
        self._loop.close()

    async def _serve(self) -> None:
        server = await asyncio.start_server(self._client, sock=self._at, limit=HEAD)
        await self._over.wait()
        server.close()
        for client in list(self._clients):
            client.cancel()
        await asyncio.gather(*self._clients, return_exceptions=True)

    async def _client(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        this = asyncio.current_task()
        assert this is not None
        self._clients.add(this)
        try:
            if len(self._clients) <= CLIENTS:
                await self._passed_on(reader, writer)
        except (OSError, TimeoutError, asyncio.IncompleteReadError, asyncio.LimitOverrunError):
            pass  # it has gone, or has sent no head
        finally:
            self._clients.discard(this)
            writer.close()

    async def _passed_on(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        async with asyncio.timeout(IN_TIME):
            head = await reader.readuntil(b"\r\n\r\n")
        if not self._welcome(fields_of(head)):
            writer.write(REFUSED)
            await writer.drain()
            return
        inner_reader, inner_writer = await asyncio.open_connection(*self._behind)
        inner_writer.write(head)
        ways = [(reader, inner_writer), (inner_reader, writer)]
        tasks = [asyncio.ensure_future(_copied(*way)) for way in ways]
        try:
            await asyncio.wait(tasks, return_when=asyncio.FIRST_COMPLETED)
        finally:
            for task in tasks:
                task.cancel()
            inner_writer.close()


async def _copied(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
    with suppress(OSError):
        while piece := await reader.read(PIECE):
            writer.write(piece)
            await writer.drain()


def fields_of(head: bytes) -> Head:
    """Return the fields of the head of a request; a name may occur more than once."""
    found: Head = {}
    for line in head.decode("latin-1").split("\r\n")[1:]:
        name, _, value = line.partition(":")
        found.setdefault(name.strip().lower(), []).append(value.strip())
    return found
