"""Devices of a testbed file: in SI, checked, and the same when written and read again."""

import math
from dataclasses import fields

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from equipoise.io.testbed.testbed_file import json_schema, parse_testbed, text_of_testbed
from equipoise.model.devices import at_start
from equipoise.model.errors import InputError
from equipoise.model.testbed import Testbed

PLATFORM = """
name = "t"
[platform]
mass_kg = 10
inertia_kg_m2 = [[0.5, 0, 0], [0, 0.5, 0], [0, 0, 0.6]]
"""
DEVICES = """
[[reaction_wheel]]
name = "x"
axis = [0, 3, 4]
max_momentum_N_m_s = 0.04
max_speed_rpm = 6000
max_torque_N_m = 0.005
speed_rpm = -300
speed_noise_rpm = 0.6
lag_ms = 20
[[control_moment_gyro]]
name = "a"
gimbal_axis = [0, 0, 2]
spin_axis = [1, 0, 0.001]
momentum_N_m_s = 0.5
max_rate_deg_s = 90
angle_deg = -45
angle_noise_deg = 0.18
lag_ms = 5
gimbal_inertia_kg_m2 = 2e-4
asymmetry_kg_m2 = -1e-4
[[magnetorquer]]
name = "mx"
axis = [-2, 0, 0]
max_dipole_A_m2 = 0.4
lag_ms = 1
[[coil_pair]]
name = "cx"
axis = [0, 0.5, 0]
max_field_uT = 200
field_uT = 60
lag_ms = 200
gain_sd_percent = 2
mounting_sd_deg = 0.5
nonuniformity_percent = 3
[[jet_pair]]
name = "jx"
axis = [0, 0, 1]
torque_N_m = 0.02
min_pulse_ms = 10
lag_ms = 3
[magnetic_field]
field_uT = [100, 0, -50]
noise_uT = 0.5
[truth]
field_uT = [99, 1, -51]
[[truth.coil_pair]]
name = "cx"
gain = 1.02
axis = [0, 2, 0]
deviation_percent = -2
"""
BARE = """
[[reaction_wheel]]
name = "x"
axis = [1, 0, 0]
max_momentum_N_m_s = 0.04
max_speed_rpm = 6000
max_torque_N_m = 0.005
[[control_moment_gyro]]
name = "a"
gimbal_axis = [0, 0, 1]
spin_axis = [1, 0, 0]
momentum_N_m_s = 0.5
max_rate_deg_s = 90
[[magnetorquer]]
name = "mx"
axis = [1, 0, 0]
max_dipole_A_m2 = 0.4
[[jet_pair]]
name = "jx"
axis = [1, 0, 0]
torque_N_m = 0.02
[magnetic_field]
field_uT = [0, 0, -50]
"""

SAME = 1e-14  # a unit of the 15th digit is 1e-14 of the number at most


def devices(text: str) -> Testbed:
    """Return the testbed of a platform with devices."""
    return parse_testbed(PLATFORM + text, "t")


def test_a_wheel_is_read_in_si() -> None:
    """0.04 N m s at 6000 rpm = 200 pi rad/s: 0.04 / (200 pi) kg m^2; 30 rpm is pi rad/s."""
    (wheel,) = devices(DEVICES).wheels
    assert wheel.name == "x"
    np.testing.assert_allclose(wheel.axis, [0, 0.6, 0.8], rtol=1e-15)
    assert wheel.max_speed == pytest.approx(200 * math.pi, rel=1e-15)
    assert wheel.inertia == pytest.approx(0.04 / (200 * math.pi), rel=1e-15)
    assert wheel.max_torque == 0.005
    assert wheel.speed == pytest.approx(-10 * math.pi, rel=1e-15)
    assert wheel.speed_noise == pytest.approx(0.02 * math.pi, rel=1e-15)
    assert wheel.lag == pytest.approx(0.02)


def test_a_gyro_is_read_in_si_and_its_spin_axis_made_square() -> None:
    """The spin axis leans by 0.057 deg out of the plane square to the gimbal: it is put there."""
    (gyro,) = devices(DEVICES).cmgs
    np.testing.assert_array_equal(gyro.gimbal_axis, [0, 0, 1])
    np.testing.assert_array_equal(gyro.spin_axis, [1, 0, 0])
    assert gyro.momentum == 0.5
    assert gyro.max_rate == pytest.approx(math.pi / 2, rel=1e-15)
    assert gyro.angle == pytest.approx(-math.pi / 4, rel=1e-15)
    assert gyro.angle_noise == pytest.approx(math.pi / 1000, rel=1e-15)
    assert gyro.lag == pytest.approx(0.005)
    assert gyro.gimbal_inertia == 2e-4
    assert gyro.asymmetry == -1e-4


