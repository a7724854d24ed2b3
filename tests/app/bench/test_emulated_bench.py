"""The real bench at emulated devices, through real ports: it balances, or stops in words.

Emulated devices and keeper share one clock that goes as fast as it can
(``tests.support.emulated_lab``).
"""

import contextlib
import signal
from dataclasses import replace

import numpy as np
import pytest

from equipoise.app.console.stop_request import stoppable
from equipoise.app.runs import balancing
from equipoise.app.runs.balancing import Goal, Limits, run
from equipoise.hardware.bench.stop_signals import STOPPING
from equipoise.io.mcap.live_recording import RecordingStopped
from equipoise.io.testbed.presets import read_preset
from equipoise.maths.attitude import difference
from equipoise.model.bench import Bench
from equipoise.model.errors import BenchStopped, InputError, MoveRefused
from equipoise.model.hardware import Port
from equipoise.model.reasons.interlocks import Interlock
from equipoise.model.reasons.reason import Reason
from equipoise.model.recording import Samples
from equipoise.model.step import Step
from equipoise.model.units import MM
from equipoise.procedure.balancing.balance import BalanceOptions, balance
from tests.support import emulated_lab, thorough
from tests.support.board_wire import board_of
from tests.support.emulated_lab import over_tcp
from tests.support.faulty_wire import garbage, half, noisy, repeated, silent
from tests.support.outcomes import OBSERVED
from tests.support.sensor_units import NEEDS, PICTURES

BED = over_tcp(read_preset("nanosat"))
# Left to itself it swings far: where balancing is not the matter, it may.
FREE = replace(BED, tilt_limit=3.0)


@contextlib.contextmanager
def lab(bed=FREE, seed=1):
    with emulated_lab.lab(bed, seed) as found:
        yield found


def bed_with(kind):
    """Return the testbed with another kind of motor board."""
    board = replace(board_of(kind), port=BED.hardware.boards[0].port)
    return replace(BED, hardware=replace(BED.hardware, boards=(board,)))


@pytest.mark.parametrize(
    ("kind", "seed"), thorough.some([("grbl", 0), ("grbl", 3), ("tmcl", 0)], 2)
)
def test_it_balances_through_real_ports_and_the_verdict_is_true(kind, seed):
    """As on the simulated bench: (2, 2, 3) um in 3 moves and 120 s, errors as large as stated."""
    options = BalanceOptions()
    with lab(bed_with(kind), seed) as found:
        assert isinstance(found.bench, Bench)
        steps = list(balance(found.bench, options))
        truth = found.emulated.platform.truth().com
        verdict = steps[-1].verdict
        assert verdict.passed
        assert sum(step.move is not None for step in steps) <= options.max_moves
        assert found.emulated.platform.time <= options.max_time
        assert np.all(np.abs(truth - options.target) < options.tolerance)
        # chi-square of three degrees of freedom: beyond 16.3 in one of a thousand
        assert np.sum(((verdict.com - truth) / verdict.sd) ** 2) < 16.3
        assert [k for _, k, _ in found.events if k == "interlock"] == []


def test_rows_are_those_of_the_sensors_and_a_move_is_recorded_as_it_happened():
    with lab() as found:
        found.bench.move({"x": 4 * MM})
        observed = found.bench.read(2.0)
        assert len(observed.attitude) == pytest.approx(80, abs=2)
        assert len(observed.rate) == pytest.approx(80, abs=2)
        assert np.all(np.diff(observed.attitude.t) > 0)
        x = observed.masses.values[:, 0]
        assert x[-1] == pytest.approx(4 * MM, abs=2e-6)
        going = np.flatnonzero(np.diff(x) > 0)
        taken = observed.masses.t[going[-1] + 1] - observed.masses.t[going[0]]
        assert taken == pytest.approx(0.5, abs=0.06)  # 4 mm at 8 mm/s, reported every 50 ms


