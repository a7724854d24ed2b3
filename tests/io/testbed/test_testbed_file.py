"""Testbed files: what they say is what the nouns hold, in SI."""

import json
import math
from dataclasses import asdict, is_dataclass

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from equipoise.io.testbed.testbed_file import (
    json_schema,
    parse_testbed,
    read_testbed,
    write_testbed,
)
from equipoise.io.testbed.testbed_file import text_of_testbed as text_of
from equipoise.model.testbed import Fault

MINIMAL = """
name = "bare"
[platform]
mass_kg = 10
inertia_kg_m2 = [[0.5, 0, 0], [0, 0.5, 0], [0, 0, 0.6]]
"""
MASS = """
[[sliding_mass]]
name = "x1"
mass_g = 20
home_mm = [100, 0, 0]
axis = [0, 3, 4]
travel_mm = [-50, 40]
"""


def test_a_bare_file_gets_the_documented_defaults() -> None:
    """Mass and inertia are enough; the rest has a documented default, in SI."""
    testbed = parse_testbed(MINIMAL, "bare.toml")
    assert testbed.gravity == 9.80665
    assert math.isclose(testbed.tilt_limit, math.pi / 6)
    assert testbed.inertia_sd == pytest.approx(0.1)
    np.testing.assert_array_equal(testbed.body.com, np.zeros(3))
    np.testing.assert_array_equal(testbed.up, [0, 0, 1])
    assert testbed.masses == ()
    assert testbed.attitude is testbed.gyro is testbed.truth is None


@pytest.mark.parametrize("key", ["platform", "truth"])
def test_three_moments_are_a_tensor_without_products_and_come_back(key) -> None:
    """Written again it has its rows; either form reads the same."""
    rows, moments = "[[0.5, 0, 0], [0, 0.5, 0], [0, 0, 0.6]]", "[0.5, 0.5, 0.6]"
    text = MINIMAL + f'about = "P"\n[truth]\ninertia_kg_m2 = {rows}\n'
    head, before, tail = text.partition(f"[{key}]")
    either = parse_testbed(head + before + tail.replace(rows, moments, 1), "t")
    again = parse_testbed(text_of(either), "t")
    for bed in (either, again):
        assert bed.truth is not None
        held = bed.body.inertia_P if key == "platform" else bed.truth.inertia_P
        np.testing.assert_array_equal(held, np.diag([0.5, 0.5, 0.6]))


def test_the_schema_has_both_forms_of_an_inertia() -> None:
    """An editor that checks keys by it takes either."""
    key = json_schema()["$defs"]["Platform"]["properties"]["inertia_kg_m2"]
    triple, square = key["anyOf"]
    assert triple["items"] == {"type": "number"}
    assert square["items"] == triple
    assert "three moments" in key["description"]


def test_units_of_a_sliding_mass_become_si_and_its_axis_a_unit_vector() -> None:
    """20 g, 100 mm and the axis (0, 3, 4) are 0.02 kg, 0.1 m and (0, 0.6, 0.8)."""
    mass = parse_testbed(MINIMAL + MASS, "t").mass_named("x1")
    assert mass.mass == pytest.approx(0.02, rel=1e-15)
    np.testing.assert_allclose(mass.home, [0.1, 0, 0], rtol=1e-15)
    np.testing.assert_allclose(mass.axis, [0, 0.6, 0.8], rtol=1e-15)
    assert mass.travel == pytest.approx((-0.05, 0.04))
    assert mass.speed == pytest.approx(0.01)


@pytest.mark.parametrize(
    ("com", "up"),
    [
        ([0, -19880, 0], [0, 1, 0]),
        ([0, 19880, 100], [0, 1, 0]),
        ([2500, 0, 100], [1, 0, 0]),
        ([0, -900, 0], [0, 0, 1]),
        ([0, -5000, 600], [0, 0, 1]),
    ],
)
def test_the_vertical_is_the_axis_along_which_the_centre_of_mass_hangs(com, up) -> None:
    """More than 1 mm, ten times the others: that axis is up; else z is."""
    text = MINIMAL + f"com_um = {com}\n"
    np.testing.assert_array_equal(parse_testbed(text, "t").up, up)