def test_a_cage_is_read_in_si() -> None:
    """uT, percent and deg; nominal 60 uT along y beside 100 and -50; what is true of it."""
    testbed = devices(DEVICES)
    (pair,), truth = testbed.coil_pairs, testbed.truth
    np.testing.assert_array_equal(pair.axis_N, [0, 1, 0])
    assert pair.max_field == pytest.approx(2e-4, rel=1e-15)
    assert pair.field == pytest.approx(6e-5, rel=1e-15)
    assert pair.lag == pytest.approx(0.2)
    assert (pair.gain_sd, pair.nonuniformity) == (0.02, 0.03)
    assert pair.mounting_sd == pytest.approx(math.radians(0.5))
    np.testing.assert_allclose(testbed.field_N(), [1e-4, 6e-5, -5e-5], rtol=1e-14)
    given = testbed.field_N(np.array([[0.0], [1e-5]]))
    np.testing.assert_allclose(given, [[1e-4, 0, -5e-5], [1e-4, 1e-5, -5e-5]], rtol=1e-14)
    assert truth is not None
    (true,) = truth.cage
    assert (true.name, true.gain, true.deviation) == ("cx", 1.02, -0.02)
    np.testing.assert_array_equal(true.axis_N, [0, 1, 0])


def test_a_cage_alone_is_a_known_field() -> None:
    """Without [magnetic_field] the background is taken as zero; a true one may be stated."""
    text = DEVICES.replace("[magnetic_field]\nfield_uT = [100, 0, -50]\nnoise_uT = 0.5\n", "")
    testbed = devices(text)
    assert testbed.magnetic_field is None
    np.testing.assert_allclose(testbed.field_N(), [0, 6e-5, 0], rtol=1e-15)
    assert testbed.truth is not None
    np.testing.assert_allclose(testbed.truth.field_N, [9.9e-5, 1e-6, -5.1e-5], rtol=1e-15)


def test_magnetorquers_jets_and_fields_are_read_in_si() -> None:
    """A m2, N m, ms and uT; the true field beside the known one."""
    testbed = devices(DEVICES)
    (coil,), (jet,) = testbed.magnetorquers, testbed.jets
    np.testing.assert_array_equal(coil.axis, [-1, 0, 0])
    assert (coil.max_dipole, coil.lag) == (0.4, 0.001)
    assert (jet.torque, jet.min_pulse, jet.lag) == (0.02, 0.01, 0.003)
    field, truth = testbed.magnetic_field, testbed.truth
    assert field is not None
    assert truth is not None
    np.testing.assert_allclose(field.field_N, [1e-4, 0, -5e-5], rtol=1e-15)
    assert field.noise == pytest.approx(5e-7)
    np.testing.assert_allclose(truth.field_N, [9.9e-5, 1e-6, -5.1e-5], rtol=1e-15)


def test_what_is_left_out_is_ideal_and_at_rest() -> None:
    """No lag, no noise, no least pulse; no magnetometer; the true field is the known one."""
    testbed = devices(BARE + "[truth]\n")
    assert all(device.lag == 0 for device in testbed.devices)
    assert all(at_start(device) == 0 for device in testbed.devices)
    assert testbed.wheels[0].speed_noise == testbed.cmgs[0].angle_noise == 0
    assert testbed.cmgs[0].gimbal_inertia == testbed.cmgs[0].asymmetry == 0
    assert testbed.jets[0].min_pulse == 0
    assert testbed.magnetic_field is not None
    assert testbed.magnetic_field.noise is None
    assert testbed.truth is not None
    assert testbed.truth.field_N is None


def test_a_recording_names_devices_by_what_they_report() -> None:
    """In the order of wheels, gyros, magnetorquers, a cage, jets."""
    assert devices(DEVICES).device_names == (
        "wheel:x",
        "gimbal:a",
        "dipole:mx",
        "cage:cx",
        "jet:jx",
    )


