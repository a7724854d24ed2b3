"""`equipoise inertia` from the command line: tables, JSON, refusals, and the testbed it writes."""

import json
from pathlib import Path

import numpy as np
import pytest

import equipoise as eq
from equipoise.io.testbed.testbed_file import read_testbed

PARTS = """name = "Two parts"

[[part]]
name = "table"
shape = "box"
mass_g = 12000
size_mm = [500, 400, 30]
centre_mm = [0, 0, -3]
inertia_sd_percent = 1

[[part]]
name = "box"
shape = "box"
mass_g = 2000
size_mm = [100, 100, 100]
centre_mm = [0, 0, 18]
"""
SWING = """
[[oscillation]]
name = "on a wire"
axis = [0, 0, 1]
stiffness_N_m = 0.1
period_s = {period}
period_sd_s = 0.01
"""
MOMENT = 12 * (0.25 + 0.16) / 12 + 2 * 0.02 / 12  # kg m2, about z


def period(times):
    """The period of so many times the moment."""
    return 2 * np.pi * np.sqrt(times * MOMENT / 0.1)


@pytest.fixture
def parts(tmp_path):
    path = tmp_path / "parts.toml"
    path.write_text(PARTS, encoding="utf-8")
    return path


def test_it_sums_and_says_what_contributes(equipoise, parts):
    done = equipoise("inertia", parts)
    assert done.code == 0
    said = " ".join(done.out.split())
    assert "Two parts: mass, centre of mass from P, inertia about P" in said
    assert "mass 14000" in said
    assert "2 parts are summed" in said
    assert said.index("table 12000") < said.index("box 2000")


def test_json_is_one_document_with_both_points(equipoise, parts, strict_json):
    document = strict_json(equipoise("inertia", parts, "--json").out)
    values = {p["name"]: p["value"] for p in document["estimate"]["parameters"]}
    assert values["mass"] == 14.0
    assert values["com_z"] == 0.0
    about_C = {p["name"]: p["value"] for p in document["inertia_C"]}
    assert about_C["inertia_C_zz"] == pytest.approx(MOMENT)
    assert values["inertia_P_zz"] == pytest.approx(MOMENT)
    ours = json.loads(json.dumps(eq.inertia(parts).to_dict()))
    assert ours == document
    assert list(eq.inertia(parts).to_pandas().columns)
    assert "Mass properties of Two parts" in repr(eq.inertia(parts))


def test_the_testbed_it_writes_has_the_body_and_keeps_the_comments(equipoise, parts):
    words = ("--testbed", "sputnix", "--write", "new.toml", "--out", "out")
    assert equipoise("inertia", parts, *words).code == 0
    text = Path("new.toml").read_text(encoding="utf-8")
    assert "# equipoise inertia" in text
    before, after = eq.preset("sputnix"), read_testbed("new.toml")
    found = eq.inertia(parts)
    assert after.body.mass == pytest.approx(14.0)
    np.testing.assert_allclose(after.body.inertia_P, found.body.inertia_P, rtol=1e-5, atol=1e-9)
    np.testing.assert_allclose(after.com_sd, [p.sd for p in found.estimate.parameters[1:4]], 1e-5)
    sizes = np.sqrt(np.diag(found.body.inertia_P))
    shares = [p.sd / (sizes[i] * sizes[j]) for p, (i, j) in zip(
        found.estimate.parameters[4:], [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)],
        strict=True)]  # fmt: skip
    assert after.inertia_sd == pytest.approx(max(shares), rel=1e-5)
    assert after.mass_names == before.mass_names
    assert (Path("out") / "inertia.json").exists()
    assert "Two parts" in (Path("out") / "report.html").read_text(encoding="utf-8")


