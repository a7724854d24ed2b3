"""Equipoise: mass properties and balance of a satellite mock-up on an air bearing.

`import equipoise as eq` is the front door: every name below, and nothing else, is public. A name
is loaded when it is first used, so that the import itself takes no time.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from equipoise.model.from_memory import make_with
from equipoise.model.presentation import present_with
from equipoise.model.version import __version__

if TYPE_CHECKING:
    from equipoise.app.api.assess import assess
    from equipoise.app.api.balance import balance
    from equipoise.app.api.calibrate import calibrate
    from equipoise.app.api.catalogues import laws, methods
    from equipoise.app.api.compare import compare
    from equipoise.app.api.design import design
    from equipoise.app.api.export import export
    from equipoise.app.api.feed_forward import feed_forward
    from equipoise.app.api.files import preset, read_recording, read_testbed, write_recording
    from equipoise.app.api.identify import identify
    from equipoise.app.api.inertia import inertia
    from equipoise.app.api.keep import keep
    from equipoise.app.api.ledger import ledger
    from equipoise.app.api.observe import observe
    from equipoise.app.api.open_bench import open_bench
    from equipoise.app.api.plan import plan
    from equipoise.app.api.simulate import simulate
    from equipoise.model.errors import InputError
    from equipoise.model.estimate import Estimate
    from equipoise.model.mass_properties import MassProperties
    from equipoise.model.recording import Recording
    from equipoise.simulation.bench import SimulatedBench

VERBS = ("identify", "assess", "observe", "balance", "plan", "design", "calibrate", "compare",
         "keep", "simulate", "open_bench", "inertia", "export", "feed_forward",
         "ledger")  # fmt: skip
HOMES = {verb: f"equipoise.app.api.{verb}" for verb in VERBS} | {
    "read_testbed": "equipoise.app.api.files",
    "preset": "equipoise.app.api.files",
    "read_recording": "equipoise.app.api.files",
    "write_recording": "equipoise.app.api.files",
    "methods": "equipoise.app.api.catalogues",
    "laws": "equipoise.app.api.catalogues",
    "SimulatedBench": "equipoise.simulation.bench",
    "MassProperties": "equipoise.model.mass_properties",
    "Recording": "equipoise.model.recording",
    "Estimate": "equipoise.model.estimate",
    "InputError": "equipoise.model.errors",
}

__all__ = [
    "Estimate",
    "InputError",
    "MassProperties",
    "Recording",
    "SimulatedBench",
    "__version__",
    "assess",
    "balance",
    "calibrate",
    "compare",
    "design",
    "export",
    "feed_forward",
    "identify",
    "inertia",
    "keep",
    "laws",
    "ledger",
    "methods",
    "observe",
    "open_bench",
    "plan",
    "preset",
    "read_recording",
    "read_testbed",
    "simulate",
    "write_recording",
]


def __getattr__(name: str) -> Any:
    """Return a public name from the module that has it; AttributeError for any other."""
    if name not in HOMES:
        raise AttributeError(f"module 'equipoise' has no attribute '{name}'")
    value = getattr(import_module(HOMES[name]), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    """Return the public names."""
    return sorted(__all__)


def _presenter() -> Any:
    """Return what shows records; it is loaded when a record is first shown."""
    from equipoise.app.presentation import presenter

    return presenter


def _maker() -> Any:
    """Return what makes recordings; it is loaded when one is first made of arrays or tables."""
    from equipoise.app.api import made_recordings

    return made_recordings


present_with(_presenter)
make_with(_maker)
