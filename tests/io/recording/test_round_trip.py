"""A recording written and read again is the same recording."""

import hashlib
import sys
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from equipoise.io.recording.recording_file import read_recording, write_recording
from equipoise.maths.attitude import exponential
from equipoise.model.errors import InputError
from equipoise.model.recording import CHANNELS, Recording, Samples

NAMES = st.lists(
    st.from_regex(r"[a-z][a-z0-9_]{0,5}", fullmatch=True), min_size=1, max_size=3, unique=True
)

DEVICES = st.lists(
    st.from_regex(r"(wheel|gimbal|dipole|cage|jet):[a-z][a-z0-9_]{0,5}", fullmatch=True),
    min_size=1,
    max_size=4,
    unique=True,
)
CAUSES = st.lists(
    st.from_regex(r"(gravity|sag|moves|total)_(sd_)?[xyz]", fullmatch=True),
    min_size=1,
    max_size=4,
    unique=True,
)
# Not in SI in the file: to units in the last place.
ULP = {"masses": 2, "field": 2, "devices": 4}


def times(rng: np.random.Generator, n: int) -> np.ndarray:
    """Draw strictly growing times, some shared between channels and some not."""
    return np.cumsum(rng.choice([0.1, 0.25, 1 / 3], size=n)) + rng.choice([0.0, 0.1, 1e5])


@st.composite
def channels(draw: st.DrawFn) -> dict[str, Any]:
    """Draw what makes a recording: any channels, at least one sensor, each at its own times.

    The recording itself is made in the test: the run-time checks of its types test a random
    item of a tuple, and strategies may not use ``random``.
    """
    rng = np.random.default_rng(draw(st.integers(0, 2**32)))
    n = draw(st.integers(3, 40))

    def vectors(scale: float, k: int = 3) -> Samples:
        m = draw(st.integers(3, 40))
        return Samples(times(rng, m), rng.normal(size=(m, k)) * scale)

    turns = np.cumsum(rng.normal(scale=0.05, size=(n, 3)), axis=0)
    attitude = Samples(times(rng, n), exponential(turns)) if draw(st.booleans()) else None
    names = tuple(draw(NAMES)) if draw(st.booleans()) else ()
    devices = tuple(draw(DEVICES)) if draw(st.booleans()) else ()
    causes = tuple(draw(CAUSES)) if draw(st.booleans()) else ()
    return {
        "attitude": attitude,
        "rate": vectors(0.1) if attitude is None or draw(st.booleans()) else None,
        "mass_names": names,
        "masses": vectors(0.05, len(names)) if names else None,
        "momentum": vectors(1e-3) if draw(st.booleans()) else None,
        "torque": vectors(1e-6) if draw(st.booleans()) else None,
        "device_names": devices,
        "devices": vectors(10.0, len(devices)) if devices else None,
        "field": vectors(5e-5) if draw(st.booleans()) else None,
        "temperature": vectors(20.0, 1) if draw(st.booleans()) else None,
        "lamp": vectors(1.0, 1) if draw(st.booleans()) else None,
        "accelerometer": vectors(9.8) if draw(st.booleans()) else None,
        "sun": vectors(1.0) if draw(st.booleans()) else None,
        "cause_names": causes,
        "torque_by_cause": vectors(1e-6, len(causes)) if causes else None,
    }


def assert_same(again: Recording, first: Recording) -> None:
    """Every channel to the last bit; what is not in SI in the file, to a few units of the last."""
    assert again.mass_names == first.mass_names
    assert again.device_names == first.device_names
    assert again.cause_names == first.cause_names
    for name in CHANNELS:
        ours, theirs = getattr(again, name), getattr(first, name)
        assert (ours is None) == (theirs is None)
        if ours is None:
            continue
        np.testing.assert_array_equal(ours.t, theirs.t)
        np.testing.assert_array_max_ulp(ours.values, theirs.values, maxulp=ULP.get(name, 0))
    for k, name in enumerate(first.device_names):
        if not name.startswith(("gimbal", "cage")):
            np.testing.assert_array_equal(again.devices.values[:, k], first.devices.values[:, k])


@pytest.mark.parametrize("suffix", ["csv", "parquet"])
@settings(max_examples=60, deadline=None)
@given(parts=channels())
def test_a_recording_comes_back_to_the_last_bit(tmp_path_factory, suffix, parts) -> None:
    """Channels at their own times share one table and part again; nothing needs to be mended."""
    if suffix == "parquet":
        pytest.importorskip("pyarrow", reason="the parquet extra is not installed")
    first = Recording(**parts)
    path = tmp_path_factory.mktemp("r") / f"r.{suffix}"
    write_recording(first, path)
    again = read_recording(path)
    assert_same(again, first)
    assert again.notes == ()


LEVEL = np.tile([1.0, 0.0, 0.0, 0.0], (3, 1))


