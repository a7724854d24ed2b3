"""What each verb returns, once for all tests of the front door."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

import equipoise as eq

MOVES = [(15.0, {"z1": -0.050})]
LINEAR = "momentum_laboratory"


@dataclass(frozen=True)
class Returned:
    """The files that verbs read, and what they returned."""

    recording: Path
    results: dict[str, Any]


@pytest.fixture(scope="session")
def returned(tmp_path_factory) -> Returned:
    """Return results of all verbs on one short recording of the preset."""
    path = tmp_path_factory.mktemp("api") / "run.csv"
    eq.write_recording(eq.simulate("sputnix", duration=30.0, moves=MOVES, seed=1), path)
    recording, bed = eq.read_recording(path), eq.preset("sputnix")
    results = {
        "Recording": recording,
        "Testbed": bed,
        "MassProperties": bed.body,
        "identify": eq.identify(path, bed, method=LINEAR),
        "assess": eq.assess(recording, "sputnix", require_torque=1e-2),
        "observe": eq.observe(recording, bed),
        "design": eq.design(bed, durations=[60.0]),
        "balance": eq.balance(bed, seed=1, target=(0.0, 0.0, -100.0 / 1e6), max_moves=1),
        "plan": eq.plan(bed, duration=30.0, trials=3, seed=2),
        "compare": eq.compare(bed, methods=True, only=[LINEAR], runs=1, duration=30.0),
        "methods": eq.methods(),
        "laws": eq.laws(),
    }
    results["Estimate"] = results["identify"].estimate
    return Returned(path, results)
