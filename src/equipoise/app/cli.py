"""The door for people: commands, exit codes, and one sentence for whatever goes wrong.

0: done, and the verdict passed. 1: done, and the verdict failed or the estimate is not usable.
2: wrong use or bad input. 3: an error that nobody has foreseen; a sentence names its crash file.
130: stopped by Ctrl-C, 143: by SIGTERM, 129: by SIGHUP, each after the same halt and account. No
numerical library is imported here; each command imports what it needs when it runs.
"""

import sys
from collections.abc import Callable, Sequence
from io import TextIOWrapper

from cyclopts import App, CycloptsError, Group, Parameter

from equipoise.app.arguments.wrong_use import wrong_use
from equipoise.app.commands.assess import assess
from equipoise.app.commands.balance import balance
from equipoise.app.commands.calibrate import calibrate
from equipoise.app.commands.calibrate_camera import calibrate_camera
from equipoise.app.commands.check import check
from equipoise.app.commands.compare import compare
from equipoise.app.commands.convert import convert
from equipoise.app.commands.dashboard import dashboard
from equipoise.app.commands.demo import demo
from equipoise.app.commands.design import design
from equipoise.app.commands.devices import devices
from equipoise.app.commands.emulate import emulate
from equipoise.app.commands.export import export
from equipoise.app.commands.generate import generate
from equipoise.app.commands.identify import identify
from equipoise.app.commands.import_ import import_
from equipoise.app.commands.inertia import inertia
from equipoise.app.commands.inspect import inspect
from equipoise.app.commands.keep import keep
from equipoise.app.commands.laws import laws
from equipoise.app.commands.ledger import ledger
from equipoise.app.commands.logbook import logbook
from equipoise.app.commands.methods import methods
from equipoise.app.commands.new import new
from equipoise.app.commands.observe import observe
from equipoise.app.commands.plan import plan
from equipoise.app.commands.precompile import precompile
from equipoise.app.commands.print_board import print_board
from equipoise.app.commands.record import record
from equipoise.app.commands.repair import repair
from equipoise.app.commands.replay import replay
from equipoise.app.commands.report import report
from equipoise.app.commands.reproduce import reproduce
from equipoise.app.commands.simulate import simulate
from equipoise.app.commands.track import track
from equipoise.app.console.last_catch import (
    catch_threads,
    report_crash,
    show_libraries_words,
)
from equipoise.app.console.lasting_output import lasting
from equipoise.app.console.stop_request import cause_of, exit_code_of, leave_to_system, stoppable
from equipoise.app.console.terminal import complain
from equipoise.model.errors import EquipoiseError, Implausible, UnforeseenError
from equipoise.model.version import __version__

WRONG_USE = 2
UNFORESEEN = 3
BY_HAND = 130  # what shells give a program that Ctrl-C ended; other signals: 128 and their number
NOT_USABLE = 1  # an outcome, not a wrong use
LEFT_ALONE = 1  # as rich ends a program whose output nobody reads any more

app = App(
    name="equipoise",
    help="Identify the mass properties of a satellite mock-up on an air bearing, and balance it.",
    version=__version__,
    help_format="plaintext",  # the list of commands; reading Markdown is loaded for one's own page
    default_parameter=Parameter(negative=()),
    result_action="return_value",
    suppress_keyboard_interrupt=False,
)
# In the order of a newcomer's path; help shows them so.
GROUPS: dict[str, tuple[Callable[..., int], ...]] = {
    "Start": (demo, new, dashboard),
    "Recordings": (simulate, import_, inspect, convert, repair, replay, track),
    "Identification": (identify, calibrate, inertia, assess, ledger, observe, methods),
    "Balancing": (balance, keep, laws),
    "Planning": (plan, design),
    "Hardware": (devices, check, record, emulate, print_board, calibrate_camera, generate),
    "Studies": (compare, reproduce),
    "Files": (report, logbook, export, precompile),
}
for order, (title, commands) in enumerate(GROUPS.items()):
    group = Group(title, sort_key=order)
    for place, command in enumerate(commands):
        app.command(command, help_format="markdown", group=group, sort_key=place)


def run(arguments: Sequence[str] | None = None) -> int:
    """Carry out a command line and return its exit code; no error of any kind passes it."""
    try:
        with stoppable():
            return _run(arguments)
    except KeyboardInterrupt as stop:  # it came when all was done
        return _stopped(stop)
    except SystemExit:
        raise
    except BaseException as error:  # a library in Rust panics with what is no Exception
        report_crash(error, sys.argv[1:] if arguments is None else arguments)
        return UNFORESEEN


def _run(arguments: Sequence[str] | None) -> int:
    try:
        return app(arguments, exit_on_error=False, print_error=False) or 0
    except CycloptsError as error:
        complain(wrong_use(error))
    except Implausible as error:
        complain(str(error))
        return NOT_USABLE
    except UnforeseenError:
        raise
    except EquipoiseError as error:
        complain(str(error))
    except BrokenPipeError:
        sys.stdout = None  # whoever read our output has left: no further word, no traceback
        return LEFT_ALONE
    except OSError as error:
        complain(f"{error.filename or 'system'}: {error.strerror or error}")
    except KeyboardInterrupt as stop:
        return _stopped(stop)
    return WRONG_USE


def _stopped(stop: KeyboardInterrupt) -> int:
    complain(": ".join((f"stopped by {cause_of(stop)}", *map(str, stop.args))))
    return exit_code_of(stop)


def main() -> None:
    """Run as a program; a terminal that lacks a letter, or is gone, fails nothing."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, TextIOWrapper):
            stream.reconfigure(errors="replace")
    sys.stdout, sys.stderr = lasting(sys.stdout), lasting(sys.stderr)
    show_libraries_words()
    ended_threads = catch_threads(sys.argv[1:])
    code = run()
    leave_to_system()
    sys.exit(UNFORESEEN if ended_threads else code)


if __name__ == "__main__":
    main()
