"""A sensor's own settings, each checked for the type that its driver needs."""

from collections.abc import Iterable, Sequence

from equipoise.model.errors import InputError, nearest
from equipoise.model.hardware import SensorUnit


class Settings:
    """The settings of a unit; ``known`` are the keys that its driver has."""

    def __init__(self, unit: SensorUnit, known: Sequence[str]) -> None:
        self._values, self._where = unit.settings, f"hardware.sensor {unit.name}: settings"
        for key in unit.settings:
            if key not in known:
                raise self.wrong(f"'{key}'", nearest(key, list(known)))

    def wrong(self, found: str, wanted: str) -> InputError:
        """Return the error for a setting, to be raised."""
        return InputError(self._where, found, wanted)

    def text(self, key: str, default: str = "", among: Sequence[str] = ()) -> str:
        """Return a text; one of ``among`` if that is not empty."""
        value = self._values.get(key, default)
        if not isinstance(value, str):
            raise self.wrong(f"{key} {value}", "a text in quotes")
        if among and value not in among:
            raise self.wrong(f"{key} '{value}'", nearest(value, list(among)))
        return value

    def positive(self, key: str) -> float | None:
        """Return a number greater than zero; None if it is not given."""
        value = self._values.get(key)
        if value is None or (type(value) in (int, float) and float(value) > 0):  # type: ignore[arg-type]
            return None if value is None else float(value)  # type: ignore[arg-type]
        raise self.wrong(f"{key} {value}", "a number greater than zero")

    def names(self, key: str) -> tuple[str, ...]:
        """Return a list of texts; empty if it is not given."""
        value = self._values.get(key, ())
        texts = value if isinstance(value, tuple) else ()
        found = tuple(each for each in texts if isinstance(each, str))
        if not isinstance(value, tuple) or len(found) < len(texts):
            raise self.wrong(f"{key} {value}", 'a list such as ["a", "b"]')
        return found


def check_gives(unit: SensorUnit, can: Iterable[str], how: str) -> None:
    """Raise InputError if a unit is to give what it cannot; ``how`` says what would help."""
    for channel in unit.gives:
        if channel not in can:
            where = f"hardware.sensor {unit.name}: gives"
            raise InputError(where, f"'{channel}'", how)