def with_sensor(driver):
    """Return the testbed with another sensor at its place, and masses that need no homing."""
    hardware = BED.hardware
    address, gives, settings = NEEDS[driver]
    port = Port("tcp:unit:0" if address.startswith("serial:") else address)
    (imu,) = hardware.sensors
    imu = replace(imu, driver=driver, port=port, gives=gives, settings=settings)
    boards = tuple(replace(board, homing=False) for board in hardware.boards)
    return replace(FREE, hardware=replace(hardware, boards=boards, sensors=(imu,)))


@pytest.mark.parametrize("driver", sorted(NEEDS.keys() - PICTURES))
def test_each_sensor_returns_the_rows_given_to_its_remote_side(driver):
    """In number, in time, and in value: attitude and rate come back as they went in."""
    with lab(with_sensor(driver)) as found:
        device, reported = found.imu.device, []
        report = device.messages
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(device, "messages", lambda rows: reported.append(rows) or report(rows))
            found.bench.read(0.0)
            observed = found.bench.read(2.0)
        (link,) = found.keeper.links.sensors
        assert link.driver.counts.corrupt == 0
        for channel in link.unit.gives:
            ours, theirs = joined([observed], channel), joined(reported, channel)
            assert len(ours) == pytest.approx(80, abs=10)
            separation = np.abs(theirs.values[:, None] - ours.values).max(axis=2)
            row = separation.argmin(axis=0)  # noise makes each row one of its kind
            assert separation.min(axis=0).max() < 2e-6
            assert np.all(np.diff(row) == 1)
            assert np.abs(theirs.t[row] - ours.t).max() < 0.021  # at most a tick late


def joined(recordings, channel):
    """Return the rows of one channel of all recordings."""
    parts = [part for each in recordings if (part := getattr(each, channel)) is not None]
    values = np.concatenate([part.values for part in parts])
    return Samples(np.concatenate([part.t for part in parts]), upright(values))


def upright(values):
    """Return quaternions of which each has a positive first number; rates as they are."""
    return values * np.sign(values[:, :1]) if values.shape[1] == 4 else values


def test_a_move_beyond_the_rail_is_refused_and_nothing_moves():
    with lab() as found:
        with pytest.raises(MoveRefused):
            found.bench.move({"x": 1 * MM, "y": 15.1 * MM})
        with pytest.raises(InputError, match="'w'"):
            found.bench.move({"w": 0.0})
        found.bench.read(1.0)
        assert np.all(found.emulated.platform.displacements == 0.0)


def test_stop_halts_masses_where_they_are_and_they_can_go_on():
    with lab() as found:
        found.bench.move({"x": 14 * MM})
        found.bench.read(0.5)
        found.bench.stop()
        found.bench.read(1.0)
        at = found.emulated.platform.displacements[0]
        assert 2 * MM < at < 7 * MM
        found.bench.read(0.5)
        assert found.emulated.platform.displacements[0] == at
        found.bench.move({"x": 0.0})
        assert found.bench.read(3.0).masses.values[-1, 0] == pytest.approx(0.0, abs=2e-6)


def stopped_while_moving(found, trouble, within=2.0):
    """Return the sentence with which a long move ends, and how far it went on afterwards."""
    found.bench.move({"z": -14 * MM})
    found.bench.read(0.4)
    trouble()
    begun = found.emulated.time
    with pytest.raises(BenchStopped) as stop:
        found.bench.read(5.0)
    assert found.emulated.time - begun < within
    found.wait(0.5)
    at = found.emulated.platform.displacements[2]
    found.wait(1.0)
    assert found.emulated.platform.displacements[2] == at > -13 * MM
    return str(stop.value)


def spoil(station, how):
    def put_in():
        station.wire.spoil = how

    return put_in


@pytest.mark.parametrize(
    ("trouble", "said"),
    [
        (lambda lab: spoil(lab.imu, silent), "sensor imu has not delivered a row"),
        (lambda lab: spoil(lab.imu, repeated), "sensor imu has not delivered a row"),
        (lambda lab: spoil(lab.imu, half), "sensor imu has not delivered a row"),
        (lambda lab: spoil(lab.board, silent), "does not answer"),
        (lambda lab: spoil(lab.board, half), "board masses: "),
        (lambda lab: lab.board.device.press_reset, "position is lost"),
        (lambda lab: lab.board.device.hit_limit, "a limit switch was hit"),
        (lambda lab: lambda: lab.board.device.switch(False), "its state (?) was requested"),
        (lambda lab: lab.board.wire.unplug, "its port is gone"),
    ],
)
def test_trouble_in_a_move_stops_the_masses_and_says_why(trouble, said):
    with lab() as found:
        assert said in stopped_while_moving(found, trouble(found))
        with pytest.raises(BenchStopped, match="nothing was moved"):
            found.bench.move({"x": 0.0})


