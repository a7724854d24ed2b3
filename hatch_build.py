"""The build of a wheel or a source archive: the libraries of the dashboard's page are in it.

Without them the page draws nothing, and nobody would notice before it is opened: then nothing is
built. An editable install takes them from make.
"""

import sys
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

sys.path.insert(0, str(Path(__file__).resolve().parent / "web"))
import page_libraries


class PageLibraries(BuildHookInterface):  # type: ignore[type-arg]
    """Fetches the libraries where they are not there yet."""

    PLUGIN_NAME = "custom"

    def dependencies(self) -> list[str]:
        """Return what fetching them takes, where it is needed."""
        is_needed = not page_libraries.are_there() and page_libraries.npm_command() is None
        return [page_libraries.NODE] if is_needed else []

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Fetch what lacks; the build fails where that cannot be done."""
        if version != "editable" and not page_libraries.are_there():
            page_libraries.fetch()
