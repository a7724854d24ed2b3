"""`equipoise dashboard`: a live page of a simulated bench, a recording or the real bench."""

from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING

from equipoise.app.arguments.options import WHOLE, Flag, Reading, Whole
from equipoise.app.console.terminal import announced, busy, stdout
from equipoise.model.errors import InputError

if TYPE_CHECKING:
    from equipoise.app.dashboard.runner.runner_process import Opening

LOOPBACK = "127.0.0.1"
EVERYWHERE = ("0.0.0.0", "::", "*", "")


def dashboard(
    shown: str = "nanosat",
    /,
    *,
    testbed: str | None = None,
    seed: Whole = 1,
    bench: Flag = False,
    reading: Reading = WHOLE,
    port: Whole = 8080,
    expose: str | None = None,
) -> int:
    """Show a bench live in the browser, balance it from there, or replay a recording.

    Anyone who opens the page can observe. Commands require the token that is printed here, and one
    page at a time has control. Closing the page changes nothing on the bench. Ctrl-C ends the
    dashboard and halts every mass.

    Parameters
    ----------
    shown
        Testbed file or a preset's name: its simulated platform, or with --bench the real one. Or a
        recording, or the folder of a run, to replay.
    testbed
        For a recording: testbed file, or a preset's name.
    seed
        Seed of the simulated platform.
    bench
        Show the real bench of the testbed's [hardware].
    port
        Port on this computer; 0: any free one.
    expose
        Address of this computer at which others may open the page, such as 192.168.1.5. The token
        is then also required to observe. If omitted: this computer only.
    """
    from equipoise.app.arguments.checks import seed_of
    from equipoise.model.optional_libraries import extra_library

    if not 0 <= port < 65536:
        raise InputError("--port", str(port), "0 to 65535")
    if expose is not None and (expose in EVERYWHERE or not _is_address(expose)):
        raise InputError("--expose", f"'{expose}'", "one address of this computer")
    opening = _opening(shown, testbed, seed_of(seed), bench, reading)
    with busy("starting the dashboard", announce=False):
        extra_library("nicegui", "dashboard", "a page to serve", "dashboard")
        from equipoise.app.dashboard.server.session import open_session

        session = open_session(opening, expose or LOOPBACK, port, expose is not None)
    with session:
        for line in session.lines():
            stdout().print(line, soft_wrap=True)
        with suppress(KeyboardInterrupt):  # the way to end it
            session.serve()
    return 0


def _is_address(text: str) -> bool:
    """Say whether a text may be an address: no socket takes another, each says so in its way."""
    try:
        return text.isascii() and text.isprintable() and bool(text.encode("idna"))
    except UnicodeError:
        return False


def _opening(
    shown: str, testbed: str | None, seed: int, bench: bool, reading: Reading
) -> "Opening":
    """Return what to begin with: a run's folder, a recording, or a testbed."""
    from equipoise.app.arguments.inputs import (
        check_of_recording,
        fitting_recording_of,
        testbed_from,
    )
    from equipoise.app.arguments.recorded_run import files_shown, is_recorded
    from equipoise.app.bench.emulation import hardware_of
    from equipoise.app.dashboard.protocol.data_folder import data_folder
    from equipoise.app.dashboard.runner.runner_process import Opening

    if testbed is not None or is_recorded(Path(shown)):
        shown, testbed = files_shown(shown, testbed)
    if testbed is None:
        check_of_recording(reading, None, "a recording to show")
        bed = announced(testbed_from(shown))
        if bench:
            hardware_of(bed)
        return Opening(bed, data_folder(), seed, bench)
    if bench:
        raise InputError("--bench", "a recording", "a testbed")
    bed = announced(testbed_from(testbed))
    recording = fitting_recording_of(shown, reading, bed)
    return Opening(bed, data_folder(), seed, False, recording, shown)
