"""The simulated bench on a table: the same rows however it is read, sensors as they are stated."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.io.testbed.testbed_file import parse_testbed, text_of_testbed
from equipoise.model.bench import Bench
from equipoise.model.errors import InputError
from equipoise.model.recording import join
from equipoise.simulation.carried_out import record
from equipoise.simulation.planar.planar_bench import PlanarBench

BED = """
name = "five"
[platform]
mass_kg = 14.0
mass_sd_percent = 0
gravity_sd_percent = 0
inertia_kg_m2 = [0.36, 0.53, 0.60]
about = "P"
com_um = [0, 0, -3000]
com_sd_um = [500, 500, 1500]
[[sliding_mass]]
name = "x"
mass_g = 100
home_mm = [200, 0, 0]
axis = [1, 0, 0]
travel_mm = [-50, 50]
speed_mm_s = 10
accuracy_mm = 0
lag_sd_ms = 0
sag_sd_mm = 0
[table]
sled_mass_kg = 5.0
sled_mass_sd_percent = 0
low_mm = [-1000, -1000]
high_mm = [1000, 1000]
[sensor.attitude]
rate_hz = 50
noise_deg = 0.05
plumb_sd_deg = 0
[sensor.position]
rate_hz = 25
noise_mm = 0.3
[sensor.gyro]
rate_hz = 50
noise_deg_s = 0.02
[truth]
com_um = [200, -300, -2600]
tilt_deg = 8
rate_deg_s = [0.5, -0.8, 3]
[truth.table]
slope_deg = [0.003, -0.002]
friction_N_s_m = [0.05, 0.1, 0.15, 0.2]
position_mm = [-600, -200]
velocity_mm_s = [20, 8]
"""


def bed(more: str = ""):
    return parse_testbed(BED + more, "bed")


def test_it_is_a_bench():
    assert isinstance(PlanarBench(bed(), 1), Bench)


def test_rows_are_the_same_however_it_is_read():
    whole, parts = PlanarBench(bed(), 4), PlanarBench(bed(), 4)
    at_once = whole.read(3.0)
    in_turn = parts.read(0.37)
    for duration in (0.63, 1.0, 0.001, 0.999):
        in_turn = join(in_turn, parts.read(duration))
    for name in ("attitude", "rate", "position"):
        one, other = getattr(at_once, name), getattr(in_turn, name)
        assert np.array_equal(one.t, other.t)
        assert np.abs(one.values - other.values).max() < 1e-10
    assert parts.time == 3.0


def test_a_late_sensor_gives_what_was_there_before():
    """Rows stamped t show what a prompt sensor showed delay seconds earlier, but for noise."""
    quiet = replace(bed(), position=replace(bed().position, noise=1e-12))
    late = replace(quiet, position=replace(quiet.position, delay=0.2))
    prompt, delayed = (PlanarBench(each, 4).read(3.0).position for each in (quiet, late))
    assert delayed.values[5:] == pytest.approx(prompt.values[:-5], abs=1e-9)


def test_a_mass_that_goes_out_pushes_the_platform_back():
    """Level, without friction, at rest: 100 g by 40 mm on 19 kg move P by 0.21 mm the other way.

    Meanwhile it begins to tip, which takes some of that back.
    """
    level = bed()
    still = replace(level.truth, com=np.zeros(3), attitude=np.zeros(3), rate=np.zeros(3),
                    table=None)  # fmt: skip
    quiet = replace(level, truth=still, position=replace(level.position, noise=1e-12))
    bench = PlanarBench(quiet, 1)
    bench.read(0.0)
    bench.move({"x": 0.040})
    moved = bench.read(4.0).position.values
    assert moved[-1, 0] - moved[0, 0] == pytest.approx(-0.1 * 0.040 / 19.0, rel=0.05)
    assert bench.truth().com[0] == pytest.approx(0.1 * 0.040 / 14.0)
    bench.stop()
    bench.drive({})


def test_a_testbed_with_a_table_reads_back_as_written():
    read = parse_testbed(text_of_testbed(bed()), "again")
    assert read.table.low == pytest.approx(bed().table.low)
    assert read.truth.table.friction == pytest.approx([0.05, 0.1, 0.15, 0.2])
    assert read.truth.table.velocity == pytest.approx([0.02, 0.008])
    assert read.position.noise == pytest.approx(3e-4)


@pytest.mark.parametrize(
    ("old", "new", "where"),
    [
        ("[sensor.position]\nrate_hz = 25\nnoise_mm = 0.3\n", "", r"sensor\.position"),
        ("low_mm = [-1000, -1000]", "low_mm = [2000, -1000]", r"table"),
    ],
)
def test_a_table_that_makes_no_sense_is_refused(old, new, where):
    with pytest.raises(InputError, match=where):
        parse_testbed(BED.replace(old, new), "bed")


def test_a_true_table_needs_a_stated_one():
    text = BED.replace(BED[BED.index("[table]") : BED.index("[sensor.attitude]")], "")
    with pytest.raises(InputError, match=r"truth\.table"):
        parse_testbed(text.replace("[sensor.position]\nrate_hz = 25\nnoise_mm = 0.3\n", ""), "bed")


def test_the_same_seed_gives_the_same_rows():
    one, other = (record(bed(), 2.0, [(1.0, {"x": 0.01})], 9) for _ in range(2))
    assert np.array_equal(one.position.values, other.position.values)
    assert one.masses.values[-1, 0] > 0.0


def test_wheels_on_a_table_are_refused():
    wheel = """
[[reaction_wheel]]
name = "w"
axis = [0, 0, 1]
max_momentum_N_m_s = 0.1
max_speed_rpm = 5000
max_torque_N_m = 0.01
"""
    with pytest.raises(InputError, match=r"wheel:w beside"):
        PlanarBench(bed(wheel), 1)
    with pytest.raises(InputError, match=r"the testbed has no devices"):
        PlanarBench(bed(), 1).drive({"w": 0.1})
