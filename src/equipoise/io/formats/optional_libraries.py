"""Libraries that read and write the logs of other programs."""

from typing import Any

from equipoise.model.optional_libraries import extra_library


def log_library(name: str, where: str) -> Any:
    """Return a library of the extra ``logs``; InputError names ``where`` it was needed."""
    return extra_library(name, where, "a log", "logs")
