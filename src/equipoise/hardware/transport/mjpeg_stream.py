"""A stream of pictures over HTTP: multipart/x-mixed-replace, one part after the other (MJPEG).

RFC 2046 section 5.1 (boundaries) and RFC 9112 section 7.1 (chunks, in which some small cameras
wrap the stream). A part says its length by Content-Length, or ends where the next boundary is.
"""

from dataclasses import dataclass

BLANK = b"\r\n\r\n"
MOST_HEAD, MOST_PART = 1 << 14, 1 << 24  # bytes, chosen: beyond them something else is sent


@dataclass(frozen=True, slots=True)
class Part:
    """One part of the stream."""

    head: dict[str, str]  # by name in small letters
    body: bytes


class Parts:
    """Cuts what arrives into parts; what cannot be understood is left out up to a boundary."""

    def __init__(self) -> None:
        self.cleared()

    def cleared(self) -> None:
        """Restart: an answer of the server is awaited."""
        self._raw = self._plain = b""
        self._chunks: Chunks | None = None
        self._boundary = b""  # empty: the answer's head has not come yet
        self.lost = 0  # parts that could not be understood

    def cut(self, data: bytes) -> list[Part]:
        """Return the parts that are whole with these bytes."""
        if not self._boundary:
            data = self._greeted(data)
        if not self._boundary:
            return []
        self._plain += data if self._chunks is None else self._chunks.cut(data)
        found: list[Part] = []
        while (part := self._next()) is not None:
            found.append(part)
        return found

    def _greeted(self, data: bytes) -> bytes:
        """Take the answer's head, and return what comes after it."""
        head, blank, rest = (self._raw + data).partition(BLANK)
        if not blank:
            self._raw = head[-MOST_HEAD:]
            return b""
        reported = named(head.partition(b"\r\n")[2])
        kind = reported.get("content-type", "")
        boundary = kind.partition("boundary=")[2].partition(";")[0].strip().strip('"')
        self._raw = b""
        if boundary:
            self._boundary = b"--" + boundary.removeprefix("--").encode("latin-1")
            chunked = "chunked" in reported.get("transfer-encoding", "").lower()
            self._chunks = Chunks() if chunked else None
        return rest

    def _next(self) -> Part | None:
        """Take the next whole part away."""
        start = self._plain.find(self._boundary)
        if start < 0:
            self._plain = self._plain[-len(self._boundary) :]
            return None
        self._plain = self._plain[start:]
        end = self._plain.find(BLANK)
        if end < 0:
            return self._skipped() if len(self._plain) > MOST_HEAD else None
        head = named(self._plain[:end].partition(b"\r\n")[2])
        body = end + len(BLANK)
        length = head.get("content-length", "")
        stop = body + int(length) if length.isdecimal() and len(length) < 12 else self._ends(body)
        if max(stop, len(self._plain)) - body > MOST_PART:
            return self._skipped()
        if stop < 0 or stop > len(self._plain):
            return None
        part = Part(head, self._plain[body:stop])
        self._plain = self._plain[stop:]
        return part

    def _ends(self, body: int) -> int:
        """Return where the next boundary is; -1: not there yet."""
        return self._plain.find(b"\r\n" + self._boundary, body)

    def _skipped(self) -> Part | None:
        self.lost += 1
        self._plain = self._plain[len(self._boundary) :]
        return self._next()


class Chunks:
    """Undoes the coding in chunks: a line with a length in hexadecimal, so many bytes, a line."""

    def __init__(self) -> None:
        self._raw = b""
        self._left = 0  # bytes of the chunk under way

    def cut(self, data: bytes) -> bytes:
        """Return what is inside."""
        self._raw += data
        found: list[bytes] = []
        while self._raw:
            if self._left:
                taken, self._raw = self._raw[: self._left], self._raw[self._left :]
                self._left -= len(taken)
                found.append(taken)
                continue
            line, end, rest = self._raw.partition(b"\r\n")
            if not end:
                self._raw = self._raw[-MOST_HEAD:]
                break
            self._raw = rest
            size = line.partition(b";")[0].strip()
            self._left = int(size, 16) if size.isalnum() and set(size) <= set(HEX) else 0
        return b"".join(found)


HEX = b"0123456789abcdefABCDEF"


def named(lines: bytes) -> dict[str, str]:
    """Return the fields of a head by name."""
    pairs = (line.decode("latin-1").partition(":") for line in lines.split(b"\r\n"))
    return {name.strip().lower(): value.strip() for name, colon, value in pairs if colon}