def test_a_swing_that_agrees_sharpens_and_one_that_contradicts_writes_nothing(equipoise, parts):
    whole = parts.read_text("utf-8")
    parts.write_text(whole + SWING.format(period=period(1.005)), encoding="utf-8")
    done = equipoise("inertia", parts)
    assert done.code == 0
    assert "Swings about known axes (1) agree" in " ".join(done.out.split())
    parts.write_text(whole + SWING.format(period=period(1.5)), encoding="utf-8")
    done = equipoise("inertia", parts, "--testbed", "sputnix", "--write", "new.toml")
    assert done.code == 1
    assert "contradict each other" in " ".join(done.out.split())
    assert not Path("new.toml").exists()


def test_an_unknown_inertia_that_one_swing_leaves_open_writes_nothing(equipoise, parts):
    text = PARTS.replace('shape = "box"\nmass_g = 12000\nsize_mm = [500, 400, 30]',
                         'shape = "unknown"\nmass_g = 12000')  # fmt: skip
    parts.write_text(text + SWING.format(period=period(1.0)), encoding="utf-8")
    done = equipoise("inertia", parts, "--testbed", "sputnix", "--write", "new.toml")
    assert done.code == 1
    assert "unobservable" in done.out
    assert not Path("new.toml").exists()


@pytest.mark.parametrize(
    ("old", "new", "wanted"),
    [
        ("size_mm = [100, 100, 100]", "size_mm = [100, 100]", "sizes of a box"),
        ('name = "box"', 'name = "table"', "a second 'table'"),
        ("mass_g = 2000", "mass_kg = 2", "the key 'mass_g', in g"),
        ('shape = "box"', 'shape = "cube"', "'cube'"),
        ('shape = "box"', 'shape = "tensor"', "none for 'tensor'"),
    ],
)
def test_a_slip_is_named(equipoise, parts, old, new, wanted):
    parts.write_text(PARTS.replace(old, new), encoding="utf-8")
    done = equipoise("inertia", parts)
    assert (done.code, done.out) == (2, "")
    assert wanted in " ".join(done.err.split())


def test_a_tube_and_a_tensor_are_checked(equipoise, parts):
    tube = PARTS.replace('shape = "box"', 'shape = "tube"').replace("[100, 100, 100]", "[9, 10, 9]")
    parts.write_text(tube, encoding="utf-8")
    assert "outer before inner diameter" in " ".join(equipoise("inertia", parts).err.split())
    with_tensor = PARTS + "inertia_kg_m2 = [1, 1, 1]\n"
    parts.write_text(with_tensor, encoding="utf-8")
    assert "of shape 'tensor' alone" in " ".join(equipoise("inertia", parts).err.split())


def test_what_is_missing_is_named(equipoise, parts):
    assert "no parts file" in equipoise("inertia").err
    done = equipoise("inertia", parts, "--write", "new.toml")
    assert done.code == 2
    assert "no --testbed" in done.err


def test_the_schema_names_the_keys(equipoise):
    schema = json.loads(equipoise("inertia", "--schema").out)
    assert "oscillation" in schema["properties"]


def test_a_recording_shows_the_period_of_its_swing(equipoise, parts, strict_json):
    """40 s of a swing on a wire, written as a CSV beside the parts file."""
    t = np.arange(0, 40, 0.05)
    half = 0.05 * np.cos(2 * np.pi * t / period(1.0)) / 2
    rows = [f"{at:.3f},{np.cos(a):.9f},0,0,{np.sin(a):.9f}" for at, a in zip(t, half, strict=True)]
    text = "\n".join(["time_s,q_w,q_x,q_y,q_z", *rows])
    (parts.parent / "wire.csv").write_text(text, encoding="utf-8")
    made = SWING.replace("period_s = {period}\nperiod_sd_s = 0.01", 'recording = "wire.csv"')
    parts.write_text(PARTS + made, encoding="utf-8")
    (check,) = strict_json(equipoise("inertia", parts, "--json").out)["oscillations"]
    assert check["measured_kg_m2"] == pytest.approx(MOMENT, rel=1e-3)
    parts.write_text(PARTS + made + "period_s = 2.0\n", encoding="utf-8")
    assert "found both; wanted one of" in " ".join(equipoise("inertia", parts).err.split())
