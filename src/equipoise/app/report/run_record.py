"""A run as it is handed over: to the terminal, as JSON, as a report, to a logbook."""

import importlib.metadata
import platform
import shlex
import sys
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from datetime import datetime

from equipoise.app.figures.catalogue import Picture
from equipoise.app.text.blocks import Blocks, Section
from equipoise.app.text.charts import Drawn
from equipoise.app.text.json_shape import View
from equipoise.model.estimate import Estimate
from equipoise.model.logged_run import Kind
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed
from equipoise.model.verdict import Verdict
from equipoise.model.version import __version__

LIBRARIES = ("numpy", "scipy", "numba", "matplotlib")


@dataclass(frozen=True, slots=True, eq=False)
class RunRecord:
    """What was requested, of what platform, and what came of it; the blocks name the pictures."""

    title: str
    requested: Mapping[str, str]
    testbed: Testbed
    conclusion: Blocks  # comes first in a report
    sections: Sequence[Section]
    origin: Mapping[str, str]
    figures: Sequence[Picture] = ()  # in a section of their own
    step_figures: Sequence[Picture] = ()  # beside steps, which name them
    charts: Sequence[Drawn] = ()  # in place of the figures of their names, and behind
    files: Mapping[str, str | bytes] = field(default_factory=dict[str, str | bytes])  # beside it


@dataclass(frozen=True, slots=True, eq=False)
class Logged:
    """What a logbook keeps of a run beside its report."""

    kind: Kind
    method: str
    bench: str
    recording: Recording | None  # what was read
    estimate: Estimate | None = None
    verdict: Verdict | None = None
    is_file: bool = False  # the recording came from a file, which stays where it is


@dataclass(frozen=True, slots=True, eq=False)
class Output:
    """What a command hands over: the same blocks are printed and, with figures, reported."""

    name: str  # of its JSON document
    document: View
    blocks: Blocks
    record: Callable[[], RunRecord]  # drawing its figures takes a while
    logged: Logged | None = None  # None: no logbook keeps it


def origin(**more: str) -> dict[str, str]:
    """Return where results come from: command, versions, time; and what is given by name."""
    made_by = {name: importlib.metadata.version(name) for name in LIBRARIES}
    libraries = ", ".join(f"{name} {version}" for name, version in made_by.items())
    return {
        "command to repeat": shlex.join(["equipoise", *sys.argv[1:]]),
        **more,
        "equipoise": __version__,
        "made with": f"Python {platform.python_version()}, {libraries}, on {platform.system()}",
        "made at": datetime.now().astimezone().isoformat(timespec="seconds"),
    }
