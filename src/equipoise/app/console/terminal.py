"""What a person sees at the terminal: results on stdout, progress and errors on stderr."""

import itertools
import signal
import sys
from collections.abc import Callable, Generator, Iterator, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING

from equipoise.app.console.stop_request import stoppable
from equipoise.app.text.escaping import for_one_line, for_terminal
from equipoise.model.units import MINUTE

if TYPE_CHECKING:
    from pathlib import Path

    from rich.console import Console, RenderableType
    from rich.progress import TaskID, TextColumn

    from equipoise.model.step import Step
    from equipoise.model.testbed import Testbed

COMPILING = "compiling kernels, once"
_DRAWN: list["_SignOfLife"] = []
REFRESHES = 8.0  # Hz, chosen: as often as a person can follow, at little cost


def stdout() -> "Console":
    """Return the console for results; cut off from a terminal, lines are not folded at 80."""
    from equipoise.app.console.plain_console import PlainConsole

    console = PlainConsole(soft_wrap=False)
    return console if console.is_terminal else PlainConsole(width=120)


def stderr() -> "Console":
    """Return the console for everything else; while a sign of life is drawn, the one it is on.

    What that one prints stands above; another would print into the middle of what is drawn.
    """
    return _DRAWN[-1].console if _DRAWN else _new_stderr()


def _new_stderr() -> "Console":
    from equipoise.app.console.plain_console import PlainConsole

    return PlainConsole(stderr=True, soft_wrap=True)


def complain(sentence: str) -> None:
    """Print what is wrong, in one line."""
    from equipoise.app.console.plain_console import shown

    if sys.stderr is not None:
        stderr().print(shown("equipoise:", "bold red").append(f" {for_one_line(sentence)}", ""))


def print_whole(text: str) -> None:
    """Print a text for a program to read or a person to copy: no line is folded."""
    print(for_terminal(text))


def announced(testbed: "Testbed") -> "Testbed":
    """Return a testbed, having printed what reading it had to set right."""
    for reason in testbed.mended:
        notice(reason.sentence)
    return testbed


def notice(sentence: str) -> None:
    """Print what a person should know, and need not act upon."""
    stderr().print(f"~ {sentence}")


def agreed(question: str) -> bool:
    """Ask a person; anything but yes is no, and so is nobody there."""
    try:
        return reply_to(f"{question} [y/n] ").lower() in ("y", "yes")
    except EOFError:
        return False


def reply_to(question: str) -> str:
    """Print a question and return what a person types; EOFError where the input ends."""
    stderr().print(question, end="")
    return input().strip()


@contextmanager
def busy(
    what: str, announce: bool = True, above: "RenderableType | None" = None
) -> Generator[None]:
    """Show on stderr that something is being done, and when it is the compiler that takes long.

    Cut off from a terminal, ``announce`` says whether its beginning is printed, and what would
    stand ``above`` is not shown.
    """
    from equipoise.maths.kernels.compile_events import compiler_notices

    sign = _SignOfLife(what, announce, above)

    with stoppable((signal.SIGINT,)) as requests:
        try:
            with requests.put_off():
                sign.begin()
            with compiler_notices(lambda: sign.say(f"{what}: {COMPILING}"), lambda: sign.say(what)):
                yield
        finally:
            with requests.put_off():
                sign.end()


class _SignOfLife:
    """A line that moves at a terminal, below what it is about; elsewhere each text once."""

    def __init__(self, text: str, announce: bool, above: "RenderableType | None") -> None:
        from rich.console import Group
        from rich.live import Live
        from rich.spinner import Spinner

        self.console, self._announce, self._said = _new_stderr(), announce, list[str]()
        self._what = text
        plain = self.console.options.ascii_only
        self._line = Spinner("line" if plain else "dots", style="status.spinner")
        shown = self._line if above is None else Group(above, self._line)
        self._live = Live(shown, console=self.console, refresh_per_second=REFRESHES, transient=True)
        self.say(text)

    def begin(self) -> None:
        _DRAWN.append(self)
        self._live.start(refresh=True)

    def end(self) -> None:
        _DRAWN.remove(self)
        self._live.stop()

    def say(self, text: str) -> None:
        from equipoise.app.console.plain_console import shown

        self._line.update(text=shown(f"{text} ..."))
        if self._announce and not self.console.is_interactive and text not in self._said:
            self._said.append(text)
            self.console.print(f"{text} ...")

    def say_stage(self, stage: str) -> None:
        self.say(f"{self._what}: {stage}")