def test_up_may_be_said() -> None:
    """A given axis wins over the rule and is made a unit vector."""
    text = MINIMAL + "com_um = [0, -19880, 0]\nup = [0, 0, -2]\n"
    np.testing.assert_array_equal(parse_testbed(text, "t").up, [0, 0, -1])


def test_inertia_about_two_points_differs_by_the_parallel_axis_term() -> None:
    """10 kg hanging 100 mm below P: J_P - J_C = diag(0.1, 0.1, 0) kg m^2."""
    text = MINIMAL + "com_um = [0, 0, -100000]\n"
    about_C = parse_testbed(text, "t").body
    about_P = parse_testbed(text.replace("0.5,", "0.55,") + 'about = "P"\n', "t").body
    np.testing.assert_allclose(about_C.inertia_P, np.diag([0.6, 0.6, 0.6]), atol=1e-15)
    np.testing.assert_allclose(about_P.inertia_P - about_P.inertia_C, np.diag([0.1, 0.1, 0]))


def test_a_gyro_noise_density_becomes_noise_per_sample() -> None:
    """0.01 deg/s/rtHz at 100 Hz is 0.1 deg/s per sample; the bias default is 1 deg/s."""
    text = MINIMAL + "[sensor.gyro]\nrate_hz = 100\nnoise_density_deg_s_rthz = 0.01\n"
    gyro = parse_testbed(text, "t").gyro
    assert gyro is not None
    assert gyro.noise == pytest.approx(math.radians(0.1))
    assert gyro.bias_sd == pytest.approx(math.radians(1.0))


def test_truth_is_read_in_si() -> None:
    """Torque terms, drift, box, faults: every unit of the table once."""
    text = (
        MINIMAL
        + MASS
        + (
            "[truth]\ncom_um = [10, 0, -50]\nviscous_N_m_s = [1e-4, 2e-4, 3e-4]\n"
            "drift_um_min = [60, 0, 0]\nsag_um = [1, 2, 3, 4, 5]\nswirl_N_m = 1e-6\n"
            "inertia_kg_m2 = [[0.5, 0, 0], [0, 0.5, 0], [0, 0, 0.6]]\n"
            "gyro_bias_deg_s = [180, 0, 0]\n"
            'com_low_um = [-1, -2, -3]\n[[truth.fault]]\nmass = "x1"\n'
            '[[truth.fault]]\nmass = "x1"\nkind = "slip"\ngain = 0.8\nfrom_move = 2\n'
        )
    )
    truth = parse_testbed(text, "t").truth
    assert truth is not None
    assert truth.com is not None
    np.testing.assert_allclose(truth.com, [1e-5, 0, -5e-5])
    np.testing.assert_allclose(truth.com_low, [-1e-6, -2e-6, -3e-6])
    np.testing.assert_allclose(truth.com_high, [1e-3, 1e-3, 1e-3])  # 0 + 2 sd of 500 um
    assert truth.torque["viscous_y"] == 2e-4
    assert truth.torque["drift_x"] == pytest.approx(1e-6)
    assert truth.torque["sag_yz"] == pytest.approx(5e-6)
    assert truth.torque["swirl"] == 1e-6
    assert "quadratic" not in truth.torque
    assert truth.faults == (Fault("x1", 0.0, 1), Fault("x1", 0.8, 2))
    assert truth.gyro_bias[0] == pytest.approx(math.pi)
    moved = 2.6e-9 * np.eye(3) - np.outer(truth.com, truth.com)
    expected = np.diag([0.5, 0.5, 0.6]) + 10 * moved
    assert truth.inertia_P is not None
    np.testing.assert_allclose(truth.inertia_P, expected, rtol=1e-12, atol=1e-18)


