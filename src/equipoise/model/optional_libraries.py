"""Libraries of extras: imported when one is needed, and what to type where one is missing."""

from importlib import import_module
from typing import Any

from equipoise.model.errors import InputError


def extra_line(extra: str) -> str:
    """Return the line that installs an extra; quoted, since some shells expand brackets."""
    return f'`pip install "equipoise[{extra}]"`'


def extra_library(name: str, where: str, what: str, extra: str, instead: str = "") -> Any:
    """Return a module of an extra, which ``what`` needs.

    ``instead`` states what a person can do without it, ', or ...'. InputError states which library
    is missing, or why it cannot be imported, and the line that installs the extra.
    """
    try:
        return import_module(name)
    except ImportError as error:
        found = f"{what}, but {_fault(name, error)}"
        wanted = f"the {extra} extra: {extra_line(extra)}{instead}"
        raise InputError(where, found, wanted) from error


def _fault(name: str, error: ImportError) -> str:
    """Return what is missing: the library, one that it needs itself, or a file of the system."""
    package = name.partition(".")[0]
    if not isinstance(error, ModuleNotFoundError):
        return f"{package} cannot be imported ({error})"
    missing = (error.name or package).partition(".")[0]
    needed_by = "" if missing == package else f", which {package} needs,"
    return f"{missing}{needed_by} is not installed"
