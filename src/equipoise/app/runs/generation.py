"""Write the program of a micro-controller for a testbed, with a test vector of a simulated run."""

from dataclasses import dataclass
from importlib.resources import files
from pathlib import Path

from equipoise.io.files.atomic_file import check_folder, write_folder
from equipoise.model.arrays import Vector3
from equipoise.model.testbed import Testbed
from equipoise.onboard.files import files_of
from equipoise.onboard.sources.boards import verdicts
from equipoise.onboard.sources.translated import translated
from equipoise.simulation.bench import SimulatedBench

SEED = 1  # of the platform that the test vector is simulated with


@dataclass(frozen=True, slots=True)
class Generated:
    """What was written, and on which boards it fits."""

    paths: tuple[Path, ...]
    boards: tuple[str, ...]  # a line each


def board_templates() -> dict[str, str]:
    """Return the files of a program with their placeholders, by name."""
    folder = files("equipoise.app") / "runs" / "board_files"
    return {each.name: each.read_text(encoding="utf-8") for each in folder.iterdir()}


def generate(method: str, law: str, testbed: Testbed, target: Vector3, out: Path) -> Generated:
    """Write a program's files into a folder; InputError for a testbed on which it cannot run."""
    check_folder(out)
    program = translated(method, law, testbed, target)
    written = files_of(program, board_templates(), SimulatedBench(testbed, SEED))
    return Generated(tuple(write_folder(out, written)), tuple(verdicts(program)))