DEFECTS = """
mass_lag_s = 0.025
gyro_scale_percent = [1, -2, 0]
gyro_misalignment_deg = [0, 180, 0]
plumb_deg = [90, -180]
heading2_cos_deg = [180, 0, 0]
heading2_sin_deg = [0, 0, 90]
bad_rows_percent = 2
bad_row_deg = 18
[[truth.contact]]
time_s = 20
impulse_N_m_s = [1e-3, 0, -2e-3]
[[truth.contact]]
time_s = 10
impulse_N_m_s = [0, 0, 1e-3]
[[truth.com_step]]
time_s = 30
com_um = [1, 2, -3]
[[truth.gap]]
start_s = 40
end_s = 41
"""


def test_defects_are_read_in_si_and_in_order_of_time() -> None:
    """Every unit once."""
    truth = parse_testbed(MINIMAL + "[truth]" + DEFECTS, "t").truth
    assert truth is not None
    assert truth.mass_lag == 0.025
    np.testing.assert_allclose(truth.gyro.scale, [0.01, -0.02, 0])
    np.testing.assert_allclose(truth.gyro.turn, [0, math.pi, 0])
    np.testing.assert_allclose(truth.camera.plumb, [math.pi / 2, -math.pi, 0])
    np.testing.assert_allclose(truth.camera.heading_cos, [math.pi, 0, 0])
    np.testing.assert_allclose(truth.camera.heading_sin, [0, 0, math.pi / 2])
    assert truth.camera.bad_share == pytest.approx(0.02)
    assert truth.camera.bad_turn == pytest.approx(math.pi / 10)
    assert [each.time for each in truth.contacts] == [10, 20]
    np.testing.assert_array_equal(truth.contacts[1].impulse, [1e-3, 0, -2e-3])
    np.testing.assert_allclose(truth.com_steps[0].shift, [1e-6, 2e-6, -3e-6])
    assert (truth.gaps[0].start, truth.gaps[0].end) == (40, 41)


def test_defects_written_and_read_again_are_the_same() -> None:
    """The whole table, by its numbers."""
    first = parse_testbed(MINIMAL + "[truth]" + DEFECTS, "t")
    again = parse_testbed(text_of(first), "t")
    assert first.truth is not None
    assert again.truth is not None
    for name in ("mass_lag", "contacts", "com_steps", "gaps", "camera", "gyro"):
        np.testing.assert_equal(asdict_of(getattr(again.truth, name)),
                                asdict_of(getattr(first.truth, name)))  # fmt: skip


def asdict_of(value):
    """Return plain numbers and lists, rounded to 12 digits."""
    if isinstance(value, tuple):
        return [asdict_of(each) for each in value]
    if is_dataclass(value):
        return {key: asdict_of(each) for key, each in asdict(value).items()}
    return [float(f"{x:.12g}") for x in np.atleast_1d(value)]


def test_a_truth_without_defects_has_none() -> None:
    """A truth without defects has none."""
    truth = parse_testbed(MINIMAL + "[truth]\n", "t").truth
    assert truth is not None
    assert truth.contacts == truth.com_steps == truth.gaps == ()
    assert truth.mass_lag == truth.camera.bad_share == 0
    assert not np.any([truth.camera.plumb, truth.camera.heading_cos, truth.camera.heading_sin])
    assert not np.any([truth.gyro.scale, truth.gyro.turn])


def test_last_digits_of_sensors_are_read_and_written() -> None:
    """A quantum is known to whoever reads the sensor's data sheet."""
    text = MINIMAL + (
        "[sensor.attitude]\nrate_hz = 5\nnoise_deg = 0.1\nquantum_deg = 0.5\nplumb_sd_deg = 0.02\n"
        "[sensor.gyro]\nrate_hz = 50\nnoise_deg_s = 0.1\nquantum_deg_s = 0.0625\n"
    )
    for testbed in (
        parse_testbed(text, "t"),
        parse_testbed(text_of(parse_testbed(text, "t")), "t"),
    ):
        assert testbed.attitude is not None
        assert testbed.gyro is not None
        assert testbed.attitude.quantum == pytest.approx(math.radians(0.5))
        assert testbed.attitude.plumb_sd == pytest.approx(math.radians(0.02))
        assert testbed.gyro.quantum == pytest.approx(math.radians(1 / 16))


