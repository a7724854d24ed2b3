"""Who commands is killed in the middle of a move: the masses stand within a second.

In real time and through real ports: this process is the far side of every wire.
"""

import contextlib
import os
import signal
import subprocess
import sys
import time
from dataclasses import replace

import numpy as np
import pytest

from equipoise.app.bench.emulation import emulate
from equipoise.app.bench.open_bench import KeptBench, Wanted
from equipoise.app.runs.balancing import halted
from equipoise.hardware.bench.controller_process import DistantKeeper
from equipoise.hardware.bench.real_bench import RealBench
from equipoise.hardware.bench.stop_signals import STOPPING
from equipoise.hardware.bench.wall_clock import WallClock
from equipoise.io.mcap.live_recording import RecordingStopped
from equipoise.io.testbed.presets import read_preset
from equipoise.io.testbed.testbed_file import write_testbed
from equipoise.model.errors import BenchStopped
from tests.support import thorough

COMMANDER = """
import sys, time
from pathlib import Path
from equipoise.app.bench.open_bench import Wanted, real_bench
from equipoise.io.testbed.testbed_file import read_testbed

def main():
    wanted = Wanted(read_testbed(sys.argv[1]), Path(sys.argv[2]))
    with real_bench(wanted, lambda: None) as bench:
        bench.move({"x": 0.014})
        print(bench._keeper._process.pid, flush=True)
        while True:
            bench.read(0.1)

if __name__ == "__main__":
    main()
"""


MOMENTS = thorough.count(300, 60)
AGAIN = 2.0  # s, chosen: until a person who sees that nothing stops presses again
TRIES = 4  # chosen: a real-time test on a computer that does other things too


def without_switches():
    """Return the preset with a board that needs no homing, and a platform that may swing."""
    bed = read_preset("nanosat")
    (board,) = bed.hardware.boards
    hardware = replace(bed.hardware, boards=(replace(board, homing=False),))
    return replace(bed, hardware=hardware, tilt_limit=3.0)


def turned(bench, clock, until, longest):
    """Let the emulated bench go on with the clock on the wall until something is so."""
    end = clock.now + longest
    while not until():
        assert clock.now < end, "it did not come about"
        bench.run(clock.now)
        clock.wait()


def under_way(bench):
    return bench.platform.displacements[0] > 2e-3


@pytest.mark.skipif(os.name == "nt", reason="no pseudo terminals, no SIGKILL")
@pytest.mark.parametrize("victim", thorough.some(["commander", "keeper"], 1))
def test_a_killed_process_leaves_the_masses_standing_within_a_second(tmp_path, victim):
    for _ in range(TRIES):
        if stands_after_a_kill(tmp_path, victim):
            return
    pytest.fail("the computer was too busy for real time: no move came under way")


def stands_after_a_kill(tmp_path, victim):
    """Return False if the commander was stopped before the kill, by a device that paused."""
    bench = emulate(without_switches(), 1)
    bench.platform.read(0.01)  # compiles, so that no device pauses later
    clock = WallClock()
    write_testbed(bench.testbed(), tmp_path / "t.toml")
    (tmp_path / "commander.py").write_text(COMMANDER)
    arguments = [
        str(tmp_path / name) for name in ("commander.py", "t.toml", f"run{time.time_ns()}.mcap")
    ]
    with subprocess.Popen([sys.executable, *arguments], stdout=subprocess.PIPE) as commander:
        turned(bench, clock, lambda: under_way(bench) or commander.poll() is not None, 60.0)
        if commander.poll() is not None:
            bench.close()
            return False
        keeper = int(commander.stdout.readline())
        os.kill(commander.pid if victim == "commander" else keeper, signal.SIGKILL)
        killed = clock.now
        turned(bench, clock, lambda: clock.now > killed + 1.0, 2.0)
        at = bench.platform.displacements[0]
        turned(bench, clock, lambda: clock.now > killed + 1.5, 2.0)
        commander.kill()
    assert bench.platform.displacements[0] == at < 9e-3  # 1.75 s of way, killed after 0.25
    bench.close()
    return True


@pytest.mark.skipif(os.name == "nt", reason="no pseudo terminals, no SIGKILL")
def test_any_call_to_a_dead_bench_controller_raises_bench_stopped():
    """Whatever is asked, it is a stop in words; and no more is said of the devices."""
    there = emulate(without_switches(), 1)
    keeper = DistantKeeper(there.testbed(), KeptBench, Wanted(there.testbed(), None))
    bench = RealBench(keeper, keeper)
    assert [each.device for each in bench.health()] == ["board masses", "sensor imu"]
    os.kill(keeper._process.pid, signal.SIGKILL)
    keeper._process.join()
    for request in (
        lambda: bench.read(1.0), lambda: bench.read(0.0), bench.stop, bench.watch,
        lambda: bench.move({"x": 0.0}),
    ):  # fmt: skip
        with pytest.raises(BenchStopped, match="the keeper of the bench has ended"):
            request()
    assert halted(bench) == "the keeper of the bench has ended"  # as Ctrl-C's account has it
    assert bench.health() == []
    keeper.close()
    there.close()


