"""Libraries that read and write other programs' logs: an extra, imported when one is needed."""

from importlib import import_module
from typing import Any

from equipoise.model.errors import InputError


def log_library(name: str, where: str) -> Any:
    """Return a library of the extra ``logs``; InputError names ``where`` it was needed."""
    try:
        return import_module(name)
    except ImportError as error:
        found = f"a log, but {name.split('.')[0]} is not installed"
        raise InputError(where, found, "the logs extra: `pip install equipoise[logs]`") from error