@pytest.mark.parametrize("how", [noisy, garbage])
def test_a_bad_cable_of_the_sensor_costs_rows_and_no_more(how):
    """One byte of a hundred wrong breaks two of three messages of 110 bytes; the rest are rows."""
    with lab() as found:
        found.imu.wire.spoil = how
        observed = found.bench.read(4.0)
        assert 20 <= len(observed.attitude) <= 162
        (link,) = found.keeper.links.sensors
        assert link.driver.counts.corrupt > 10
        turn = np.abs(np.sum(observed.attitude.values[1:] * observed.attitude.values[:-1], axis=1))
        assert np.degrees(2 * np.arccos(np.minimum(turn, 1.0))).max() < 10


def test_a_sensor_that_is_hidden_for_ten_seconds_is_waited_for():
    """Masses stand, so nothing is stopped; a move waits, and the silence is in the record."""
    with lab() as found:
        spoil(found.imu, silent)()
        found.wait(0.6)
        begun = found.emulated.time
        found.clock.at(begun + 10, lambda: spoil(found.imu, None)())
        found.bench.move({"x": 2 * MM})
        assert 10 < found.emulated.time - begun < 11
        said = [sentence for _, kind, sentence in found.events if kind == "interlock"]
        assert said == [
            "sensor imu delivers no row of attitude",
            "sensor imu delivers rows of attitude again",
        ]
        assert found.bench.read(1.0).masses.values[-1, 0] == pytest.approx(2 * MM, abs=2e-6)


def test_a_sensor_that_does_not_come_back_ends_the_run_in_words():
    with lab() as found:
        spoil(found.imu, silent)()
        with pytest.raises(BenchStopped, match="no sensor has delivered a row for 30 s"):
            found.bench.read(1.0)


class FullDisk:
    """A record that can take no event any more, as on a disk that is full."""

    def rows(self, recording):
        pass

    def event(self, t, kind, sentence, data):
        raise RecordingStopped("run.mcap", "No space left on device")

    def turn(self, t):
        pass


def test_ctrl_c_at_the_moment_of_an_interlock_ends_with_the_account(monkeypatch):
    """Whichever is reported last, the run keeps its rows and ends with what stopped it."""
    with lab(BED) as found:

        def interrupted(_duration):
            found.bench._keeper.halt(Reason(Interlock.RECORD_LOST, ("the platform is touched",)))
            raise KeyboardInterrupt

        monkeypatch.setattr(found.bench, "read", interrupted)
        goal = Goal(np.array([0.0, 0.0, -1e-4]), np.array([2e-6, 2e-6, 3e-6]))
        done = run(found.bench, goal, Limits(), None)
    assert done.verdict.code == "stopped_by_hand"
    assert done.verdict.outcome == "halted"
    assert done.verdict.sentence.startswith("Stopped by the user: every mass was stopped")
    assert "the platform is touched" in done.verdict.sentence


@pytest.mark.parametrize("number", STOPPING[1:], ids=lambda number: number.name)
def test_a_signal_in_the_middle_of_a_move_halts_the_masses_and_says_which(monkeypatch, number):
    """By a service that stops, or a terminal that is gone."""

    def moving(bench, _goal, _limits):
        bench.move({"x": 14 * MM})
        yield Step("measurement", bench.time, OBSERVED, recording=bench.read(0.5))
        signal.raise_signal(number)

    monkeypatch.setattr(balancing, "procedure", moving)
    with lab() as found, stoppable():
        goal = Goal(np.array([0.0, 0.0, -1e-4]), np.array([2e-6, 2e-6, 3e-6]))
        done = run(found.bench, goal, Limits(), None)
        found.wait(1.0)
        at = found.emulated.platform.displacements[0]
        found.wait(0.5)
        assert found.emulated.platform.displacements[0] == at
    assert 2 * MM < at < 7 * MM
    assert done.verdict.code == "stopped_by_signal"
    assert done.verdict.reasons[0].parameters[0] == number.name


