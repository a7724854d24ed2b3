"""Presets hold the numbers the papers print and mark the others."""

import math
import re

import numpy as np
import pytest

from equipoise.dynamics.regressor import TORQUE, WIDTH, regressor
from equipoise.io.testbed.presets import preset_names, preset_text, read_preset
from equipoise.io.testbed.testbed_file import parse_testbed, text_of_testbed
from equipoise.maths.attitude import from_euler321, tilt, to_matrix
from equipoise.model.errors import InputError
from equipoise.model.testbed import SlidingMass
from equipoise.simulation.draw_truth import coefficients, draw_truth


def test_sputnix_has_the_numbers_of_ivanov_2021_section_1() -> None:
    """Mass, CAD inertia about C, six loads of 15.6 g on +-50 mm rails, 0.2 deg at 5 Hz, no gyro."""
    testbed = read_preset("sputnix")
    cad = [[0.3309, 0.0018, 0.0373], [0.0018, 0.5253, 0.0012], [0.0373, 0.0012, 0.8120]]
    assert testbed.body.mass == 14.24
    np.testing.assert_allclose(testbed.body.inertia_C, cad, atol=1e-12)
    assert [m.name for m in testbed.masses] == ["x1", "x2", "y1", "y2", "z1", "z2"]
    assert all(m.mass == pytest.approx(0.0156) for m in testbed.masses)
    assert all(m.travel == pytest.approx((-0.05, 0.05)) for m in testbed.masses)
    assert all(3 * m.accuracy == pytest.approx(1e-3, rel=2e-3) for m in testbed.masses)
    assert all(m.axis["xyz".index(m.name[0])] == 1.0 for m in testbed.masses)
    assert testbed.attitude is not None
    assert testbed.attitude.rate == 5.0
    assert math.degrees(testbed.attitude.noise) == pytest.approx(0.2)
    assert testbed.gyro is None


def test_what_the_paper_does_not_print_is_marked_in_text_and_noun() -> None:
    """Rail positions, speed, tilt limit, gravity and the first guess are assumptions."""
    assumed = read_preset("sputnix").assumed
    for key in ("sliding_mass.home_mm", "sliding_mass.speed_mm_s", "platform.gravity_m_s2"):
        assert key in assumed
    assert "assumed:" in preset_text("sputnix")


def by_hand(name: str) -> set[str]:
    """Return the dotted keys of a preset that a remark marks as assumed."""
    table, found = "", set[str]()
    for line in preset_text(name).splitlines():
        head = re.match(r"\[+([\w.]+)\]", line)
        table = head[1] if head else table
        key = re.match(r"(\w+) = .*# assumed", line)
        if key:
            found.add(f"{table}.{key[1]}")
    return found


@pytest.mark.parametrize("name", preset_names())
def test_what_a_remark_marks_as_assumed_is_listed(name: str) -> None:
    """By its own name or by that of a table around it."""
    listed = set(read_preset(name).assumed)
    for key in by_hand(name):
        parts = key.split(".")
        assert {".".join(parts[: i + 1]) for i in range(len(parts))} & listed, key


@pytest.mark.parametrize("name", preset_names())
def test_every_preset_written_and_read_again_is_the_same(name: str) -> None:
    """Devices, masses and remarks; a gyro's density becomes noise per sample."""
    first = read_preset(name)
    again = parse_testbed(text_of_testbed(first), "t")
    assert again.device_names == first.device_names
    assert again.mass_names == first.mass_names
    assert again.layout == first.layout
    assert len(again.assumed) == len(first.assumed)
    np.testing.assert_allclose(again.body.inertia_P, first.body.inertia_P, rtol=1e-14, atol=1e-16)


@pytest.mark.parametrize("name", preset_names())
def test_every_preset_can_be_read_and_simulated(name: str) -> None:
    """Each has a truth for the simulator."""
    assert read_preset(name).truth is not None


