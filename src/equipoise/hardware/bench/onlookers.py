"""Those who see what happens, each alone: who fails is dropped, and nobody else notices.

What a bench's safety rests on is no onlooker: it stands in front of them, and does not wait.
"""

from collections.abc import Callable
from typing import Generic, TypeVar

from equipoise.model.errors import EquipoiseError

Each = TypeVar("Each")


class Onlookers(Generic[Each]):
    """Onlookers by name; ``lost`` is called with the name of one that failed, and its error.

    What ``lost`` raises goes through: to it a loss may be the end of all.
    """

    def __init__(self, lost: Callable[[str, Exception], None]) -> None:
        self._lost, self._all = lost, list[tuple[str, Each]]()

    def __len__(self) -> int:
        """Return how many look on."""
        return len(self._all)

    def add(self, name: str, onlooker: Each) -> None:
        """Let one more look on."""
        self._all.append((name, onlooker))

    def hand_on(self, report: Callable[[Each], None], to: str | None = None) -> None:
        """Report to each, or to those of a name."""
        for entry in tuple(self._all):
            name, onlooker = entry
            gone = not any(entry is each for each in self._all)  # lost while another's loss was met
            if gone or to not in (None, name):
                continue
            try:
                report(onlooker)
            except Exception as error:
                self._all = [each for each in self._all if each is not entry]
                self._lost(name, error)


def why_lost(name: str, error: Exception) -> str:
    """Return a sentence on an onlooker that failed."""
    if isinstance(error, EquipoiseError):
        return str(error)
    return f"{name}: failed, the bench goes on without: {error!r}"