@pytest.mark.skipif(os.name == "nt", reason="no signals between processes")
def test_a_keeper_leaves_signals_to_its_commander_and_ends_with_it():
    """A service or a terminal that ends tells the whole group: masses are halted in order."""
    with running() as bench:
        keeper = bench._keeper._process
        for number in STOPPING:
            os.kill(keeper.pid, number)
        assert [each.device for each in bench.health()] == ["board masses", "sensor imu"]
    keeper.join(30.0)  # a computer that is busy ends it later
    assert keeper.exitcode == 0


@pytest.mark.skipif(os.name == "nt", reason="no SIGSTOP")
def test_a_keeper_that_says_nothing_more_is_not_waited_for():
    with running() as bench:
        bench.watch()
        keeper = bench._keeper._process.pid
        os.kill(keeper, signal.SIGSTOP)
        try:
            with pytest.raises(BenchStopped, match="has not spoken for 5 s"):
                bench.read(60.0)
        finally:
            os.kill(keeper, signal.SIGCONT)


def test_a_record_that_cannot_be_completed_is_reported_in_words(tmp_path, capsys):
    """As on a disk that is full at the very end: nobody is left to report it to."""
    there = emulate(without_switches(), 1)
    kept = KeptBench(Wanted(there.testbed(), tmp_path / "run.mcap"))
    kept._held.push(lambda *_: fail())
    kept.close()
    assert "run.mcap: recording stopped (No space left)" in capsys.readouterr().err
    there.close()


def fail():
    raise RecordingStopped("run.mcap", "No space left")


class KeptWithItsDevices(KeptBench):
    """A kept bench and its emulated devices in one process, so that no pause parts the two."""

    def __init__(self, seed):
        there = emulate(without_switches(), seed)
        there.platform.read(0.01)  # compiles
        super().__init__(Wanted(there.testbed(), None))
        self._held.callback(there.close)
        turn = self.keeper.turn
        self.keeper.turn = lambda t: (there.run(t), turn(t))


@contextlib.contextmanager
def running():
    """Return a bench of emulated devices that go with the clock on the wall, and its keeper."""
    keeper = DistantKeeper(without_switches(), KeptWithItsDevices, 1)
    try:
        yield RealBench(keeper, keeper)
    finally:
        keeper.close()


@pytest.mark.skipif(os.name == "nt", reason="no interval timers")
@pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning")
def test_ctrl_c_at_any_moment_leaves_the_bench_at_command():
    """Of so many moments: without whole messages one of 200 broke the pipe; without numbers every
    second answer was taken for another command's. Python itself loses a KeyboardInterrupt that
    comes up in the callback of a weak reference and only warns: then Ctrl-C is pressed again.
    (Such references are made by the shape checks of tests; without these none was lost.)"""
    rng = np.random.default_rng(0)
    before = signal.signal(signal.SIGALRM, lambda *_: signal.raise_signal(signal.SIGINT))
    try:
        with running() as bench:
            bench.start()
            bench.watch()
            for k in range(MOMENTS):
                with pytest.raises(KeyboardInterrupt):  # noqa: PT012
                    signal.setitimer(signal.ITIMER_REAL, rng.uniform(1e-4, 0.02), AGAIN)
                    while True:
                        bench.health() if k % 2 else bench.read(2e-3)
                signal.setitimer(signal.ITIMER_REAL, 0.0)
                bench.stop()
                assert [each.device for each in bench.health()] == ["board masses", "sensor imu"]
    finally:
        signal.signal(signal.SIGALRM, before)


def test_ports_are_free_again_after_a_kill(tmp_path):
    """The lock goes with the process; the record of before can be read."""
    from equipoise.hardware.bench.port_lock import commanding

    script = "import os, signal\nfrom equipoise.hardware.bench.port_lock import commanding\n"
    script += "with commanding(['tcp:x:1']):\n    os.kill(os.getpid(), signal.SIGKILL)\n"
    subprocess.run([sys.executable, "-c", script], check=False)
    with commanding(["tcp:x:1"]):  # else BenchTaken: nobody waits for a lock
        pass