def test_what_devices_report_before_they_are_driven() -> None:
    """Speed, angle and the cage's field at the start; no dipole and no torque."""
    found = [at_start(device) for device in devices(DEVICES).devices]
    assert found == pytest.approx([-10 * math.pi, -math.pi / 4, 0, 6e-5, 0], rel=1e-15)


def test_the_schema_knows_devices() -> None:
    """Editors complete their keys."""
    tables = json_schema()["$defs"]
    for name in (
        "ReactionWheel",
        "Magnetorquer",
        "CoilPair",
        "JetPair",
        "MagneticField",
        "TrueLamp",
    ):
        assert tables[name]["additionalProperties"] is False
    assert "max_momentum_N_m_s" in tables["ReactionWheel"]["required"]


CASES = {
    "wheel without a direction": (
        "axis = [0, 3, 4]",
        "axis = [0, 0, 0]",
        "reaction_wheel[1].axis",
        ["length 0", "direction"],
    ),
    "coil without a direction": (
        "axis = [-2, 0, 0]",
        "axis = [0, 0, 0]",
        "magnetorquer[1].axis",
        ["length 0"],
    ),
    "jet without a direction": (
        'name = "jx"\naxis = [0, 0, 1]',
        'name = "jx"\naxis = [0, 0, 0]',
        "jet_pair[1].axis",
        ["length 0"],
    ),
    "gimbal without a direction": (
        "gimbal_axis = [0, 0, 2]",
        "gimbal_axis = [0, 0, 0]",
        "control_moment_gyro[1].gimbal_axis",
        ["length 0"],
    ),
    "spin axis askew": (
        "spin_axis = [1, 0, 0.001]",
        "spin_axis = [1, 0, 1]",
        "control_moment_gyro[1].spin_axis",
        ["at 45 deg to the gimbal axis", "right angle"],
    ),
    "spin axis along the gimbal": (
        "spin_axis = [1, 0, 0.001]",
        "spin_axis = [0, 0, -1]",
        "control_moment_gyro[1].spin_axis",
        ["at 180 deg"],
    ),
    "wheel and jet of one name": (
        'name = "jx"',
        'name = "x"',
        "jet_pair[1].name",
        ["'x', the name of reaction_wheel[1]", "no device has yet"],
    ),
    "two wheels of one name": (
        "[[control_moment_gyro]]",
        '[[reaction_wheel]]\nname = "x"\naxis = [1, 0, 0]\nmax_momentum_N_m_s = 1\n'
        "max_speed_rpm = 1\nmax_torque_N_m = 1\n[[control_moment_gyro]]",
        "reaction_wheel[2].name",
        ["'x'"],
    ),
    "coils without a field": (
        DEVICES[DEVICES.index("[[coil_pair]]") :],
        "",
        "magnetorquer",
        ["no magnetic field", "[magnetic_field]", "field_uT"],
    ),
    "a field of nothing": (
        "[100, 0, -50]",
        "[0, 0, 0]",
        "magnetic_field.field_uT",
        ["a field of zero"],
    ),
    "faster than it can": (
        "speed_rpm = -300",
        "speed_rpm = -6001",
        "reaction_wheel[1].speed_rpm",
        ["-6001", "max_speed_rpm = 6000"],
    ),
    "no momentum": (
        "max_momentum_N_m_s = 0.04",
        "max_momentum_N_m_s = 0",
        "reaction_wheel[1].max_momentum_N_m_s",
        ["above 0", "in N m s"],
    ),
    "no speed": (
        "max_speed_rpm = 6000",
        "max_speed_rpm = 0",
        "reaction_wheel[1].max_speed_rpm",
        ["above 0", "in rpm"],
    ),
    "speed in another unit": (
        "max_speed_rpm = 6000",
        "max_speed_rad_s = 600",
        "reaction_wheel[1].max_speed_rad_s",
        ["'max_speed_rpm', in rpm", "unit belongs"],
    ),
    "no torque": (
        "max_torque_N_m = 0.005",
        "max_torque_N_m = -0.005",
        "reaction_wheel[1].max_torque_N_m",
        ["above 0", "in N m"],
    ),
    "no rate": (
        "max_rate_deg_s = 90",
        "max_rate_deg_s = 0",
        "control_moment_gyro[1].max_rate_deg_s",
        ["above 0", "in deg/s"],
    ),
    "no dipole": (
        "max_dipole_A_m2 = 0.4",
        "max_dipole_A_m2 = 0",
        "magnetorquer[1].max_dipole_A_m2",
        ["above 0", "in A m2"],
    ),
    "no thrust": ("torque_N_m = 0.02", "torque_N_m = 0", "jet_pair[1].torque_N_m", ["above 0"]),
    "ahead of its time": ("lag_ms = 3", "lag_ms = -3", "jet_pair[1].lag_ms", ["at least 0"]),
    "field in gauss": (
        "field_uT = [100, 0, -50]",
        "field_G = [1, 0, -0.5]",
        "magnetic_field.field_G",
        ["'field_uT'"],
    ),
    "a field that the coils do not give": (
        "field_uT = 60",
        "field_uT = -201",
        "coil_pair[1].field_uT",
        ["max_field_uT = 200"],
    ),
    "a pair of no cage": (
        'name = "cx"\ngain',
        'name = "c"\ngain',
        "truth.coil_pair[1].name",
        ["did you mean 'cx'"],
    ),
    "a true field alone": (
        DEVICES[DEVICES.index("[[magnetorquer]]") :],
        "[truth]\nfield_uT = [1, 2, 3]\n",
        "truth.field_uT",
        ["no stated field", "[magnetic_field]"],
    ),
}


