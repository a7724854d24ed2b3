"""Testbed files that ship with the package, one for each testbed in the papers."""

from importlib.resources import files

from equipoise.io.testbed.testbed_file import parse_testbed
from equipoise.model.errors import InputError, nearest
from equipoise.model.testbed import Testbed

SUFFIX = ".toml"
FOLDER = files("equipoise.io.testbed.presets")


def preset_names() -> tuple[str, ...]:
    """Return the names, in alphabetical order."""
    found = [entry.name for entry in FOLDER.iterdir() if entry.name.endswith(SUFFIX)]
    return tuple(sorted(name.removesuffix(SUFFIX) for name in found))


def preset_text(name: str) -> str:
    """Return a preset's text, comments and all, to start one's own file from."""
    if name not in preset_names():
        raise InputError("preset", f"'{name}'", nearest(name, list(preset_names())))
    return (FOLDER / f"{name}{SUFFIX}").read_text(encoding="utf-8")


def read_preset(name: str) -> Testbed:
    """Return a preset as a testbed."""
    return parse_testbed(preset_text(name), f"preset {name}")