def test_an_unknown_preset_names_the_nearest() -> None:
    """A misspelt name is answered with the right one."""
    with pytest.raises(InputError, match="did you mean 'sputnix'"):
        preset_text("sputniks")


def test_the_reference_table_has_every_device() -> None:
    """Coarse and fine masses, wheels, coils with a field, jets; a triad of each."""
    testbed = read_preset("reference-table")
    assert testbed.body.mass == 14.0
    assert testbed.magnetic_field is not None
    coarse, fine = testbed.masses[:3], testbed.masses[3:]
    for triad in (coarse, fine, testbed.wheels, testbed.magnetorquers, testbed.jets):
        np.testing.assert_array_equal([each.axis for each in triad], np.eye(3))
    # What a move does to the centre of mass: 714 um and 35.7 um at most, a fine step 0.014 um.
    assert [m.mass * m.travel[1] / 14 for m in coarse] == pytest.approx([714e-6] * 3, rel=1e-3)
    assert [m.mass * m.travel[1] / 14 for m in fine] == pytest.approx([35.7e-6] * 3, rel=1e-3)
    assert [m.mass * m.resolution / 14 for m in fine] == pytest.approx([14.3e-9] * 3, rel=1e-3)
    assert testbed.wheels[0].inertia * testbed.wheels[0].max_speed == pytest.approx(0.04)


@pytest.mark.parametrize("u", [[1.0, 0.0, 0.0], [0.6, 0.8, 0.0]])
@pytest.mark.parametrize("angle", [0.0, 15.0, 45.0, 90.0])
def test_the_reference_table_sinks_by_25_um_upright_and_not_sideways(u, angle) -> None:
    """Turned by a about a level axis u: a torque m g (25 um cos a) sin a back, about u alone."""
    truth = read_preset("reference-table").truth
    assert truth is not None
    sag = coefficients({k: v for k, v in truth.torque.items() if k.startswith("sag")})
    sin, cos = math.sin(math.radians(angle)), math.cos(math.radians(angle))
    g = (9.81 * u[1] * sin, -9.81 * u[0] * sin, -9.81 * cos)
    out = np.zeros((3, WIDTH))
    regressor((0.0, 0.0, 0.0), g, 0.0, 0.0, 14.0, 9.81, True, out)
    back = 14.0 * 9.81 * 25e-6 * cos * sin
    np.testing.assert_allclose(out[:, TORQUE:] @ sag, -back * np.array(u), atol=1e-15)


def test_the_reference_table_drifts_by_a_tenth_of_a_micrometre_a_minute() -> None:
    """Its length, in m/s."""
    truth = read_preset("reference-table").truth
    assert truth is not None
    drift = [truth.torque[f"drift_{axis}"] for axis in "xyz"]
    assert np.linalg.norm(drift) == pytest.approx(0.1e-6 / 60)


def test_kau_has_the_numbers_of_table_1() -> None:
    """J = diag(20, 16, 14), m r = (-0.1, 0.1, 0.05) kg cm, 2/3 N m s, variance 1e-7, from rest."""
    testbed = read_preset("kau")
    truth = testbed.truth
    assert truth is not None
    assert testbed.gyro is not None
    np.testing.assert_array_equal(testbed.body.inertia_P, np.diag([20, 16, 14]))
    np.testing.assert_allclose(testbed.body.mass * truth.com, [-1e-3, 1e-3, 0.5e-3], rtol=1e-12)
    assert [gyro.momentum for gyro in testbed.cmgs] == pytest.approx([2 / 3] * 4)
    assert testbed.gyro.noise**2 == pytest.approx(1e-7, rel=1e-5)
    np.testing.assert_array_equal(truth.rate, np.zeros(3))