def simple(n: int = 5) -> Recording:
    """Return a small recording with a mass."""
    t = np.arange(n) * 0.2
    q = exponential(np.linspace(0, 0.1, n)[:, None] * np.array([1.0, 2.0, 3.0]))
    masses = Samples(t[::2], np.full((len(t[::2]), 1), 0.0123))
    return Recording(attitude=Samples(t, q), mass_names=("x1",), masses=masses)


def test_the_hash_is_of_the_bytes_and_the_source_is_the_path(tmp_path) -> None:
    """Provenance names the very file."""
    path = tmp_path / "r.csv"
    write_recording(simple(), path)
    recording = read_recording(path)
    assert recording.sha256 == hashlib.sha256(path.read_bytes()).hexdigest()
    assert recording.source == str(path)


def test_the_header_is_the_documented_one(tmp_path) -> None:
    """Units are in the names, millimetres in the cells, blank where a channel is silent."""
    path = tmp_path / "r.csv"
    write_recording(simple(), path)
    lines = path.read_text().splitlines()
    assert lines[0] == "time_s,q_w,q_x,q_y,q_z,mass_x1_mm"
    assert lines[1].endswith(",12.3")
    assert lines[2].endswith(",")


def test_each_kind_of_device_has_its_unit_in_the_header(tmp_path) -> None:
    """A speed in rad/s, an angle in deg, a dipole, a torque; fields in uT; in their order."""
    path, t = tmp_path / "r.csv", np.arange(3.0)
    names = ("jet:y", "wheel:r_s", "gimbal:a", "dipole:x", "cage:c_T")
    rows = Samples(t[:1], np.array([[0.02, -10.5, np.pi / 4, 0.4, -3e-5]]))
    field = Samples(t[:1], np.array([[0, -2e-5, 5e-5]]))
    write_recording(
        Recording(Samples(t, LEVEL), device_names=names, devices=rows, field=field), path
    )
    head, first, second, _ = path.read_text().splitlines()
    columns = (
        "jet_y_N_m,wheel_r_s_rad_s,gimbal_a_deg,dipole_x_A_m2,cage_c_T_uT,"
        "field_x_uT,field_y_uT,field_z_uT"
    )
    assert head == f"time_s,q_w,q_x,q_y,q_z,{columns}"
    cells = list(map(float, first.split(",")[5:]))
    np.testing.assert_allclose(cells, [0.02, -10.5, 45, 0.4, -30, 0, -20, 50], rtol=1e-15)
    assert second.endswith(",,,,,,,")
    again = read_recording(path)
    assert again.device_names == names
    assert_same(again, Recording(Samples(t, LEVEL), device_names=names, devices=rows, field=field))


def test_a_device_that_never_turns_is_kept_and_a_dead_magnetometer_is_not(tmp_path) -> None:
    """A wheel at rest is a fact; a field of zero is nobody's."""
    path, t = tmp_path / "r.csv", np.arange(3.0)
    still, dead = Samples(t, np.zeros((3, 1))), Samples(t, np.zeros((3, 3)))
    write_recording(
        Recording(Samples(t, LEVEL), device_names=("wheel:x",), devices=still, field=dead), path
    )
    again = read_recording(path)
    assert again.device_names == ("wheel:x",)
    assert again.field is None
    assert any(note.startswith("field: zero in every row") for note in again.notes)


def test_a_device_of_no_kind_is_not_written(tmp_path) -> None:
    """Its unit would be anyone's guess."""
    rows = Samples(np.arange(3.0), np.ones((3, 1)))
    with pytest.raises(InputError, match=r"found 'x'; wanted its name after 'wheel:', 'gimbal:'"):
        write_recording(
            Recording(
                rate=Samples(np.arange(3.0), np.ones((3, 3))), device_names=("x",), devices=rows
            ),
            tmp_path / "r.csv",
        )
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("name", ["r.xlsx", "r"])
def test_an_unknown_suffix_is_refused(tmp_path, name) -> None:
    """What is written is what the suffix says."""
    with pytest.raises(InputError, match=r"ending in \.csv, \.parquet,"):
        write_recording(simple(), tmp_path / name)


def test_values_that_are_not_finite_are_refused(tmp_path) -> None:
    """They would come back as blank cells."""
    rate = Samples(np.arange(3.0), np.full((3, 3), np.nan))
    with pytest.raises(InputError, match="rate values that are not finite"):
        write_recording(Recording(rate=rate), tmp_path / "r.csv")
    assert list(tmp_path.iterdir()) == []


def test_without_pyarrow_the_sentence_names_the_extra(tmp_path, monkeypatch) -> None:
    """The extra is named both on writing and on reading."""
    monkeypatch.setitem(sys.modules, "pyarrow.parquet", None)
    with pytest.raises(InputError, match=r'pip install "equipoise\[parquet\]"'):
        write_recording(simple(), tmp_path / "r.parquet")
    (tmp_path / "r.parquet").write_bytes(b"PAR1....PAR1")
    with pytest.raises(InputError, match=r'pip install "equipoise\[parquet\]"'):
        read_recording(tmp_path / "r.parquet")
