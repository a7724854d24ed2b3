"""The file of a balancing by hand: the goal, every recording, and the loading after it.

It gets a round with every recording; a person's remarks stay. A person who placed something else
than was asked for puts it right here, under ``placed``: all that lies on the platform, not what
was added.
"""

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

from pydantic import Field

from equipoise.io.columns.read_options import BAD_ROWS
from equipoise.io.files.atomic_file import write_whole
from equipoise.io.files.source_file import read_text
from equipoise.io.toml.key_types import Table, Triple
from equipoise.io.toml.read_toml import read_toml
from equipoise.io.toml.write_toml import edited
from equipoise.model.arrays import Ints
from equipoise.model.errors import InputError, nearest
from equipoise.model.testbed import Testbed
from equipoise.model.weights import places_of, unloaded

WANTED = "a session of balance --manual (TOML)"
PILE = re.compile(r"\s*(?P<count>\d{1,4})\s*x\s*(?P<weight>\S+)\s+at\s+(?P<place>\S+)\s*")


class Round(Table):
    """A recording, and what lay on the platform after it."""

    recording: str
    sha256: str = ""
    from_s: float | None = None
    to_s: float | None = None
    dialect: str | None = None
    columns: str | None = None
    topic: list[str] = Field([])
    body: str | None = None
    instance: int | None = None
    bad_rows: float = BAD_ROWS
    max_memory_mb: float | None = None
    placed: list[str] | None = Field(None, description="such as '3 x washer at deck:I6'")


class Session(Table):
    """A balancing by hand so far."""

    testbed: str
    target_um: Triple
    tolerance_um: Triple
    max_rounds: Annotated[int, Field(ge=1)]
    then_masses: bool = False
    round: list[Round] = Field([])


@dataclass(frozen=True, slots=True, eq=False)
class Piles:
    """From lines to loadings and back, for one testbed."""

    testbed: Testbed

    def loading(self, lines: list[str], where: str) -> Ints:
        """Return the loading that lines describe; InputError names the line that cannot be."""
        bed = self.testbed
        places, kinds = [p.name for p in places_of(bed.grids)], [w.name for w in bed.weights]
        found = unloaded(bed.grids, bed.weights)
        for line in lines:
            read = PILE.fullmatch(line)
            if read is None:
                raise InputError(where, f"'{line}'", "a line such as '3 x washer at deck:I6'")
            for name, known in ((read["weight"], kinds), (read["place"], places)):
                if name not in known:
                    raise InputError(where, f"'{name}' in '{line}'", nearest(name, known))
            found[places.index(read["place"]), kinds.index(read["weight"])] += int(read["count"])
        return found

    def lines(self, loading: Ints) -> list[str]:
        """Return a loading as lines."""
        bed, rows = self.testbed, zip(*loading.nonzero(), strict=True)
        places = places_of(bed.grids)
        return [f"{loading[p, k]} x {bed.weights[k].name} at {places[p].name}" for p, k in rows]


def read_session(path: Path) -> Session:
    """Return the session of a file."""
    return read_toml(path, Session, WANTED)


def write_session(session: Session, path: Path) -> None:
    """Write a session, whole or not at all; of a file that is there all else stays."""
    text = read_text(path, WANTED) if path.exists() else ""
    keys = session.model_dump(exclude_none=True, exclude_defaults=True)
    write_whole(path, edited(text, keys))
