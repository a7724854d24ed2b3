"""By what many runs are carried out, and where their results are kept."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from equipoise.app.engine.kept_results import KeptResults
from equipoise.app.engine.pool import Engine, in_this_process
from equipoise.app.engine.spread import NOTHING_KEPT, Keeping


def unsaid(_sentence: str) -> None:
    """Say it to nobody."""


@dataclass(frozen=True, slots=True, eq=False)
class Running:
    """An engine, and the folder that keeps results; None: they are not kept."""

    engine: Engine = in_this_process
    folder: Path | None = None
    notice: Callable[[str], None] = unsaid  # takes what is to be said of kept files

    def kept(self, name: str, question: Mapping[str, object], key: Callable[[Any], str]) -> Keeping:
        """Return what keeps the results of a question, in a folder of that name."""
        if self.folder is None:
            return NOTHING_KEPT
        return KeptResults(self.folder / name, question, key, self.notice)


ALONE = Running()
