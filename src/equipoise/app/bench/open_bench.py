"""A real bench as a command uses it: wired, locked, recorded, in a process of its own."""

from collections.abc import Callable, Generator, Mapping
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path

from equipoise.app.bench.emulation import hardware_of
from equipoise.app.bench.port_check import check_reachable
from equipoise.app.console.terminal import complain, stderr
from equipoise.hardware.actuators.registry import ACTUATORS
from equipoise.hardware.bench.bench_controller import Keeper
from equipoise.hardware.bench.controller_process import DistantKeeper
from equipoise.hardware.bench.open_port import open_port
from equipoise.hardware.bench.port_lock import commanding
from equipoise.hardware.bench.real_bench import RealBench
from equipoise.hardware.bench.wall_clock import WallClock
from equipoise.hardware.boards.registry import BOARDS
from equipoise.hardware.links.actuator_link import ActuatorLink
from equipoise.hardware.links.device_links import BoardLink, Links
from equipoise.hardware.links.sensor_link import SensorLink
from equipoise.hardware.sensors.registry import DRIVERS
from equipoise.hardware.transport.driver_protocol import driver_named
from equipoise.hardware.transport.reconnecting_port import Connection, Opener
from equipoise.io.mcap.foxglove_server import ADDRESS, LAYOUT, LiveView
from equipoise.io.mcap.live_recording import LiveRecording, Opening
from equipoise.io.testbed.testbed_file import text_of_testbed
from equipoise.model.errors import EquipoiseError
from equipoise.model.hardware import Gives
from equipoise.model.testbed import Testbed

HAND = 1.0  # s, chosen: for a hand to leave the platform


@dataclass(frozen=True, slots=True, eq=False)
class Wanted:
    """What the keeper's process is given when it begins."""

    testbed: Testbed
    record: Path | None  # MCAP file to write; None: no record
    live: bool = False  # serve all of it to Foxglove too


class KeptBench:
    """A keeper, its clock and its record, in the process that has the ports."""

    def __init__(self, wanted: Wanted) -> None:
        self._held, self.clock = ExitStack(), WallClock()
        try:
            self.keeper = self._begun(wanted)
        except BaseException:
            self._held.close()
            raise

    def _begun(self, wanted: Wanted) -> Keeper:
        hardware = hardware_of(wanted.testbed)
        units = hardware.units
        self._held.enter_context(commanding([unit.port.address for unit in units]))
        check_reachable(hardware)
        keeper = keeper_of(wanted.testbed)
        if wanted.record is not None:
            drivers = {unit.name: unit.driver for unit in units}
            text = text_of_testbed(wanted.testbed)
            opening = Opening(self.clock.begun_ns, text, wanted.testbed, drivers)
            keeper.listen(self._held.enter_context(LiveRecording(wanted.record, opening)))
        if wanted.live:
            view = self._held.enter_context(LiveView(self.clock.begun_ns, wanted.testbed))
            keeper.listen(view, "the live view")
        self._held.callback(keeper.close)  # comes first: masses stop, and the record has it
        return keeper

    def close(self) -> None:
        """Stop every mass, close ports, end the record; report in a sentence what fails then."""
        try:
            self._held.close()
        except EquipoiseError as error:
            complain(str(error))


def keeper_of(testbed: Testbed, opener: Opener = open_port) -> Keeper:
    """Return the keeper of a testbed's hardware; ports are opened at its first turn."""
    hardware = hardware_of(testbed)
    boards = [
        BoardLink(
            board,
            driver_named(BOARDS, board.driver, "board")(board, testbed.masses),
            Connection(board.port, opener),
        )
        for board in hardware.boards
    ]
    sensors = [
        SensorLink(
            unit,
            driver_named(DRIVERS, unit.driver, "sensor")(unit),
            Connection(unit.port, opener),
            periods_of(testbed),
        )
        for unit in hardware.sensors
    ]
    actuators = [
        ActuatorLink(
            unit,
            driver_named(ACTUATORS, unit.driver, "actuator")(unit, testbed.devices),
            Connection(unit.port, opener),
            testbed.devices,
        )
        for unit in hardware.actuators
    ]
    return Keeper(testbed, hardware, Links(boards, sensors, actuators))


def periods_of(testbed: Testbed) -> dict[Gives, float]:
    """Return how far apart rows of each channel are, s; 0 where nothing is stated."""
    stated: dict[Gives, float | None] = {
        "attitude": None if testbed.attitude is None else testbed.attitude.rate,
        "rate": None if testbed.gyro is None else testbed.gyro.rate,
    }
    return {channel: 1.0 / rate if rate else 0.0 for channel, rate in stated.items()}


def sent_back(bench: RealBench, standing: Mapping[str, float]) -> None:
    """Send masses from home to where they stood (m), and wait until they are there."""
    bench.move(standing)
    ways = [abs(standing[mass.name]) / mass.speed for mass in bench.testbed.masses]
    bench.read(max(ways, default=0.0) + HAND)


@contextmanager
def real_bench(
    wanted: Wanted,
    let_go: Callable[[], None] | None = None,
    standing: Mapping[str, float] | None = None,
) -> Generator[RealBench]:
    """Return the bench, ready: every device answers, masses are at home, sensors give rows.

    ``let_go`` is called when masses are at home, or at displacements (m) where they stood before;
    the platform is taken to be free ``HAND`` later. Without it masses stay where they are, and
    nothing can be moved.
    When the block ends, however it ends, masses are halted and the record is closed.
    """
    distant = DistantKeeper(wanted.testbed, KeptBench, wanted)
    try:
        bench = RealBench(distant, distant)
        if let_go is not None:
            bench.start()
            if standing is not None:
                sent_back(bench, standing)
            let_go()
            bench.read(HAND)
        bench.watch()
        if wanted.live:
            stderr().print(f"Foxglove WebSocket: {ADDRESS}; layout: {LAYOUT}")
        yield bench
        for sentence in bench.lost:
            complain(sentence)
        for each in bench.health():
            stderr().print(each.sentence, style="red" if each.wrong else None)
    finally:
        distant.close()
