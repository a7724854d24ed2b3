"""Libraries that read and write other programs' files: extras, imported when one is needed."""

from importlib import import_module
from typing import Any

from equipoise.model.errors import InputError


def log_library(name: str, where: str) -> Any:
    """Return a library of the extra ``logs``; InputError names ``where`` it was needed."""
    return extra_library(name, where, "a log", "logs")


def extra_library(name: str, where: str, what: str, extra: str, instead: str = "") -> Any:
    """Return a library of an extra that reads ``what``; InputError names the extra.

    ``instead`` says what a person can do without it, ' or ...'.
    """
    try:
        return import_module(name)
    except ImportError as error:
        found = f"{what}, but {name.split('.')[0]} is not installed"
        wanted = f"the {extra} extra: `pip install equipoise[{extra}]`{instead}"
        raise InputError(where, found, wanted) from error