def say_what_is_done(stage: str) -> None:
    """Show what a search is at, beside what is being done."""
    if _DRAWN:
        _DRAWN[-1].say_stage(stage)


@contextmanager
def counted(what: str) -> "Generator[Callable[[float], None]]":
    """Show progress on stderr; the function that is yielded takes the share that is done."""
    from rich.progress import BarColumn, Progress, TaskProgressColumn, TimeElapsedColumn

    columns = (_described(), BarColumn(), TaskProgressColumn(), TimeElapsedColumn())
    with Progress(*columns, console=_announcing(what), transient=True) as progress:
        bar = progress.add_task(for_terminal(what), total=1.0)
        yield lambda share: progress.update(bar, completed=share)


def _announcing(what: str) -> "Console":
    """Return the console for progress; cut off from a terminal it says once what is done."""
    console = stderr()
    if not console.is_terminal:
        console.print(f"{what} ...")
    return console


def _described() -> "TextColumn":
    """Return the column of a progress line that names what is done, without markup."""
    from rich.progress import TextColumn

    return TextColumn("{task.description}", markup=False)


@contextmanager
def counted_pieces(what: str) -> "Generator[Callable[[int, int], None]]":
    """Show on stderr how many pieces of work are done, at what rate, and the time that is left.

    The function that is yielded takes how many are done and of how many; what it takes first was
    there before.
    """
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TimeRemainingColumn

    columns = (_described(), BarColumn(), MofNCompleteColumn(), _rate(), TimeRemainingColumn())
    with Progress(*columns, console=_announcing(what), transient=True) as progress:
        bar: TaskID | None = None

        def report(done: int, total: int) -> None:
            nonlocal bar
            if bar is None:
                bar = progress.add_task(for_terminal(what), total=total, completed=done)
            progress.update(bar, completed=done)

        yield report


def _rate() -> "TextColumn":
    """Return the column of a progress line that says how many are done in a second or a minute."""
    from rich.progress import Task, TextColumn
    from rich.text import Text

    class RateColumn(TextColumn):
        """The rate of the last while; nothing as long as it is not known."""

        def render(self, task: Task) -> Text:
            return Text(rate_text(task.finished_speed or task.speed))

    return RateColumn("")


def rate_text(rate: float | None) -> str:
    """Return a rate (1/s) as a person reads it: in a second, or in a minute where that is slow."""
    if not rate:
        return ""
    return f"{rate:.3g}/s" if rate >= 1 else f"{rate * MINUTE:.3g}/min"


def watched(
    steps: "Iterator[Step]", what: str, above: "RenderableType | None" = None
) -> "Iterator[Step]":
    """Return the steps of a procedure, with a sign of life while each is awaited."""
    for count in itertools.count():
        with busy(what, announce=count == 0, above=above):
            step = next(steps, None)
        if step is None:
            return
        yield step


def show_paths(paths: "Sequence[Path]", aside: bool = False) -> None:
    """Say what was written; aside from the results when those are a JSON document.

    Of a folder within the folder of the others only the number of its files.
    """
    console, top = stderr() if aside else stdout(), min(len(path.parts) for path in paths)
    for folder in dict.fromkeys(path.parent for path in paths if len(path.parts) > top):
        number = sum(path.parent == folder for path in paths)
        console.print(f"wrote {number} files in {folder}", soft_wrap=True)
    for path in paths:
        if len(path.parts) == top:
            console.print(f"wrote {path}", soft_wrap=True)
