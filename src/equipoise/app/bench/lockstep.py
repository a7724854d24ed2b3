"""A clock that lets an emulated bench go on by one tick whenever somebody waits.

The bench then runs as fast as the computer can, and nothing is late because something else took
long: a tick ends when all that was sent has been read.
"""

from equipoise.app.bench.emulation import EmulatedBench
from equipoise.app.bench.open_bench import keeper_of
from equipoise.hardware.bench.real_bench import RealBench

TICK = 0.02  # s, chosen: as often as a row of 50 Hz


class LockstepClock:
    """Time of the emulated devices."""

    def __init__(self, emulated: EmulatedBench, tick: float = TICK) -> None:
        self._emulated, self._tick = emulated, tick

    @property
    def now(self) -> float:
        """Now, s."""
        return self._emulated.time

    def wait(self) -> None:
        """Let one tick pass."""
        self._emulated.run(self.now + self._tick)


def lockstep_bench(emulated: EmulatedBench, tick: float = TICK) -> RealBench:
    """Return the real bench at an emulated one's ports, both on one clock."""
    return RealBench(keeper_of(emulated.testbed()), LockstepClock(emulated, tick))