def test_a_disk_that_is_full_when_a_command_is_noted_stops_the_bench():
    """Nothing is sent that the record does not have; the keeper lives on and says why."""
    with lab() as found:
        found.keeper.listen(FullDisk())
        with pytest.raises(BenchStopped, match="No space left"):
            found.bench.move({"x": 5 * MM})
        with contextlib.suppress(BenchStopped):
            found.bench.read(1.0)
        assert np.all(found.emulated.platform.displacements == 0.0)
        assert "recording stopped" in found.keeper.trip.sentence


def test_two_who_cannot_take_it_any_more_stop_the_bench_as_one_does():
    with lab() as found:
        found.keeper.listen(FullDisk())
        found.keeper.listen(FullDisk())
        with pytest.raises(BenchStopped, match="No space left"):
            found.bench.move({"x": 5 * MM})
        found.wait(0.5)
        assert np.all(found.emulated.platform.displacements == 0.0)


def test_closing_a_bench_records_the_link_health_of_each_device():
    with lab() as found:
        found.imu.wire.spoil = noisy
        found.bench.read(2.0)
        (link,) = found.keeper.links.sensors
    reported = [sentence for _, kind, sentence in found.events if kind == "health"]
    assert reported[0].startswith("board masses: ")
    assert f"{link.driver.counts.corrupt} broken" in reported[1]


def test_who_homes_holds_the_platform_as_at_first():
    with lab() as found:
        found.bench.read(3.0)
        swung = found.emulated.leaning
        found.keeper.home()
        found.wait(1.0)
        held = found.emulated.leaning
        assert held < 0.5 * swung
        while not found.keeper.links.ready:
            found.wait(0.5)
        found.bench.watch()
        assert found.bench.read(2.0).masses.values[-1] == pytest.approx(np.zeros(3), abs=2e-6)


def test_a_hand_leads_the_platform_back_at_its_own_rate():
    """0.5 rad/s about one axis, as the gyro says too; a jump would be a rate that stops."""
    with lab() as found:
        found.bench.read(4.0)
        q0 = found.emulated._observed[1]
        found.emulated.catch()
        rows = found.bench.read(2.0)
        way = difference(found.emulated.platform.platform.attitude, q0)
        angle = np.linalg.norm(way)
        assert angle > np.radians(5)
        t = rows.attitude.t - (rows.attitude.t[-1] - 2.0)
        gone = np.linalg.norm(difference(rows.attitude.values, q0), axis=1)
        assert np.abs(gone - np.minimum(0.5 * t, angle)).max() < np.radians(2)
        on_the_way = rows.rate.values[(t > 0.05) & (t < 0.8 * angle / 0.5)]
        mean = on_the_way.mean(axis=0) - found.emulated.platform.platform.truth.gyro_bias
        assert mean == pytest.approx(0.5 * way / angle, abs=0.01)


def test_tilt_disturbs_nobody_who_only_records():
    """No board knows where its masses are: there is nothing to stop."""
    found = emulated_lab.Lab(replace(BED, tilt_limit=np.radians(0.1)), 1)
    try:
        found.bench.watch()
        observed = found.bench.read(2.0)
        assert len(observed.attitude) == pytest.approx(80, abs=2)
        assert observed.masses is None
        assert found.keeper.trip is None
    finally:
        found.keeper.close()
        found.emulated.close()


def test_after_a_stop_masses_move_again_once_they_have_come_home():
    with lab() as found:
        stopped_while_moving(found, found.board.device.hit_limit)
        found.bench.start()
        found.bench.watch()
        found.bench.move({"x": 3 * MM})
        assert found.bench.read(1.0).masses.values[-1, 0] == pytest.approx(3 * MM, abs=2e-6)
