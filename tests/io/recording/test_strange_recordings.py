"""Any recording in: a known motion in many guises is read right, or refused with a remedy.

Right is the motion itself, row for row, up to rounding and to what nobody can know; a command never
ends with 0 on anything else, nor with a traceback.
"""

import json

import numpy as np
import pytest

from equipoise.io.columns.column_map_file import read_column_map
from equipoise.io.columns.read_options import ReadOptions
from equipoise.io.recording.recording_file import read_recording
from equipoise.maths.linalg import pack_symmetric
from tests.support import thorough
from tests.support.recordings import (
    clock_guises,
    frame_guises,
    reported_guises,
    row_guises,
    shape_guises,
    source_guises,
    unit_guises,
)
from tests.support.recordings.judged import Desk, differs, fault_of
from tests.support.recordings.variant import Reads, variants_of
from tests.support.recordings.written_tables import columns, saved, text

KINDS = (clock_guises, frame_guises, row_guises, shape_guises, source_guises, unit_guises)
LEAST = 10  # guises of each kind
REPORTED = variants_of(reported_guises)
# In `make test` too: nothing else shows what they are read by.
SINGLE = (frame_guises.rates_in_laboratory_axes, unit_guises.millidegrees_per_second)
OWN = [each for kind in KINDS for each in thorough.some(variants_of(kind), LEAST)]
OWN += [each for each in SINGLE if each not in OWN]
IDENTIFIED = (
    clock_guises.counter_of_16_bits,
    frame_guises.laboratory_to_body,
    row_guises.four_percent_of_four_kinds,
    shape_guises.semicolons_and_decimal_commas,
    source_guises.ulog_of_px4,
    unit_guises.mpu_6050_of_250_deg_s,
)
EVERY = 5  # in `make test` so many guises' imports are inspected again: that takes the longest
WITHIN = 5.0  # sd


@pytest.mark.parametrize("variant", REPORTED, ids=lambda v: v.name)
def test_what_people_report_is_read_or_refused_with_a_remedy(
    variant, motion, equipoise, tmp_path
) -> None:
    assert fault_of(variant, Desk(motion, tmp_path, equipoise)) == ""


@pytest.mark.parametrize("variant", OWN, ids=lambda v: v.name)
def test_a_guise_is_read_or_refused_with_a_remedy(variant, motion, equipoise, tmp_path) -> None:
    whole = thorough.THOROUGH or OWN.index(variant) % EVERY == 0
    assert fault_of(variant, Desk(motion, tmp_path, equipoise, whole)) == ""


def test_there_are_ten_guises_of_each_kind_at_least() -> None:
    assert min(len(variants_of(kind)) for kind in KINDS) >= LEAST
    names = [variant.name for variant in variants_of(reported_guises, *KINDS)]
    assert len(set(names)) == len(names)


@pytest.mark.parametrize("variant", thorough.some(IDENTIFIED, 2), ids=lambda v: v.name)
def test_the_platform_is_found_in_any_guise(variant, motion, equipoise, tmp_path) -> None:
    path = variant.write(motion, tmp_path)
    assert equipoise("import", path, "--testbed", "nanosat", "--out", "run.csv").code == 0
    identified = equipoise("identify", "run.csv", "--testbed", "nanosat", "--prior", "--json")
    assert identified.code == 0
    found = {each["name"]: each for each in json.loads(identified.out)["parameters"]}
    names = [f"com_{axis}" for axis in "xyz"]
    names += [f"inertia_P_{axes}" for axes in ("xx", "yy", "zz", "xy", "xz", "yz")]
    true = np.append(motion.truth.com, pack_symmetric(motion.truth.inertia_P))
    value, sd = (np.array([found[name][key] for name in names]) for key in ("value", "sd"))
    assert np.abs((value - true) / sd).max() < WITHIN


def test_down_is_no_guess_of_the_import_and_a_map_states_it(motion, equipoise, tmp_path) -> None:
    """FRD to NED is the motion of a mirrored platform with z up: no number shows which it is."""
    down = frame_guises.UPSIDE_DOWN
    q, w = frame_guises.turned(motion, down, down)
    path = saved(tmp_path, text(columns(motion, q=q, w=w)))
    printed = equipoise("import", path, "--testbed", "nanosat", "--write-map", "map.toml")
    assert printed.code == 0
    assert "assumed:" in printed.out
    stated = (tmp_path / "map.toml").read_text()
    assert "lab_up" not in stated
    (tmp_path / "map.toml").write_text('lab_up = "-z"\nbody = ["x", "-y", "-z"]\n' + stated)
    read = read_recording(path, ReadOptions(columns=read_column_map("map.toml")))
    assert differs(read, motion, Reads()) == ""
