"""Work that does not come to its end, for the test of ``verification.limited``."""

import os
import time
from collections.abc import Iterator


def endless(item: int) -> Iterator[int]:
    """Yield once, then never again."""
    yield item
    while True:
        pass


def broken(item: int) -> Iterator[int]:
    """Yield once, then raise."""
    yield item
    raise ValueError("no rows")


def dead(item: int) -> Iterator[int]:
    """Yield once, then end the process."""
    yield item
    time.sleep(0.1)
    os._exit(3)
