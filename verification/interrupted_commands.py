"""Commands are interrupted (SIGINT) at random moments of their work; how do they end?

`balance --bench` works on a bench of emulated devices, which is another program. Afterwards its
board is asked, as by hand at a terminal, where its masses are: do they stand?
"""

import signal
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from equipoise.app.cli import BY_HAND
from verification.emulated_board import answers_of, emulating, goes_on
from verification.result import Result, Row, Spread, at_least, at_most, in_turn

BEGUN = "begun"
PROGRAM = f"""
import signal, sys
signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell in the background ignores it
from equipoise.app.cli import main
if __name__ == "__main__":
    print("{BEGUN}", file=sys.stderr, flush=True)
    main()
"""
WRITTEN = "--out", "written"
COMMANDS = {  # and until when a moment is drawn, s; chosen: most of the work, its end left out
    "plan": (("plan", "nanosat", "--trials", "300", *WRITTEN), 8.0),
    "identify": (("identify", "run.csv", "--testbed", "nanosat", *WRITTEN), 6.0),
    "balance": (("balance", "nanosat", *WRITTEN), 6.0),
    "balance --bench": (
        ("balance", "there.toml", "--bench", "--yes", *WRITTEN),
        25.0,
    ),
}
ON_BENCH = "--bench"
LEFT = 60.0  # s, chosen: for a command to end


@dataclass(frozen=True, slots=True)
class Interrupted:
    """How a command ended that was interrupted."""

    command: str
    moment: float  # s after its beginning
    code: int  # negative: the signal that killed it
    finished: bool  # before the signal came
    traceback: bool
    answers: tuple[str, ...] = ()  # of the board afterwards: its state and where its masses are
    said: str = ""

    @property
    def crashed(self) -> bool:
        """Say whether a signal killed it that nobody sent."""
        return self.code < 0 and self.code != -signal.SIGINT

    @property
    def astray(self) -> bool:
        """Say whether it ended by itself, otherwise than by Ctrl-C.

        Once all is written the system ends it: shells call that 130, too.
        """
        return not (self.finished or self.crashed) and self.code not in (BY_HAND, -signal.SIGINT)

    @property
    def goes_on(self) -> bool:
        """Say whether a mass moves afterwards."""
        return goes_on(self.answers)


def interrupted(seed: int) -> Interrupted:
    """Begin the command of a seed, interrupt it, and look at what it left."""
    name = list(COMMANDS)[seed % len(COMMANDS)]
    words, longest = COMMANDS[name]
    moment = np.random.default_rng(seed).uniform(0.0, longest)
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        (folder / "program.py").write_text(PROGRAM)
        if ON_BENCH in words:
            return _on_a_bench(folder, name, moment, seed)
        if name == "identify":
            _run(folder, "simulate", "nanosat", "--out", "run.csv", "--duration-s", "60",
                 "--seed", str(seed))  # fmt: skip
        return _ended(folder, name, moment)


def _begun(folder: Path, *words: str) -> "subprocess.Popen[str]":
    program = [sys.executable, "program.py", *words]
    pipe = subprocess.PIPE
    return subprocess.Popen(program, cwd=folder, stdout=pipe, stderr=pipe, text=True)


def _run(folder: Path, *words: str) -> int:
    with _begun(folder, *words) as command:
        command.communicate()
        return command.returncode


def _ended(folder: Path, name: str, moment: float) -> Interrupted:
    words, _ = COMMANDS[name]
    with _begun(folder, *words) as command:
        assert command.stderr is not None
        while BEGUN not in command.stderr.readline():
            pass
        early = _over_after(command, moment)
        command.send_signal(signal.SIGINT)
        try:
            said, complained = command.communicate(timeout=LEFT)
        except subprocess.TimeoutExpired:
            command.kill()
            said, complained = command.communicate()
    finished = early or (command.returncode in (0, 1) and "run.json" in said)
    return Interrupted(
        name, moment, command.returncode, finished,
        "Traceback" in complained, said=complained[-2000:],
    )  # fmt: skip


def _over_after(command: "subprocess.Popen[str]", moment: float) -> bool:
    """Let so long (s) pass; say whether the command is over by then."""
    time.sleep(moment)
    return command.poll() is not None


def _on_a_bench(folder: Path, name: str, moment: float, seed: int) -> Interrupted:
    """Add whether the bench's masses stand."""
    with emulating(folder, seed):
        found = _ended(folder, name, moment)
        return replace(found, answers=answers_of(folder))


def measure(seeds: Sequence[int], spread: Spread = in_turn) -> Result:
    """Interrupt as many commands as there are seeds."""
    runs = spread(interrupted, seeds)
    n = len(runs)
    claim = (
        f"{', '.join(COMMANDS)} (the last on a bench of emulated devices) are interrupted by "
        f"Ctrl-C at {n} random moments of their work: no interpreter crashes, every mass stands, "
        f"the exit code is {BY_HAND}."
    )
    rows: tuple[Row, ...] = (
        at_most("interpreters that crashed", sum(run.crashed for run in runs), 0, "d"),
        at_most(f"other exit codes than {BY_HAND}", sum(run.astray for run in runs), 0, "d"),
        at_most("tracebacks", sum(run.traceback for run in runs), 0, "d"),
        at_most("benches whose masses go on", sum(run.goes_on for run in runs), 0, "d"),
        at_least("interrupted before they had finished", sum(not r.finished for r in runs), n // 2,
                 "d"),
    )  # fmt: skip
    counts = Counter(run.command for run in runs if not run.finished)
    shares = ", ".join(f"{name} {number}" for name, number in counts.items())
    wrong = [run for run in runs if run.crashed or run.astray or run.traceback or run.goes_on]
    notes = [
        ": ".join((f"{run.command} after {run.moment:.2f} s", f"code {run.code}", *run.answers))
        for run in wrong
    ]
    return Result("interrupted_commands", claim, rows, (f"Interrupted: {shares}.", *notes))
