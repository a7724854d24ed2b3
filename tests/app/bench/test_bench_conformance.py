"""Every bench keeps the protocol: simulated, replayed, and real at emulated devices.

The platform is one, the 4 kg nanosatellite; it may swing as far as it likes.
"""

import contextlib
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import pytest

from equipoise.app.live.observed_bench import WatchedBench
from equipoise.hardware.bench.replayed_bench import ReplayedBench
from equipoise.io.testbed.presets import read_preset
from equipoise.model.bench import Bench
from equipoise.model.errors import DriveRefused, InputError, MoveRefused
from equipoise.model.units import MM
from equipoise.simulation.bench import SimulatedBench
from tests.support.board_wire import board_of
from tests.support.emulated_lab import lab, over_tcp

BED = replace(over_tcp(read_preset("nanosat")), tilt_limit=3.0)
RATE = 40.0  # Hz, as the preset states it of both channels
TURN = 0.02 + 1e-9  # s by which a bench with a clock of its own may read longer
LENGTHS = (0.5, 0.013, 1.3, 0.0, 0.2, 2.0)  # s of readings


@dataclass(frozen=True)
class Shown:
    """A bench, and whether its masses obey."""

    bench: Any
    obeys: bool = True


@contextlib.contextmanager
def simulated():
    yield Shown(SimulatedBench(BED, 1))


@contextlib.contextmanager
def replayed():
    yield Shown(ReplayedBench(BED, SimulatedBench(BED, 1).read(20.0)), obeys=False)


def real(kind, as_used=lambda bench: bench):
    @contextlib.contextmanager
    def made():
        board = replace(board_of(kind), port=BED.hardware.boards[0].port)
        hardware = replace(BED.hardware, boards=(board,))
        with lab(replace(BED, hardware=hardware)) as found:
            yield Shown(as_used(found.bench))

    return made


BENCHES = {
    "simulated": simulated,
    "replayed": replayed,
    "real, grbl": real("grbl"),
    "real, tmcl": real("tmcl"),
    "real, watched": real("grbl", lambda bench: WatchedBench(bench, lambda _rows: None, 0.125)),
}


@pytest.fixture(params=BENCHES)
def shown(request):
    with BENCHES[request.param]() as found:
        yield found


def test_it_has_the_verbs_and_knows_its_platform(shown):
    assert isinstance(shown.bench, Bench)
    assert shown.bench.testbed.mass_names == ("x", "y", "z")


def test_each_row_comes_once_in_order_and_not_before_its_time(shown):
    bench, observed = shown.bench, []
    bench.read(0.1)
    begun = bench.time
    for length in LENGTHS:
        start = bench.time
        rows = bench.read(length)
        assert length - 1e-9 <= bench.time - start <= length + 2 * TURN
        for channel in (rows.attitude, rows.rate, rows.masses):
            assert channel is None or np.all(channel.t <= bench.time + 1e-9)
        observed.append(rows)
    for name in ("attitude", "rate"):
        parts = [part for rows in observed if (part := getattr(rows, name)) is not None]
        t = np.concatenate([part.t for part in parts])
        assert np.all(np.diff(t) > 0)
        assert len(t) == pytest.approx(RATE * (bench.time - begun), abs=2)


@pytest.mark.parametrize("duration", [-1.0, float("inf"), float("nan")])
def test_a_time_that_nobody_can_wait_is_refused(shown, duration):
    before = shown.bench.time
    with pytest.raises(InputError, match="zero or more seconds"):
        shown.bench.read(duration)
    assert shown.bench.time == before


REFUSED = {
    "beyond the rail": (
        {"x": 1 * MM, "y": 15.1 * MM}, MoveRefused,
        "mass y: at 0 mm, requested 15.1 mm; its travel is -15 to 15 mm; nothing was moved",
    ),
    "a mass that is not there": (
        {"x": 1 * MM, "w": 0.0}, InputError, "move: found a mass 'w'; wanted one of x, y, z",
    ),
    "no number": (
        {"x": float("nan")}, InputError, "move: mass x: found nan; wanted a displacement in m",
    ),
}  # fmt: skip