def test_disturbance_groups_expand_to_terms() -> None:
    """A group stands for its terms."""
    text = MINIMAL + '[disturbance]\nconsider = ["swirl", "viscous"]\n'
    terms = parse_testbed(text, "t").disturbances
    assert terms == ("viscous_x", "viscous_y", "viscous_z", "swirl")


def test_the_schema_lists_every_key_and_forbids_others() -> None:
    """Editors complete keys from it: it must be JSON, and closed."""
    schema = json.loads(json.dumps(json_schema()))
    assert schema["additionalProperties"] is False
    assert {"mass_kg", "com_um", "up"} <= set(schema["$defs"]["Platform"]["properties"])
    assert schema["$defs"]["SlidingMass"]["additionalProperties"] is False


def number(low: float, high: float) -> st.SearchStrategy[float]:
    """Draw numbers with the digits people write."""
    return st.floats(low, high).map(lambda x: float(f"{x:.6g}"))


@st.composite
def drawn_texts(draw: st.DrawFn) -> str:
    """Draw the text of a testbed file."""
    triple = st.lists(number(-500, 500), min_size=3, max_size=3)
    text = MINIMAL + f"com_um = {draw(triple)}\ntilt_limit_deg = {draw(number(1, 90))}\n"
    text += MASS.replace("[100, 0, 0]", str(draw(triple)))
    text += f"accuracy_mm = {draw(number(0, 1))}\n"
    if draw(st.booleans()):
        text += f"[sensor.attitude]\nrate_hz = {draw(number(1, 200))}\nnoise_deg = 0.1\n"
    if draw(st.booleans()):
        text += f"[sensor.gyro]\nrate_hz = 50\nnoise_deg_s = {draw(number(0.01, 1))}\n"
    text += f"[truth]\nrate_deg_s = {draw(triple)}\nconstant_N_m = {draw(triple)}\n"
    text += '[[truth.fault]]\nmass = "x1"\nkind = "slip"\ngain = 0.25\n'
    return text + '[assumed]\n"platform.mass_kg" = "a \\"guess\\""\n'


@settings(max_examples=60, deadline=None)
@given(drawn_texts())
def test_a_testbed_written_and_read_again_is_the_same(text: str) -> None:
    """Text -> testbed -> text settles after one round, and the nouns agree to 1e-12."""
    first = parse_testbed(text, "t")
    again = parse_testbed(text_of(first), "t")
    np.testing.assert_allclose(again.body.inertia_P, first.body.inertia_P, rtol=1e-12)
    np.testing.assert_allclose(again.body.com, first.body.com, rtol=1e-12, atol=1e-18)
    np.testing.assert_allclose(again.masses[0].home, first.masses[0].home, rtol=1e-12)
    assert again.masses[0].accuracy == pytest.approx(first.masses[0].accuracy, rel=1e-12)
    assert again.assumed == first.assumed
    assert (again.gyro is None) == (first.gyro is None)
    assert again.truth is not None
    assert first.truth is not None
    assert again.truth.faults == first.truth.faults
    assert again.truth.torque == pytest.approx(first.truth.torque, rel=1e-12)


def test_what_is_assumed_of_a_noise_density_is_written_of_the_noise() -> None:
    """A written file has the noise per sample, and must not name a key that it lacks."""
    key = "sensor.gyro.noise_density_deg_s_rthz"
    text = MINIMAL + "[sensor.gyro]\nrate_hz = 100\nnoise_density_deg_s_rthz = 0.01\n"
    first = parse_testbed(f'{text}[assumed]\n"{key}" = "so"\n', "t")
    assert parse_testbed(text_of(first), "t").assumed == {"sensor.gyro.noise_deg_s": "so"}


def test_writing_a_text_keeps_its_comments(tmp_path) -> None:
    """A preset's remarks survive being written."""
    path = tmp_path / "my.toml"
    write_testbed("# mine\n" + MINIMAL, path)
    assert path.read_text().startswith("# mine")
    assert read_testbed(path).name == "bare"
    assert read_testbed(path).source == str(path)
