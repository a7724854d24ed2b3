"""Each format is read back by the tool whose it is, with the same body to 1e-12."""

import csv
import math
import runpy
from pathlib import Path

import mujoco
import numpy as np
import pytest
import scipy.io
import yaml
import yourdfpy
from Basilisk.simulation import spacecraft

from equipoise.io.exchange.body_file import read_foreign_body
from equipoise.io.exchange.body_formats import FORMATS
from equipoise.model.mass_properties import from_centre
from equipoise.model.stated_body import SIX, StatedBody, order, shift_jacobian

COM = np.array([1.6e-5, -2.7e-5, -0.013])
INERTIA_C = np.array([[0.34, 0.012, -0.007], [0.012, 0.41, 0.0031], [-0.007, 0.0031, 0.28]])
BODY = from_centre(14.24123456789, COM, INERTIA_C)
SPREAD = np.diag([1e-4, *(1e-6,) * 6, 1e-12, 1e-12, 1e-10])
SPREAD[1, 2] = SPREAD[2, 1] = 3e-7
STATED = StatedBody("plate -- 'A' <1>", BODY, SPREAD, ("Source: a test.",))


def written(name: str, folder: Path) -> Path:
    form = FORMATS[name]
    content = form.write(STATED)
    path = folder / f"body{form.suffix}"
    path.write_bytes(content.encode() if isinstance(content, str) else content)
    return path


def from_mujoco(path):
    model = mujoco.MjModel.from_xml_path(str(path))
    turn = np.zeros(9)
    mujoco.mju_quat2Mat(turn, model.body_iquat[1])
    axes = turn.reshape(3, 3)
    inertia = axes @ np.diag(model.body_inertia[1]) @ axes.T
    return model.body_mass[1], model.body_ipos[1], inertia


def from_urdf(path):
    inertial = yourdfpy.URDF.load(str(path)).link_map["platform"].inertial
    return inertial.mass, inertial.origin[:3, 3], inertial.inertia


def from_basilisk(path):
    craft = spacecraft.Spacecraft()
    runpy.run_path(str(path))["set_hub"](craft)
    return craft.hub.mHub, np.ravel(craft.hub.r_BcB_B), np.array(craft.hub.IHubPntBc_B)


def from_matlab(path):
    body = scipy.io.loadmat(path, simplify_cells=True)["platform"]
    assert [name.strip() for name in body["covariance_order"]] == list(order())
    np.testing.assert_array_equal(body["covariance"], SPREAD)
    return body["mass_kg"], body["com_P_m"], body["inertia_C_kg_m2"]


def from_yaml(path):
    body = yaml.safe_load(path.read_text(encoding="utf-8"))
    assert body["name"] == STATED.name
    np.testing.assert_array_equal(body["covariance"], SPREAD)
    return body["mass_kg"], body["com_P_m"], np.array(body["inertia_C_kg_m2"])


def from_ros(path):
    body = yaml.safe_load(path.read_text(encoding="utf-8"))
    com = [body["com"][axis] for axis in "xyz"]
    return body["m"], com, tensor(lambda i, j: body[f"i{i}{j}"])


def from_csv(path):
    with path.open(encoding="utf-8", newline="") as file:
        rows = {row["name"]: row for row in csv.DictReader(file)}
    value = {name: float(row["value"]) for name, row in rows.items()}
    assert float(rows["inertia_P_xx"]["covariance_inertia_P_yy"]) == 3e-7
    assert float(rows["com_z"]["sd"]) == pytest.approx(1e-5)
    com = [value[f"com_{axis}"] for axis in "xyz"]
    return value["mass"], com, tensor(lambda i, j: value[f"inertia_C_{i}{j}"])


def from_simulink(path):
    """Read the script's assignments: products are in the order yz, zx, xy."""
    lines = [line for line in path.read_text(encoding="utf-8").splitlines() if "= " in line]
    read = {
        line.split("=")[0].strip().removeprefix("equipoise."): line.split("=")[1].split(";")[0]
        for line in lines
        if line.startswith("equipoise.")
    }
    com, moments, products = (
        np.array([float(x) for x in read[key].strip(" []").split(",")])
        for key in ("CenterOfMass", "MomentsOfInertia", "ProductsOfInertia")
    )
    yz, zx, xy = products
    inertia = np.diag(moments) + np.array([[0, xy, zx], [xy, 0, yz], [zx, yz, 0]])
    return float(read["Mass"]), com, inertia