@pytest.mark.parametrize("what", REFUSED)
def test_a_move_that_cannot_be_is_refused_whole_in_the_same_words(shown, what):
    targets, error, sentence = REFUSED[what]
    bench = shown.bench
    bench.read(0.1)
    with pytest.raises(error) as refused:
        bench.move(targets)
    assert str(refused.value) == sentence
    rows = bench.read(1.5)
    assert rows.masses is None or not rows.masses.values.any()
    bench.move({"x": 1 * MM})  # it can still be moved


def test_a_device_that_is_not_there_is_refused(shown):
    with pytest.raises(InputError, match="a device 'wheel'"):
        shown.bench.drive({"wheel": 0.0})
    shown.bench.drive({})


def test_masses_that_obey_go_at_their_speed_to_where_they_are_sent(shown):
    bench = shown.bench
    bench.read(0.2)
    bench.move({"x": 4 * MM, "z": -2 * MM})
    if not shown.obeys:
        masses = bench.read(0.25).masses
        assert masses is None or not masses.values.any()  # as was recorded
        return
    half = bench.read(0.25).masses.values[-1]  # 8 mm/s; a board is asked now and then
    assert 0.1 * MM < half[0] <= 2.01 * MM
    assert half == pytest.approx([half[0], 0.0, -half[0]], abs=0.1 * MM)
    end = bench.read(1.5).masses
    assert end.values[-1] == pytest.approx([4 * MM, 0.0, -2 * MM], abs=2e-6)


def test_no_mass_goes_faster_than_a_move_allows_and_later_ones_go_as_usual(shown):
    """At 0.2 mm/s instead of 8 mm/s, x takes 2 s for 0.4 mm, and y as long for the same way."""
    bench = shown.bench
    bench.read(0.2)
    bench.move({"x": 0.4 * MM, "y": -0.4 * MM}, 0.2 * MM)
    if not shown.obeys:
        return
    half = bench.read(1.0).masses.values[-1]
    assert 0.1 * MM < half[0] < 0.25 * MM
    assert half == pytest.approx([half[0], -half[0], 0.0], abs=2e-5)
    assert bench.read(1.6).masses.values[-1] == pytest.approx([0.4 * MM, -0.4 * MM, 0.0], abs=2e-6)
    bench.move({"x": 4 * MM})
    assert bench.read(0.9).masses.values[-1] == pytest.approx([4 * MM, -0.4 * MM, 0.0], abs=2e-6)


@pytest.mark.parametrize("speed", [0.0, -1e-3, float("nan")])
def test_a_speed_at_which_no_mass_arrives_is_refused(shown, speed):
    with pytest.raises(InputError, match=r"more than zero m/s"):
        shown.bench.move({"x": 1 * MM}, speed)
    shown.bench.read(0.1)


def test_who_stops_finds_the_masses_standing(shown):
    bench = shown.bench
    bench.read(0.2)
    bench.move({"y": 14 * MM})
    bench.read(0.5)
    bench.stop()
    if not shown.obeys:
        assert bench.read(1.2).attitude is not None  # it goes on
        return
    stands = bench.read(1.2).masses.values[-1]
    assert 2 * MM < stands[1] < 7 * MM
    later = bench.read(1.5).masses
    assert later is None or np.abs(later.values - stands).max() < 1e-9
    bench.move({"y": 0.0})
    assert bench.read(2.0).masses.values[-1] == pytest.approx(np.zeros(3), abs=2e-6)


TABLE = over_tcp(read_preset("reference-table"))
DRIVEN = replace(
    TABLE,
    tilt_limit=3.0,
    hardware=replace(
        TABLE.hardware,
        boards=tuple(replace(board, homing=False) for board in TABLE.hardware.boards),
    ),
)


