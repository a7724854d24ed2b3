"""Plan files: there and back, and what a person may have written wrongly."""

from functools import cache

import numpy as np
import pytest

from equipoise.io.documents.plan_file import parse_plan, read_plan, text_of_plan, write_plan
from equipoise.io.testbed.presets import read_preset
from equipoise.model.errors import InputError

TEXT = """
duration_s = 60.0
[start]
tilt_deg = 12.0
low_side = [0.0, -1.0, 0.0]
rate_deg_s = [0.0, 0.0, 3.0]
[standing.at_mm]
coarse_x = 5.0
[[move]]
time_s = 20.0
[move.to_mm]
coarse_z = -30.0
[[wave]]
device = "rw_x"
torque_N_m = -0.001
period_s = 40.0
[predicted]
com_sd_um = [0.1, 0.2, 0.3]
inertia_sd_kg_m2 = [1e-3, 2e-3, 3e-3, 1e-4, 2e-4, 3e-4]
"""


@cache
def table():
    return read_preset("reference-table")


def test_it_is_read_in_si():
    plan = parse_plan(TEXT, table(), "plan.toml")
    m = plan.manoeuvre
    assert m.tilt == pytest.approx(np.radians(12.0))
    assert m.moves == ((20.0, {"coarse_z": pytest.approx(-0.030)}),)
    assert m.standing == {"coarse_x": pytest.approx(0.005)}
    assert (m.waves[0].amplitude, m.waves[0].phase) == (-0.001, 0.25)
    np.testing.assert_allclose(plan.com_sd, [1e-7, 2e-7, 3e-7])
    np.testing.assert_allclose(m.rate, np.radians([0.0, 0.0, 3.0]))
    assert m.tilt_sd == pytest.approx(np.radians(1.0))


def test_there_and_back(tmp_path):
    plan = parse_plan(TEXT, table(), "plan.toml")
    write_plan(plan, table(), tmp_path / "again.toml")
    again = read_plan(tmp_path / "again.toml", table())
    assert text_of_plan(again, table()) == text_of_plan(plan, table())


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("tilt_deg", "tilt_rad", "tilt_deg"),
        ("coarse_z = -30.0", "coarse_y1 = -30.0", "coarse_y"),
        ("coarse_z = -30.0", "coarse_z = -60.0", "-50 to 50 mm"),
        ("time_s = 20.0", "time_s = 70.0", "before duration_s"),
        ('"rw_x"', '"rw_k"', "rw_"),
        ("torque_N_m = -0.001", "torque_N_m = -0.01", "at most 0.005"),
        ("torque_N_m = -0.001", "gimbal_rate_deg_s = 1.0", "torque_N_m"),
        ("[0.0, -1.0, 0.0]", "[0.0, 0.0, 1.0]", "right angles"),
    ],
)
def test_what_cannot_be_done_is_refused_with_what_can(old, new, said):
    with pytest.raises(InputError, match=r"plan\.toml") as caught:
        parse_plan(TEXT.replace(old, new, 1), table(), "plan.toml")
    assert said in str(caught.value)
