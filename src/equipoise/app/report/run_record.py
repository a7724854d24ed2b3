"""All that a report tells of one run."""

import importlib.metadata
import platform
import shlex
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from datetime import datetime

from equipoise.app.figures.catalogue import Picture
from equipoise.app.text.before_after import Change
from equipoise.app.text.sheet import Sheet
from equipoise.model.estimate import Estimate
from equipoise.model.finding import Finding
from equipoise.model.step import Step
from equipoise.model.testbed import Testbed
from equipoise.model.verdict import Verdict
from equipoise.model.version import __version__

LIBRARIES = ("numpy", "scipy", "numba", "matplotlib")


@dataclass(frozen=True, slots=True, eq=False)
class Account:
    """What was asked, of what platform, what was done, and what came of it."""

    title: str
    requested: Mapping[str, str]
    testbed: Testbed
    chapters: Mapping[str, Sequence[Step]]  # each with its own clock
    origin: Mapping[str, str]
    findings: Sequence[Finding] = ()
    estimate: Estimate | None = None  # the mass properties to report
    verdict: Verdict | None = None
    change: Change | None = None
    pictures: Sequence[Picture] = field(default=())
    sheets: Sequence[Sheet] = ()
    step_pictures: Mapping[Step, Picture] = field(default_factory=dict[Step, Picture])


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
