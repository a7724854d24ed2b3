"""What the app takes from others as JSON: reports and runs of folders, requests of a page."""

import contextlib
import dataclasses
import functools
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from equipoise.app.dashboard.protocol import requests
from equipoise.app.report.html import html
from equipoise.app.report.saved_report import DOCUMENT, saved_document
from equipoise.app.text.blocks import (
    Column,
    Document,
    Heading,
    Item,
    Items,
    Pairs,
    Paragraph,
    Row,
    Section,
    Table,
    text_of_document,
)
from equipoise.io.documents.run_file import read_run, text_of_run
from equipoise.model.errors import InputError
from equipoise.model.estimate import Parameter
from equipoise.model.logged_run import RUN, LoggedRun, Usability
from tests.support.fuzz_target import Target, folder
from tests.support.structured_bytes import Shake, document, one, several, value

BLOCKS = (
    Heading("a heading"),
    Paragraph("a paragraph"),
    Items((Item("good"), Item("bad"))),
    Pairs((("name", "text"),)),
    Table("a table", (Column("a"), Column("b", "right")), (Row(("1", "2")),)),
)
REQUESTS = (
    requests.Balance((0.0, 0.0, -1e-4), (2e-6, 2e-6, 3e-6), "measure_and_move"),
    requests.Identify("auto"),
    requests.Jog("x1", 0.001),
    requests.Mark("a person came in"),
    requests.Record(True),
    requests.Pause(True),
    requests.Speed(2.0),
    requests.Anew(3),
    requests.Replay("recordings/run.mcap"),
    requests.Seek(12.0),
)


def inside(name: str, read: Callable[[Path], object]) -> Callable[[bytes], None]:
    """Return what a reader does with a file of a run's folder."""

    def take(content: bytes) -> None:
        place = folder() / "run"
        place.mkdir(exist_ok=True)
        (place / name).write_bytes(content)
        with contextlib.suppress(InputError):
            read(place)

    return take


def shown(place: Path) -> None:
    """A report that is read can be shown."""
    found = saved_document(place)
    if not found.figures:
        html(found, {})


def checked_request(content: bytes) -> None:
    """A request is one that keeps to the schema, or it is refused."""
    found: Any = json.loads(content)
    kind = type(REQUESTS[found["kind"]])
    with contextlib.suppress(InputError, TypeError):  # a class takes no more values than it has
        made = kind(**{str(name): each for name, each in found["values"].items()})
        requests.sound(made)


def request(_content: bytes, rng: np.random.Generator) -> bytes:
    """Draw a request with one value that is none."""
    kind = int(rng.integers(len(REQUESTS)))
    values = dataclasses.asdict(REQUESTS[kind])
    values[one(rng, list(values))] = one(
        rng, (value(rng), None, [], {}, [value(rng)] * 3, {"a": 1}, True, "x" * 9999, -1, 2**70)
    )
    return json.dumps({"kind": kind, "values": values}).encode()


@functools.cache
def run_of_ours() -> bytes:
    """Return a run as it is filed."""
    found = Parameter("com_z", "m", -1e-4, 1e-6)
    run = LoggedRun(
        "2026-01-01_balance_bed", "balance", "2026-01-01T00:00:00+00:00", "bed", "0" * 64,
        "measure_and_move", "simulated", Usability.USABLE, "balanced", (found,), (found,), 21.0,
        {"python": "3.11"},
    )  # fmt: skip
    return text_of_run(run).encode()


def report_of_ours() -> bytes:
    """Return a report with every block that has no figure."""
    return text_of_document(Document("a run", "bed", (Section("all", BLOCKS),))).encode()


TARGETS = (
    Target("report", report_of_ours, inside(DOCUMENT, shown)),
    Target("run", run_of_ours, inside(RUN, read_run)),
    Target(
        "request",
        functools.partial(bytes, b'{"kind": 1, "values": {"method": "auto"}}'),
        checked_request,
    ),
)
SHAKES: dict[str, Shake] = {
    "report": several(document),
    "run": several(document),
    "request": request,
}
