"""Lines cut from a stream of bytes as they arrive; a line that never ends is dropped."""

LONGEST = 1024  # bytes, chosen: four times the longest line of any protocol here


class Lines:
    """A buffer of half a line."""

    def __init__(self) -> None:
        self.rest = b""  # half a line
        self.dropped = 0  # lines too long to be any

    def cleared(self) -> None:
        """Forget half a line."""
        self.rest = b""

    def cut(self, data: bytes) -> list[bytes]:
        """Return the lines that are complete with these bytes, without their ends."""
        *whole, self.rest = (self.rest + data).replace(b"\r", b"\n").split(b"\n")
        if len(self.rest) > LONGEST:
            self.rest = b""
            self.dropped += 1
        return [line for line in whole if line]
