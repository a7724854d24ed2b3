"""Numbers among the settings of a camera; InputError says which one is none."""

from collections.abc import Mapping

from equipoise.model.errors import InputError
from equipoise.model.hardware import Setting

MOST = 1e9  # chosen: of no lens or board is any number so large


def number(
    settings: Mapping[str, Setting], key: str, where: str, usual: float | None = None
) -> float:
    """Return a number; ``usual`` if it is not stated."""
    value = settings.get(key, usual)
    if value is None:
        raise InputError(where, f"no key '{key}'", f"'{key}': a number")
    if isinstance(value, (bool, str, tuple)) or not abs(value) <= MOST:
        raise InputError(f"{where}.{key}", f"{value!r}", f"a number, at most {MOST:g}")
    return float(value)


def whole(settings: Mapping[str, Setting], key: str, where: str, usual: int | None = None) -> int:
    """Return a whole number; ``usual`` if it is not stated."""
    value = number(settings, key, where, usual)
    if value != int(value):
        raise InputError(f"{where}.{key}", f"{value:g}", "a whole number")
    return int(value)
