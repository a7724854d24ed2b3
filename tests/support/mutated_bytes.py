"""Valid bytes with something wrong in them, as a fuzzer makes them."""

from collections.abc import Callable

import numpy as np

Change = Callable[[bytes, np.random.Generator], bytes]

WHOLLY_RANDOM = 0.03  # of inputs
MOST = 4  # changes to one input
LONGEST = 64  # bytes that one change touches, except where it cuts
AWKWARD = (
    b"nan", b"-inf", b"1e999", b"-1", b"0", b"-0.0", b"99999999999999999999", b"\x00", b"\xff" * 4,
    b"\xff" * 8, b"\x00" * 8, b"\x7f\xff\xff\xff", b"\xff\xff\xff\x7f", b"\n", b",", b'"', b"[",
    b"{", b"\xc3", b"\xef\xbb\xbf", b"$", b"'", b"null", b"\r\n\r\n", b"=", b"#",
)  # fmt: skip


def mutated(valid: bytes, rng: np.random.Generator) -> bytes:
    """Return bytes with one to four changes, or none of the valid ones."""
    if rng.random() < WHOLLY_RANDOM:
        return rng.bytes(int(rng.integers(0, 4 * LONGEST)))
    for _ in range(int(rng.integers(1, MOST + 1))):
        valid = CHANGES[int(rng.integers(len(CHANGES)))](valid, rng)
    return valid


def _flipped(content: bytes, rng: np.random.Generator) -> bytes:
    at = _place(content, rng)
    return content[:at] + bytes(b ^ (1 << int(rng.integers(8))) for b in content[at : at + 1]) + (
        content[at + 1 :]
    )  # fmt: skip


def _overwritten(content: bytes, rng: np.random.Generator) -> bytes:
    at, size = _stretch(content, rng)
    return content[:at] + rng.bytes(size) + content[at + size :]


def _grown(content: bytes, rng: np.random.Generator) -> bytes:
    at, size = _stretch(content, rng)
    return content[:at] + rng.bytes(size) + content[at:]


def _shrunk(content: bytes, rng: np.random.Generator) -> bytes:
    at, size = _stretch(content, rng)
    return content[:at] + content[at + size :]


def _repeated(content: bytes, rng: np.random.Generator) -> bytes:
    at, size = _stretch(content, rng)
    return content[: at + size] + content[at:]


def _moved(content: bytes, rng: np.random.Generator) -> bytes:
    at, size = _stretch(content, rng)
    rest = content[:at] + content[at + size :]
    to = _place(rest, rng)
    return rest[:to] + content[at : at + size] + rest[to:]


def _cut(content: bytes, rng: np.random.Generator) -> bytes:
    return content[: _place(content, rng)]


def _beheaded(content: bytes, rng: np.random.Generator) -> bytes:
    return content[_place(content, rng) :]


def _awkward(content: bytes, rng: np.random.Generator) -> bytes:
    at, size = _place(content, rng), int(rng.integers(0, 9))
    return content[:at] + AWKWARD[int(rng.integers(len(AWKWARD)))] + content[at + size :]


def _place(content: bytes, rng: np.random.Generator) -> int:
    return int(rng.integers(len(content) + 1))


def _stretch(content: bytes, rng: np.random.Generator) -> tuple[int, int]:
    return _place(content, rng), int(rng.integers(1, LONGEST + 1))


CHANGES: tuple[Change, ...] = (
    _flipped, _flipped, _overwritten, _grown, _shrunk, _repeated, _moved, _cut, _beheaded,
    _awkward, _awkward, _awkward,
)  # fmt: skip
