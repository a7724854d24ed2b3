"""Libraries that read and write other programs' logs: extras, imported when one is needed."""

from importlib import import_module
from typing import Any

from equipoise.model.errors import InputError


def log_library(name: str, where: str, extra: str = "logs") -> Any:
    """Return a library of an extra; InputError names ``where`` it was needed."""
    try:
        return import_module(name)
    except ImportError as error:
        found = f"a log, but {name.split('.')[0]} is not installed"
        wanted = f"the {extra} extra: `pip install equipoise[{extra}]`"
        raise InputError(where, found, wanted) from error
