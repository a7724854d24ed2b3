"""What each verb returns, once for all tests of the front door."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

import equipoise as eq
from tests.support import thorough

MOVES = [(15.0, {"z1": -0.050})]
SHORT = {"duration": 30.0, "moves": MOVES}
LINEAR = "momentum_laboratory"
PARTS = """name = "A block on a wire"

[[part]]
name = "block"
shape = "box"
mass_g = 14000
size_mm = [500, 400, 300]
centre_mm = [0, 0, -1]

[[oscillation]]
name = "upright"
axis = [0, 0, 1]
stiffness_N_m = 0.1
period_s = 13.74
"""


@dataclass(frozen=True)
class Returned:
    """The files that verbs read, and what they returned."""

    recording: Path
    results: dict[str, Any]


def briefly_planned():
    with pytest.MonkeyPatch.context() as patch:
        thorough.few_platforms(patch)
        return eq.plan("reference-table", duration=8.0, trials=2, seed=2)


def parts_file(path):
    path.write_text(PARTS, encoding="utf-8")
    return path


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
        "identify several": eq.identify(eq.simulate(bed, **SHORT, series=3), bed),
        "assess": eq.assess(recording, "sputnix", require_torque=1e-2),
        "observe": eq.observe(recording, bed),
        "design": eq.design(bed, durations=[60.0]),
        "balance": eq.balance(bed, seed=1, target=(0.0, 0.0, -100.0 / 1e6), max_moves=1),
        "plan": briefly_planned(),
        "compare": eq.compare(bed, methods=True, only=[LINEAR], runs=1, duration=30.0),
        "methods": eq.methods(),
        "laws": eq.laws(),
        "inertia": eq.inertia(parts_file(path.with_name("parts.toml"))),
    }
    results["Estimate"] = results["identify"].estimate
    results["keep"] = eq.keep(eq.SimulatedBench(eq.preset("nanosat"), seed=2), 130.0)
    results["ledger"] = eq.ledger(recording, results["assess"].estimate, bed)
    return Returned(path, results)
