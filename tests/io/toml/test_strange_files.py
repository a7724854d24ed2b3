"""TOML files that no bench has: far too deep, far too long, numbers beyond all."""

import pytest

from equipoise.io.columns.column_map_file import read_column_map
from equipoise.io.documents.camera_file import read_camera_keys
from equipoise.io.documents.manual_session import read_session
from equipoise.io.testbed.presets import preset_text
from equipoise.io.testbed.testbed_file import read_testbed
from equipoise.io.toml import read_toml
from equipoise.model.errors import InputError

READERS = (read_testbed, read_column_map, read_camera_keys, read_session)
DEEP = {
    "a dotted key": ".".join(["a"] * 20_000) + " = 1",
    "a dotted key in quotes": ".".join(['"a"'] * 20_000) + " = 1",
    "a header": "[" + ".".join(["a"] * 20_000) + "]",
    "lists": "a = " + "[" * 5000 + "]" * 5000,
    "lists without an end": "a = " + "[" * 5000,
    "tables": "a = " + "{a = " * 5000 + "1" + "}" * 5000,
    "one too many": "a = " + "[" * 33 + "]" * 33,
    "behind a text": "b = '''[[[[[['''\na = " + "[" * 5000,
}


@pytest.mark.parametrize("read", READERS, ids=lambda each: each.__name__)
@pytest.mark.parametrize("name", DEEP)
def test_what_is_too_deep_is_not_parsed(tmp_path, monkeypatch, name, read):
    """A parser took 27 s for the first of them, and ended in a RecursionError at others."""
    monkeypatch.setattr(read_toml, "tomllib", None)
    path = tmp_path / "a.toml"
    path.write_text(DEEP[name], encoding="utf-8")
    with pytest.raises(InputError, match="deep in others; wanted at most 32") as refused:
        read(path)
    assert len(str(refused.value)) < 300


def test_what_is_not_deep_is_parsed(tmp_path):
    """Points and brackets within texts, remarks and lists of numbers are none of keys."""
    remark = "# " + "[[[[ a.b.c. " * 100
    text = f"{remark}\n" + preset_text("nanosat").replace("[0, 0, 0]", "[0.0, 0.0, 0.0]")
    path = tmp_path / "a.toml"
    path.write_text(text + "\n" + remark, encoding="utf-8")
    assert read_testbed(path).masses


@pytest.mark.parametrize("read", READERS, ids=lambda each: each.__name__)
def test_what_is_too_long_is_not_read(tmp_path, read):
    path = tmp_path / "a.toml"
    path.write_text("# more\n" * 200_000, encoding="utf-8")
    with pytest.raises(InputError, match="found more than 1 MB"):
        read(path)


@pytest.mark.parametrize("read", READERS, ids=lambda each: each.__name__)
def test_a_number_of_too_many_digits_is_refused(tmp_path, read):
    path = tmp_path / "a.toml"
    path.write_text("a = " + "1" * 5000, encoding="utf-8")
    with pytest.raises(InputError, match="4300 digits"):
        read(path)


@pytest.mark.parametrize(
    ("key", "written", "wanted"),
    [
        ("mass_kg = ", "1e160", "no larger than 1e+05, in kg"),
        ("mass_g = ", "1e308", "no larger than 1e+08, in g"),
        ("rate_hz = ", "1.7e9", "no larger than 1e+07, in Hz"),
        ("gravity_m_s2 = ", "1e300", "no larger than 1e+04, in m/s2"),
    ],
)
def test_a_number_that_no_bench_has_is_refused(tmp_path, key, written, wanted):
    """The sizes worked by hand: 100 t, 10 MHz, a thousand g."""
    lines = preset_text("sputnix").splitlines()
    at = next((k for k, line in enumerate(lines) if line.startswith(key)), None)
    path = tmp_path / "a.toml"
    if at is None:
        lines, at = [f"{key}1", *lines], 0
    lines[at] = key + written
    path.write_text("\n".join(lines), encoding="utf-8")
    with pytest.raises(InputError) as refused:
        read_testbed(path)
    assert wanted in str(refused.value)
