"""A recording written and read again is the same recording."""

import hashlib
import sys
import time
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from equipoise.io.recording_file import read_recording, write_recording
from equipoise.maths.attitude import exponential
from equipoise.model.errors import InputError
from equipoise.model.recording import CHANNELS, Recording, Samples

NAMES = st.lists(
    st.from_regex(r"[a-z][a-z0-9_]{0,5}", fullmatch=True), min_size=1, max_size=3, unique=True
)


def times(rng: np.random.Generator, n: int) -> np.ndarray:
    """Draw strictly growing times, some shared between channels and some not."""
    return np.cumsum(rng.choice([0.1, 0.25, 1 / 3], size=n)) + rng.choice([0.0, 0.1, 1e5])


@st.composite
def channels(draw: st.DrawFn) -> dict[str, Any]:
    """Draw what makes a recording: any channels, at least one sensor, each at its own times.

    The recording itself is made in the test: the run-time checks of its types look at a random
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
    return {
        "attitude": attitude,
        "rate": vectors(0.1) if attitude is None or draw(st.booleans()) else None,
        "mass_names": names,
        "masses": vectors(0.05, len(names)) if names else None,
        "momentum": vectors(1e-3) if draw(st.booleans()) else None,
        "torque": vectors(1e-6) if draw(st.booleans()) else None,
    }


def assert_same(again: Recording, first: Recording) -> None:
    """Every channel to the last bit; masses, stored in mm, within two units in the last place."""
    assert again.mass_names == first.mass_names
    for name in CHANNELS:
        ours, theirs = getattr(again, name), getattr(first, name)
        assert (ours is None) == (theirs is None)
        if ours is None:
            continue
        np.testing.assert_array_equal(ours.t, theirs.t)
        if name == "masses":
            np.testing.assert_array_max_ulp(ours.values, theirs.values, maxulp=2)
        else:
            np.testing.assert_array_equal(ours.values, theirs.values)


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
    assert [note for note in again.notes if " gap" not in note] == []


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


@pytest.mark.parametrize("name", ["r.xlsx", "r"])
def test_an_unknown_suffix_is_refused(tmp_path, name) -> None:
    """What is written is what the suffix says."""
    with pytest.raises(InputError, match=r"\.csv or \.parquet"):
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
    with pytest.raises(InputError, match=r"pip install equipoise\[parquet\]"):
        write_recording(simple(), tmp_path / "r.parquet")
    (tmp_path / "r.parquet").write_bytes(b"PAR1....PAR1")
    with pytest.raises(InputError, match=r"pip install equipoise\[parquet\]"):
        read_recording(tmp_path / "r.parquet")


def test_half_an_hour_at_100_hz_is_read_in_seconds(tmp_path) -> None:
    """180 000 rows of 8 columns; 15 s is several times what a slow, busy machine needs."""
    n = 180_000
    rng = np.random.default_rng(1)
    t = np.arange(n) * 0.01
    q = exponential(np.cumsum(rng.normal(scale=1e-3, size=(n, 3)), axis=0))
    write_recording(
        Recording(attitude=Samples(t, q), rate=Samples(t, rng.normal(size=(n, 3)))),
        tmp_path / "r.csv",
    )
    start = time.perf_counter()
    recording = read_recording(tmp_path / "r.csv")
    assert time.perf_counter() - start < 15
    assert recording.rate is not None
    assert len(recording.rate) == n
