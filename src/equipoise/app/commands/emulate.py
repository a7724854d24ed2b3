"""`equipoise emulate`: a bench of emulated devices, to try the real thing without hardware."""

from pathlib import Path
from typing import TYPE_CHECKING

from equipoise.app.arguments.options import Whole
from equipoise.app.console.terminal import announced, busy, stdout

if TYPE_CHECKING:
    from equipoise.app.bench.emulation import EmulatedBench


def emulate(testbed: str, /, *, out: Path, seed: Whole = 1, max_time_s: float | None = None) -> int:
    """Start emulated devices that speak the real protocols.

    The platform is held until its masses are home, and caught when it tilts too far. Devices run
    until Ctrl-C. Other commands reach them through the testbed file that is written: equipoise
    balance OUT --bench.

    Parameters
    ----------
    testbed
        Testbed file with a [hardware] table, or a preset's name.
    out
        Testbed file to write: the same, with the ports of the emulated devices.
    seed
        Random seed; the same seed gives the same platform.
    max_time_s
        Stop after this time.
    """
    from equipoise.app.arguments.checks import positive, seed_of
    from equipoise.app.arguments.inputs import testbed_from
    from equipoise.app.bench.emulation import emulate as emulated
    from equipoise.io.testbed.testbed_file import write_testbed
    from equipoise.simulation.bench import SimulatedBench

    bed, drawn = announced(testbed_from(testbed)), seed_of(seed)
    with busy("preparing the platform", announce=False):
        SimulatedBench(bed, drawn).read(1.0)  # compiles: a device that pauses seems unplugged
    longest = positive("--max-time-s", max_time_s) or float("inf")
    bench = emulated(bed, drawn)
    try:
        bed = bench.testbed()
        write_testbed(bed, out)
        assert bed.hardware is not None
        for device in bed.hardware.units:
            stdout().print(f"{device.name}: {device.driver} at {device.port.address}")
        stdout().print(f"wrote {out}; Ctrl-C ends the emulation")
        _run(bench, longest)
    finally:
        bench.close()
    return 0


def _run(bench: "EmulatedBench", longest: float) -> None:
    """Run as the clock on the wall does, until then or until Ctrl-C."""
    from equipoise.hardware.bench.wall_clock import WallClock
    from equipoise.model.units import UM

    clock = WallClock()
    try:
        while clock.now < longest:
            bench.run(clock.now)
            if bench.has_fallen:
                bench.catch()
            clock.wait()
    except KeyboardInterrupt:
        pass
    com = ", ".join(f"{x / UM:.2f}" for x in bench.platform.truth().com)
    stdout().print(f"the emulation has ended; the true centre of mass is at ({com}) um")