@contextlib.contextmanager
def simulated_table():
    yield Shown(SimulatedBench(DRIVEN, 1))


@contextlib.contextmanager
def replayed_table():
    yield Shown(ReplayedBench(DRIVEN, SimulatedBench(DRIVEN, 1).read(20.0)), obeys=False)


@contextlib.contextmanager
def real_table():
    with lab(DRIVEN) as found:
        yield Shown(found.bench)


TABLES = {"simulated": simulated_table, "replayed": replayed_table, "real": real_table}


@pytest.fixture(params=TABLES)
def table(request):
    with TABLES[request.param]() as found:
        yield found


NOT_DRIVEN = {
    "beyond its torque": (
        {"rw_x": 0.001, "rw_y": -0.0051}, DriveRefused,
        "device rw_y: requested -0.0051 N m; its limit is 0.005 N m; nothing was driven",
    ),
    "beyond its dipole": (
        {"mt_z": 0.5}, DriveRefused,
        "device mt_z: requested 0.5 A m^2; its limit is 0.4 A m^2; nothing was driven",
    ),
    "a pulse that is too short": (
        {"jp_x": 0.0001}, DriveRefused,
        "device jp_x: requested 0.0001 N m s at least; its limit is 0.0005 N m s at least; "
        "nothing was driven",
    ),
    "a device that is not there": (
        {"rw_w": 0.0}, InputError, "drive: found a device 'rw_w'; did you mean 'rw_z'?",
    ),
    "no number": (
        {"rw_x": float("inf")}, InputError,
        "drive: device rw_x: found inf; wanted a finite number",
    ),
}  # fmt: skip


@pytest.mark.parametrize("what", NOT_DRIVEN)
def test_a_drive_that_cannot_be_is_refused_whole_in_the_same_words(table, what):
    inputs, error, sentence = NOT_DRIVEN[what]
    bench = table.bench
    bench.read(0.2)
    with pytest.raises(error) as refused:
        bench.drive(inputs)
    assert str(refused.value) == sentence
    rows = bench.read(0.5)
    assert not rows.devices.values.any()
    assert not rows.momentum.values.any()


def test_devices_that_obey_do_what_they_are_given_until_the_bench_stops(table):
    """5 mN m on 0.04 N m s / 628.3 rad/s: 78.5 rad/s^2; 0.3 A m^2; one pulse of 2 mN m s."""
    bench = table.bench
    bench.read(0.5)
    bench.drive({"rw_x": 0.005, "mt_y": -0.3, "jp_z": 0.002})
    first = bench.read(1.0)
    if not table.obeys:
        assert not first.devices.values.any()  # as was recorded
        return
    names = list(first.device_names)
    assert names == list(DRIVEN.device_names)
    wheel, coil, jet = (names.index(name) for name in ("wheel:rw_x", "dipole:mt_y", "jet:jp_z"))
    t, rows = first.devices.t, first.devices.values
    assert np.all(np.diff(t) > 0)
    slope = np.polyfit(t[-20:], rows[-20:, wheel], 1)[0]
    assert slope == pytest.approx(0.005 * 628.3 / 0.04, rel=0.02)
    assert rows[-1, coil] == pytest.approx(-0.3, abs=1e-6)
    impulse = np.sum(np.diff(t, prepend=2 * t[0] - t[1]) * rows[:, jet])
    assert impulse == pytest.approx(0.002, abs=1e-6)
    stored = first.momentum.values[-1, 0]
    assert stored == pytest.approx(rows[-1, wheel] * 0.04 / 628.3, rel=1e-3)
    bench.stop()
    bench.read(0.5)
    after = bench.read(1.0).devices.values
    assert np.abs(after[:, coil]).max() < 1e-9
    assert np.ptp(after[:, wheel]) < 0.5  # its tachometer's noise; 78 rad/s, if it were driven
    bench.drive({"rw_x": -0.005})
    assert np.ptp(bench.read(1.0).devices.values[:, wheel]) > 40.0
