"""A disk that is full: no file of this process may grow beyond some bytes (EFBIG)."""

import resource
from contextlib import contextmanager


@contextmanager
def files_of_at_most(count):
    """Let no file grow beyond so many bytes while the block lasts; Python ignores SIGXFSZ."""
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (count, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