def from_42(path):
    """Read the lines as 42 does: what stands as xy, xz, yz is taken with the other sign."""
    lines = path.read_text(encoding="utf-8").splitlines()
    numbers = [
        np.array([float(x) for x in line.split("!")[0].split()])
        for line in lines
        if line[:1] not in ("!", "=", "")
    ]
    (mass,), moments, (xy, xz, yz), com = numbers
    inertia = np.diag(moments) - np.array([[0, xy, xz], [xy, 0, yz], [xz, yz, 0]])
    return mass, com, inertia


def from_sdf(path):
    body, _ = read_foreign_body(path)
    return body.mass, body.com, body.inertia_C


def tensor(element):
    xx, yy, zz = (element(axis, axis) for axis in "xyz")
    xy, xz, yz = element("x", "y"), element("x", "z"), element("y", "z")
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])


READERS = {
    "mjcf": from_mujoco, "urdf": from_urdf, "sdf": from_sdf, "basilisk": from_basilisk,
    "42": from_42, "matlab": from_matlab, "simulink": from_simulink, "yaml": from_yaml,
    "csv": from_csv, "ros": from_ros,
}  # fmt: skip


@pytest.mark.parametrize("name", FORMATS)
def test_a_body_comes_back(name, tmp_path):
    mass, com, inertia = READERS[name](written(name, tmp_path))
    assert mass == BODY.mass
    np.testing.assert_allclose(com, COM, rtol=1e-12)
    np.testing.assert_allclose(inertia, INERTIA_C, atol=1e-12 * 0.41)


@pytest.mark.parametrize("name", ["urdf", "sdf", "mjcf"])
def test_what_was_written_is_read_by_new(name, tmp_path):
    body, _ = read_foreign_body(written(name, tmp_path))
    np.testing.assert_allclose(body.inertia_P, BODY.inertia_P, rtol=1e-12)


@pytest.mark.parametrize("name", [n for n in FORMATS if n != "matlab"])
def test_a_file_states_convention_and_sd(name, tmp_path):
    text = written(name, tmp_path).read_text(encoding="utf-8")
    if name == "csv":
        assert ",sd," in text
        return
    assert "Products of inertia are" in text
    assert "com_z -0.013 m, sd 1e-05" in text


def test_sd_about_the_centre_of_mass_follow_the_parallel_axis_term():
    def central(x):
        mass, six, com = x[0], x[1:7], x[7:]
        term = mass * ((com @ com) * np.eye(3) - np.outer(com, com))
        return six - np.array([term[i, j] for i, j in SIX])

    at = np.array([BODY.mass, *STATED.about_P, *COM])
    step = 1e-30
    columns = [np.imag(central(at + 1j * step * np.eye(10)[k])) / step for k in range(10)]
    by_complex_step = np.array(columns).T
    stated = np.eye(10)[1:7] - shift_jacobian(BODY.mass, COM)
    np.testing.assert_allclose(stated, by_complex_step, atol=1e-15)
    whole = np.eye(10)
    whole[1:7] = by_complex_step
    np.testing.assert_allclose(STATED.covariance_about_C, whole @ SPREAD @ whole.T, rtol=1e-12)


def test_what_no_data_show_has_an_infinite_variance():
    spread = SPREAD.copy()
    spread[9, 9] = math.inf  # com_z
    about_C = StatedBody("open", BODY, spread).covariance_about_C
    assert np.isinf(np.diag(about_C)).tolist() == [
        False, True, True, False, False, True, True, False, False, True
    ]  # fmt: skip
    text = FORMATS["yaml"].write(StatedBody("open", BODY, spread))
    assert isinstance(text, str)
    assert yaml.safe_load(text)["covariance"][9][9] == math.inf