def test_gravity_pulls_the_kau_table_as_in_lees_equation_1() -> None:
    """The torque c_1 x m r g, c_1 the first column of the matrix from laboratory to body."""
    testbed = read_preset("kau")
    start = draw_truth(testbed, np.random.default_rng(0))
    theirs = to_matrix(from_euler321(*np.radians([70.0, 30.0, -30.0])))  # body to laboratory
    c_1, moment = theirs.T[:, 0], np.array([-1e-3, 1e-3, 0.5e-3])
    printed = np.cross(c_1, moment * testbed.gravity)
    g_B = to_matrix(start.attitude).T @ np.array([0.0, 0.0, -testbed.gravity])
    np.testing.assert_allclose(np.cross(moment, g_B), printed, rtol=1e-9)
    lean = math.degrees(float(tilt(start.attitude, testbed.up)))
    assert lean == pytest.approx(math.degrees(math.acos(math.cos(math.pi / 6) ** 2)))


def test_the_kau_attitude_is_theirs_with_the_axes_renamed() -> None:
    """Their laboratory axes 1, 2, 3 are our z, x, y: each body axis points where theirs does."""
    start = draw_truth(read_preset("kau"), np.random.default_rng(0))
    theirs = to_matrix(from_euler321(*np.radians([70.0, 30.0, -30.0])))
    ours = to_matrix(start.attitude)
    np.testing.assert_allclose(ours[[2, 0, 1]], theirs, atol=1e-11)


def test_the_kau_gyros_are_a_pyramid_of_54_73_deg() -> None:
    """Output torques h' of the usual pyramid: columns of D / h0 at gimbal angles of zero and 90."""
    gyros = read_preset("kau").cmgs
    s, c = math.sin(math.radians(54.73)), math.cos(math.radians(54.73))
    cross = [np.cross(gyro.gimbal_axis, gyro.spin_axis) for gyro in gyros]
    at_zero = np.array([[-c, 0, c, 0], [0, -c, 0, c], [s, s, s, s]])
    np.testing.assert_allclose(np.transpose(cross), at_zero, atol=1e-6)
    at_90 = np.array([[0, 1, 0, -1], [-1, 0, 1, 0], [0, 0, 0, 0]])  # -s0
    np.testing.assert_allclose(-np.transpose([g.spin_axis for g in gyros]), at_90, atol=1e-15)
    np.testing.assert_allclose(sum(gyro.spin_axis for gyro in gyros), np.zeros(3), atol=1e-15)


def test_unb_has_the_published_mass_inertia_and_gravity() -> None:
    """14.307 kg, 9.78 m/s2, tensor elements, three masses of 0.7 kg at 1 mm/s, 0.05 deg/s."""
    testbed = read_preset("unb")
    published = [[0.265, -0.014, -0.035], [-0.014, 0.246, -0.018], [-0.035, -0.018, 0.427]]
    assert (testbed.body.mass, testbed.gravity) == (14.307, 9.78)
    np.testing.assert_allclose(testbed.body.inertia_P, published, atol=1e-15)
    assert [m.mass for m in testbed.masses] == pytest.approx([0.7] * 3)
    assert [m.speed for m in testbed.masses] == pytest.approx([0.001] * 3)
    assert testbed.gyro is not None
    assert math.degrees(testbed.gyro.quantum) == pytest.approx(0.05)


def step_shift(mass: SlidingMass) -> float:
    """Return what a step and the error of its stop are together, kg m, one sd."""
    return mass.mass * math.hypot(mass.resolution / math.sqrt(12), mass.accuracy)


# Of table 1: layout, kg, last digit of the gyro in deg/s, N m or um reached; None: not printed.
TABLE_1 = {
    "georgia-tech": ("table-top", None, 0.073, None, None),
    "cubesat-tas": ("spherical-rotor", 4.2, 0.05, None, None),
    "unb": ("table-top", 14.307, 0.05, 3.5e-5, None),
    "bologna": ("table-top", 11.5, 0.004, 5e-5, None),
    "florida": ("table-top", None, None, None, None),
    "harbin": ("table-top", None, 0.04, None, 5.0),
    "unam": ("table-top", 35.0, 0.05, 2e-3, None),
    "honeywell": ("umbrella", None, None, None, 60.96),
    "knt": ("dumbbell", None, 0.25, None, None),
    "virginia-tech": ("table-top", None, None, None, None),
    "vietnam": ("table-top", None, None, None, 0.5),
    "sydney": ("table-top", None, 0.05, None, None),
    "aalto": ("spherical-rotor", None, None, None, None),
}


