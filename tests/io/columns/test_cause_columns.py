"""Columns of torque by cause are told from that of a known torque; a misspelt cause is refused."""

import pytest

from equipoise.io.columns.cause_columns import cause_column, cause_of
from equipoise.io.columns.native_columns import native_map
from equipoise.model.errors import InputError
from equipoise.model.torque_by_cause import CAUSES, TOTAL


def test_columns_and_names_go_both_ways():
    for cause in (*CAUSES, TOTAL):
        for name in (f"{cause}_x", f"{cause}_sd_z"):
            found = cause_of(cause_column(name))
            assert (found.name, found.column, found.factor) == (name, f"torque_{name}_N_m", 1.0)


@pytest.mark.parametrize("column", ["torque_x_N_m", "torque_wind_x_N_m", "torque_sag_x_uN_m"])
def test_another_column_is_of_no_cause(column):
    assert cause_of(column) is None


def test_a_header_with_both_has_both():
    names = ("time_s", "omega_x_rad_s", "omega_y_rad_s", "omega_z_rad_s", "torque_air_sd_y_N_m",
             "torque_x_N_m", "torque_y_N_m", "torque_z_N_m")  # fmt: skip
    columns = native_map(names, "run.csv")
    assert [each.name for each in columns.torque_by_cause] == ["air_sd_y"]
    assert columns.torque.names == names[-3:]


def test_a_cause_that_there_is_not_is_refused():
    with pytest.raises(InputError, match="torque_wind_x_N_m"):
        native_map(("time_s", "q_w", "q_x", "q_y", "q_z", "torque_wind_x_N_m"), "run.csv")
