"""A newcomer's path, walked and timed: install, a CSV of one's own, five answers, the result.

    python -m tests.docs.newcomer [WHEEL]

With a wheel, the path begins in a fresh virtual environment; without one, at this Python. What a
person reads is counted (README's section on installing, the tutorial, what the commands print), and
what a person types. Machine time is processor time of the commands, so that a machine with other
work states it alike; it depends on the machine.
"""

import contextlib
import os
import subprocess
import sys
import tempfile
import venv
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

from tests.support.odd_table import odd_table
from tests.support.pseudo_terminal import AtTerminal, stripped

ROOT = Path(__file__).parents[2]
READING = 200.0  # words a minute; assumed: technical prose, read once
TYPING = 40.0  # words of five letters a minute; assumed: no trained typist
INSTALL = "pip install equipoise"
# 4 kg, some 20 x 21 x 30 cm; no motors; the board's own attitude and gyro.
ANSWERS = ("4.0", "200 215 300", "0", "imu", "log.csv")
COMMANDS = (
    "equipoise import log.csv --testbed my.toml --out run.csv",
    "equipoise identify run.csv --testbed my.toml --prior --out identified",
)
CLAIMED_PERSON, CLAIMED_MACHINE = 15.0, 2.0  # min


@dataclass
class Walk:
    """What came of the path."""

    texts: list[str] = field(default_factory=list)  # read
    typed: list[str] = field(default_factory=list)
    seconds: dict[str, float] = field(default_factory=dict)  # of a processor

    @property
    def words(self) -> int:
        """Number of words that are read."""
        return sum(len(text.split()) for text in self.texts)

    @property
    def letters(self) -> int:
        """Number of keys that are pressed."""
        return sum(len(line) + 1 for line in self.typed)

    @property
    def reading(self) -> float:
        """Minutes of reading."""
        return self.words / READING

    @property
    def typing(self) -> float:
        """Minutes of typing."""
        return self.letters / 5 / TYPING

    @property
    def machine(self) -> float:
        """Minutes of a processor."""
        return sum(self.seconds.values()) / 60

    @contextlib.contextmanager
    def timed(self, what: str) -> Iterator[None]:
        """Count the time of a step."""
        begun = processor_time()
        yield
        self.seconds[what] = processor_time() - begun


def processor_time() -> float:
    """Return processor time (s) of the programs that were started here and have ended."""
    spent = os.times()
    return spent.children_user + spent.children_system


def section(page: str, title: str) -> str:
    """Return the text below a heading, up to the next of its kind."""
    return page.split(f"\n## {title}\n")[1].split("\n## ")[0]


def installed(wheel: Path, folder: Path) -> Path:
    """Return the Python of a fresh environment with the wheel in it."""
    venv.create(folder, with_pip=True)
    python = folder / "bin" / "python"
    words = [python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", wheel]
    subprocess.run(words, check=True)
    return python


def walk(folder: Path, python: Path) -> Walk:
    """Follow the path in a folder, by a Python that has Equipoise. Raises where a command fails."""
    done = Walk(typed=[INSTALL, "equipoise new", *ANSWERS, *COMMANDS])
    done.texts += [
        section((ROOT / "README.md").read_text(encoding="utf-8"), "Install"),
        (ROOT / "docs" / "tutorial.md").read_text(encoding="utf-8"),
    ]
    (folder / "log.csv").write_text(odd_table())
    program = [str(python), "-m", "equipoise.app.cli"]
    with done.timed("equipoise new"):
        done.texts.append(answered(folder, program))
    for command in COMMANDS:
        with done.timed(" ".join(command.split()[:2])):
            words = [*program, *command.split()[1:]]
            ended = subprocess.run(words, cwd=folder, check=True, text=True, stdout=subprocess.PIPE)
        done.texts.append(ended.stdout)
    return done


class Newcomer(AtTerminal):
    """Somebody at a terminal where Equipoise was just installed."""

    def __init__(self, folder: Path, program: list[str]) -> None:
        self.program = program
        super().__init__(folder, ["new"])


def answered(folder: Path, program: list[str]) -> str:
    """Answer the five questions at a terminal, and return what stood there."""
    person = Newcomer(folder, program)
    for number, answer in enumerate(ANSWERS, start=1):
        person.wait_for(f"{number}. ")
        person.type(f"{answer}\n")
    assert person.ended() == 0, person.written
    return stripped(person.written)


def report(done: Walk) -> Iterator[str]:
    """Yield what the path takes."""
    yield f"{done.words} words to read: {done.reading:.1f} min at {READING:g} words a minute"
    yield f"{done.letters} keys to press: {done.typing:.1f} min at {TYPING:g} words a minute"
    for what, seconds in done.seconds.items():
        yield f"{what}: {seconds:.1f} s of a processor"
    person = done.reading + done.typing
    for what, minutes, claimed in (
        ("reading and typing", person, CLAIMED_PERSON),
        ("machine", done.machine, CLAIMED_MACHINE),
    ):
        holds = "under" if minutes < claimed else "NOT under"
        yield f"{what}: {minutes:.1f} min, {holds} {claimed:g} min"


def main() -> None:
    """Walk the path, and print what it takes."""
    with tempfile.TemporaryDirectory() as place:
        folder, python = Path(place), Path(sys.executable)
        begun = processor_time()
        if len(sys.argv) > 1:
            os.environ.pop("PYTHONPATH", None)  # the wheel alone, and no kernel of before
            os.environ["NUMBA_CACHE_DIR"] = str(folder / "kernels")
            python = installed(Path(sys.argv[1]).resolve(), folder / "environment")
        setting_up = processor_time() - begun
        done = walk(folder, python)
        done.seconds = {"environment and installation": setting_up} | done.seconds
    sys.stdout.write("\n".join([*report(done), ""]))


if __name__ == "__main__":
    main()