@pytest.mark.parametrize("name", TABLE_1)
def test_a_preset_of_table_1_has_what_the_review_prints(name: str) -> None:
    """Layout, mass and gyro; what is not printed is listed as assumed."""
    layout, mass, digit, _, _ = TABLE_1[name]
    bed = read_preset(name)
    assert bed.layout == layout
    if mass is None:
        assert "platform.mass_kg" in bed.assumed
    else:
        assert bed.body.mass == mass
    if digit is not None:
        assert bed.gyro is not None
        assert math.degrees(bed.gyro.quantum) == pytest.approx(digit)
    assert bool(bed.masses) != bool(bed.weights or bed.cmgs)


@pytest.mark.parametrize("name", [name for name, row in TABLE_1.items() if any(row[3:])])
def test_a_preset_of_table_1_can_reach_what_was_reached(name: str) -> None:
    """Each finest mass errs by at most a third of it, by step and stop together."""
    *_, torque, offset = TABLE_1[name]
    bed = read_preset(name)
    wanted = torque / bed.gravity if torque else 1e-6 * offset * bed.body.mass
    fine = bed.masses[-3:]
    assert all(step_shift(mass) < wanted / 3 for mass in fine)


def test_unam_and_honeywell_have_what_else_is_printed() -> None:
    """Ivanov's introduction: a roll of 50 deg, coils, flywheels; 0.01 deg/sqrt(hr) over 60."""
    unam, gyro = read_preset("unam"), read_preset("honeywell").gyro
    assert math.degrees(unam.tilt_limit) == pytest.approx(50.0)
    assert len(unam.wheels) == len(unam.magnetorquers) == 3
    assert gyro is not None
    density = math.degrees(gyro.noise) / math.sqrt(gyro.rate)
    assert density * 60 == pytest.approx(0.01, rel=1e-3)


def test_masses_of_harbin_make_a_pyramid_and_vietnams_are_coarse_and_fine() -> None:
    """Four rails at one angle to the vertical, their sum along it; two sets of three."""
    rails = np.array([mass.axis for mass in read_preset("harbin").masses])
    np.testing.assert_allclose(rails.sum(axis=0), [0, 0, 4 * rails[0, 2]], atol=1e-12)
    assert np.linalg.matrix_rank(rails) == 3
    masses = read_preset("vietnam").masses
    assert [m.name for m in masses] == [f"{s}_{a}" for s in ("coarse", "fine") for a in "xyz"]
    assert all(c.mass == 10 * f.mass for c, f in zip(masses[:3], masses[3:], strict=True))


def test_the_layout_is_a_table_top_where_none_is_stated() -> None:
    """And another kind than the four is refused."""
    assert read_preset("sputnix").layout == "table-top"
    text = preset_text("knt").replace('"dumbbell"', '"barbell"', 1)
    with pytest.raises(InputError, match="layout"):
        parse_testbed(text, "t")


def test_cubesat_tas_has_what_the_review_prints() -> None:
    """4.2 kg, sliding masses, wheels, a gyro of 0.05 deg/s; no other number."""
    testbed = read_preset("cubesat-tas")
    assert testbed.body.mass == 4.2
    assert testbed.gyro is not None
    assert math.degrees(testbed.gyro.quantum) == pytest.approx(0.05)
    assert {"sliding_mass", "reaction_wheel", "platform.inertia_kg_m2"} <= set(testbed.assumed)
