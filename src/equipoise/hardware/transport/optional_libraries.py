"""Libraries that only some benches need, asked for where they are used."""

from importlib import import_module
from typing import Any

from equipoise.model.errors import InputError


def needed(library: str, extra: str, where: str) -> Any:
    """Return a library; InputError says how to install it where it is missing."""
    try:
        return import_module(library)
    except ImportError as error:
        wanted = f"`pip install equipoise[{extra}]`"
        raise InputError(where, f"no library '{library}'", wanted) from error
