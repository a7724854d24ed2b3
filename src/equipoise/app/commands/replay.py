"""`equipoise replay`: a recording or a run in the browser, or played back in the terminal."""

from contextlib import suppress
from typing import TYPE_CHECKING

from equipoise.app.arguments.feeding import NOT_FED, Feeding, receiver_of
from equipoise.app.arguments.options import WHOLE, Flag, Reading, Whole
from equipoise.app.console.terminal import announced, busy, stdout
from equipoise.model.errors import InputError

if TYPE_CHECKING:
    from equipoise.app.arguments.feeding import Receiver
    from equipoise.app.arguments.recorded_run import RecordedRun
    from equipoise.app.live.observed_bench import Onlooker


def replay(
    shown: str,
    /,
    *,
    testbed: str | None = None,
    port: Whole = 8080,
    terminal: Flag = False,
    speed: float | None = None,
    foxglove: Flag = False,
    feeding: Feeding = NOT_FED,
    reading: Reading = WHOLE,
) -> int:
    """Open a run or a recording in the browser: the whole of it, with its steps.

    The page plays the motion back, zooms, and saves charts as PNG and CSV. It commands nothing.
    Ctrl-C ends it. With --terminal, --foxglove or --feed-forward the recording is played back at
    its own speed instead. Where output is not a terminal, one line is printed for every second of
    it.

    Parameters
    ----------
    shown
        Folder of a run, or a recording in any format that `equipoise convert` reads.
    testbed
        Testbed file, or a preset's name. If omitted: the testbed of the run.
    port
        Port of the page on this computer; 0: any free one.
    terminal
        Play the recording back in the terminal.
    speed
        In the terminal: seconds of the recording per second, 1 if omitted; 0: as fast as possible.
    foxglove
        Play it in the terminal, and serve it to Foxglove, Lichtblick or PlotJuggler on this
        computer.
    """
    from equipoise.app.arguments.checks import not_negative
    from equipoise.app.arguments.recorded_run import recorded_run

    receiver = receiver_of(feeding)
    paced = terminal or foxglove or receiver is not None
    if speed is not None and not paced:
        raise InputError("--speed", f"{speed:g}", "--terminal with it: the page has its own speed")
    if not 0 <= port < 65536:
        raise InputError("--port", str(port), "0 to 65535")
    run = recorded_run(shown, testbed, reading)
    announced(run.testbed)
    if paced:
        speed = 1.0 if speed is None else not_negative("--speed", speed)
        _played(run, speed, foxglove, receiver)
    else:
        _viewed(run, port)
    return 0


def _viewed(run: "RecordedRun", port: int) -> None:
    """Serve the page until Ctrl-C."""
    from equipoise.io.formats.optional_libraries import extra_library

    with busy("reading the recording", announce=False):
        extra_library("nicegui", "replay", "a page to serve", "dashboard")
        from equipoise.app.dashboard.runner.whole_recording import whole_recording
        from equipoise.app.dashboard.server.viewer import Viewer

        viewer = Viewer(whole_recording(run), port)
    with viewer:
        stdout().print(f"The recording is at {viewer.address}", soft_wrap=True)
        stdout().print("Ctrl-C ends it.")
        with suppress(KeyboardInterrupt):  # the way to end it
            viewer.serve()


def _played(run: "RecordedRun", speed: float, foxglove: bool, receiver: "Receiver | None") -> None:
    """Play a recording back in the terminal, to a viewer that connects, and to a controller."""
    from contextlib import ExitStack

    from equipoise.app.live.feed_forward import DatagramStream, FeedForward, Listener, as_events
    from equipoise.app.live.replay import begun, replayed, shown_lines

    bed = run.testbed
    pace, zero_ns = begun(run.recording, speed)
    with ExitStack() as stack:
        onlookers: dict[str, Onlooker] = {"the terminal": stack.enter_context(shown_lines(bed))}
        listeners = list[Listener]()
        if foxglove:
            from equipoise.io.mcap.foxglove_server import LAYOUT, LiveView

            view = stack.enter_context(LiveView(zero_ns, bed))
            stdout().print(f"Foxglove WebSocket: {view.address}; layout: {LAYOUT}")
            onlookers["the live view"] = view.rows
            listeners.append(as_events(view.event))
        if receiver is not None:
            stream = DatagramStream(receiver.host, receiver.port)
            listeners.append(stack.enter_context(stream))
            onlookers["the feed-forward"] = FeedForward(bed, receiver.given, *listeners)
        replayed(bed, run.recording, pace, onlookers)
