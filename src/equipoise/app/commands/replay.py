"""`equipoise replay`: a recording played back."""

from typing import TYPE_CHECKING

from equipoise.app.arguments.options import WHOLE, Flag, Reading
from equipoise.app.console.terminal import announced, stdout

if TYPE_CHECKING:
    from equipoise.app.live.observed_bench import Onlooker


def replay(
    file: str,
    /,
    *,
    testbed: str,
    speed: float = 1.0,
    foxglove: Flag = False,
    reading: Reading = WHOLE,
) -> int:
    """Play a recording back in the terminal.

    Where output is not a terminal, one line is printed for every second of the recording.

    Parameters
    ----------
    file
        Recording, in any format that `equipoise convert` reads.
    testbed
        Testbed file, or a preset's name.
    speed
        Seconds of the recording per second; 0: as fast as possible.
    foxglove
        Also serve it to Foxglove, Lichtblick or PlotJuggler on this computer.
    """
    from contextlib import ExitStack

    from equipoise.app.arguments.checks import not_negative
    from equipoise.app.arguments.inputs import fitting_recording_of, testbed_from
    from equipoise.app.live.replay import begun, replayed, shown_lines

    not_negative("--speed", speed)
    bed = announced(testbed_from(testbed))
    recording = fitting_recording_of(file, reading, bed)
    pace, zero_ns = begun(recording, speed)
    with ExitStack() as stack:
        onlookers: dict[str, Onlooker] = {"the terminal": stack.enter_context(shown_lines(bed))}
        if foxglove:
            from equipoise.io.mcap.foxglove_server import LAYOUT, LiveView

            view = stack.enter_context(LiveView(zero_ns, bed))
            stdout().print(f"Foxglove WebSocket: {view.address}; layout: {LAYOUT}")
            onlookers["the live view"] = view.rows
        replayed(bed, recording, pace, onlookers)
    return 0