@pytest.mark.parametrize(("old", "new", "key", "words"), CASES.values(), ids=CASES.keys())
def test_a_bad_device_is_named_with_what_was_wanted(old, new, key, words) -> None:
    """File and dotted key come first, then found and wanted, in one line."""
    assert old in DEVICES
    with pytest.raises(InputError) as caught:
        devices(DEVICES.replace(old, new, 1))
    sentence = str(caught.value)
    assert sentence.startswith(f"t: {key}: found ")
    assert "\n" not in sentence
    for word in words:
        assert word in sentence


def number(low: float, high: float) -> st.SearchStrategy[float]:
    """Draw numbers with the digits people write."""
    return st.floats(low, high).map(lambda x: float(f"{x:.6g}"))


@st.composite
def drawn_texts(draw: st.DrawFn) -> str:
    """Draw every number of the devices but their axes; some keys stand more than once."""
    lines = DEVICES.splitlines()
    for i, line in enumerate(lines):
        key, _, value = line.partition(" = ")
        if value and value[0] not in '"[':
            span = (400.0, 9e3) if key in ("max_speed_rpm", "max_field_uT") else (1e-4, 300.0)
            lines[i] = f"{key} = {draw(number(*span))}"
    drawn = "\n".join(lines)
    return drawn.replace("[100, 0, -50]", f"[{draw(number(1, 99))}, {draw(number(-99, 99))}, 3]")


def assert_same(again: object, first: object) -> None:
    """Names alike, numbers to the 15th digit."""
    for each in fields(type(first)):  # pyright: ignore[reportArgumentType]
        ours, theirs = getattr(again, each.name), getattr(first, each.name)
        if isinstance(theirs, str) or theirs is None:
            assert ours == theirs
        else:
            np.testing.assert_allclose(ours, theirs, rtol=SAME, atol=1e-15)


@settings(max_examples=40, deadline=None)
@given(drawn_texts())
def test_devices_written_and_read_again_are_the_same(text: str) -> None:
    """Every key of every kind, the field and the true field."""
    first = devices(text)
    again = parse_testbed(text_of_testbed(first), "t")
    assert len(again.devices) == len(first.devices) == 5
    for ours, theirs in zip(again.devices, first.devices, strict=True):
        assert type(ours) is type(theirs)
        assert_same(ours, theirs)
    assert_same(again.magnetic_field, first.magnetic_field)
    assert again.truth is not None
    assert first.truth is not None
    np.testing.assert_allclose(again.truth.field_N, first.truth.field_N, rtol=SAME)
    assert_same(again.truth.cage[0], first.truth.cage[0])


def test_a_missing_magnetometer_stays_missing() -> None:
    """So does a true field without a nominal one."""
    again = parse_testbed(text_of_testbed(devices(BARE + "[truth]\n")), "t")
    assert again.magnetic_field is not None
    assert again.magnetic_field.noise is None
    assert again.truth is not None
    assert again.truth.field_N is None
