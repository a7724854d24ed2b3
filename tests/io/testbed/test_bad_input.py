"""Bad testbed files: one sentence with the file, the key, what was found and what was wanted."""

import re

import pytest

from equipoise.io.testbed.testbed_file import parse_testbed, read_testbed, write_testbed
from equipoise.model.errors import InputError

GOOD = """name = "t"
[platform]
mass_kg = 14.24
inertia_kg_m2 = [[0.3, 0, 0], [0, 0.5, 0], [0, 0, 0.7]]
com_um = [0, 0, -90]
[[sliding_mass]]
name = "x1"
mass_g = 15.6
home_mm = [200, 0, 0]
axis = [1, 0, 0]
travel_mm = [-50, 50]
[sensor.gyro]
rate_hz = 100
noise_deg_s = 0.05
[truth]
tilt_deg = 3
"""
INERTIA = "[[0.3, 0, 0], [0, 0.5, 0], [0, 0, 0.7]]"

CASES = {
    "misspelt key": ("mass_kg", "mas_kg", "platform.mas_kg", ["'mass_kg'"]),
    "unknown key": ("com_um = ", "colour = ", "platform.colour", ["unknown key 'colour'"]),
    "unknown table": ("[truth]", "[trooth]", "trooth", ["'truth'"]),
    "missing key": (
        "mass_kg = 14.24\n",
        "",
        "platform.mass_kg",
        ["no such key; wanted it in the table platform, in kg"],
    ),
    "missing name": ('name = "t"\n', "", "name", ["no such key; wanted it above all tables"]),
    "missing range": (
        "travel_mm = [-50, 50]\n",
        "",
        "sliding_mass[1].travel_mm",
        ["it in the table sliding_mass[1], in mm: least and greatest displacement"],
    ),
    "missing table": (
        "[platform]\nmass_kg = 14.24\ninertia_kg_m2 = [[0.3, 0, 0], [0, 0.5, 0], [0, 0, 0.7]]\n"
        "com_um = [0, 0, -90]\n",
        "",
        "platform",
        ["no such key; wanted a table of this name"],
    ),
    "negative mass": ("14.24", "-14.24", "platform.mass_kg", ["-14.24", "above 0", "in kg"]),
    "mass is zero": ("15.6", "0", "sliding_mass[1].mass_g", ["above 0", "in g"]),
    "not a number": ("14.24", "nan", "platform.mass_kg", ["nan", "finite"]),
    "infinite": ("14.24", "inf", "platform.mass_kg", ["inf", "finite"]),
    "unit in the value": ("14.24", '"14 kg"', "platform.mass_kg", ["'14 kg'", "in kg"]),
    "no unit in the key": ("mass_kg = 14.24", 'mass = "14 kg"', "platform.mass", ["'mass_kg'"]),
    "grams for kilograms": ("mass_kg = 14.24", "mass_g = 14240", "platform.mass_g", ["'mass_kg'"]),
    "mm for um": ("com_um", "com_mm", "platform.com_mm", ["'com_um', in um", "unit belongs"]),
    "deg for deg/s": ("noise_deg_s", "noise_deg", "sensor.gyro.noise_deg", ["'noise_deg_s'"]),
    "true for a number": ("14.24", "true", "platform.mass_kg", ["True", "number"]),
    "two numbers": ("[0, 0, -90]", "[0, -90]", "platform.com_um", ["[0, -90]", "list of 3"]),
    "four numbers": ("[0, 0, -90]", "[0, 0, 0, 0]", "platform.com_um", ["list of 3"]),
    "text in a list": ("[0, 0, -90]", '[0, 0, "-90 um"]', "platform.com_um[3]", ["'-90 um'"]),
    "gap that ends early": (
        "tilt_deg = 3",
        "[[truth.gap]]\nstart_s = 3\nend_s = 2",
        "truth.gap[1].end_s",
        ["2 s", "starts at 3 s", "a later time"],
    ),
    "contact before all": (
        "tilt_deg = 3",
        "[[truth.contact]]\ntime_s = 0\nimpulse_N_m_s = [0, 0, 1]",
        "truth.contact[1].time_s",
        ["above 0", "in s"],
    ),
    "three plumbs": ("tilt_deg = 3", "plumb_deg = [1, 2, 3]", "truth.plumb_deg", ["list of 2"]),
    "too many bad rows": (
        "tilt_deg = 3",
        "bad_rows_percent = 101",
        "truth.bad_rows_percent",
        ["at most 100"],
    ),
    "lopsided inertia": (
        INERTIA,
        "[[0.3, 0.1, 0], [0, 0.5, 0], [0, 0, 0.7]]",
        "platform.inertia_kg_m2",
        ["row 1, column 2 = 0.1", "symmetric"],
    ),
    **{
        f"inertia of {kind}": (
            INERTIA,
            shape,
            "platform.inertia_kg_m2",
            [shape, "three moments [xx, yy, zz], or three rows [[xx, xy, xz], ", "in kg m2"],
        )
        for kind, shape in {
            "one number": "0.3",
            "two moments": "[0.3, 0.5]",
            "six elements": "[0.3, 0.5, 0.7, 0, 0, 0]",
            "two rows": "[[0.3, 0, 0], [0, 0.5, 0]]",
            "short rows": "[[0.3, 0], [0, 0.5], [0, 0]]",
            "moments and a row": "[0.3, 0.5, [0, 0, 0.7]]",
            "a word": "[0.3, 'big', 0.7]",
        }.items()
    },
    "word in a row": (
        INERTIA,
        '[[0.3, "so", 0], [0, 0.5, 0], [0, 0, 0.7]]',
        "platform.inertia_kg_m2[1][2]",
        ["'so'", "a number without quotes, in kg m2"],
    ),
    "impossible moments": (
        INERTIA,
        "[0.3, 0.5, 0.9]",
        "platform.inertia_kg_m2",
        ["physically inconsistent inertia", "0.9 < 0.3 + 0.5 = 0.8"],
    ),
    "impossible inertia": (
        INERTIA,
        "[[0.3, 0, 0], [0, 0.5, 0], [0, 0, 0.9]]",
        "platform.inertia_kg_m2",
        ["physically inconsistent inertia", "0.9 < 0.3 + 0.5 = 0.8"],
    ),
    "negative moment": (
        INERTIA,
        "[[0.3, 0, 0], [0, -0.5, 0], [0, 0, 0.7]]",
        "platform.inertia_kg_m2",
        ["physically inconsistent inertia", "-0.5", "positive"],
    ),
    "zero axis": ("axis = [1, 0, 0]", "axis = [0, 0, 0]", "sliding_mass[1].axis", ["length 0"]),
    "travel upside down": ("[-50, 50]", "[50, -50]", "sliding_mass[1].travel_mm", ["[50, -50]"]),
    "home not in travel": ("[-50, 50]", "[10, 50]", "sliding_mass[1].travel_mm", ["home (0)"]),
    "a name with a comma": ('"x1"', '"x,1"', "sliding_mass[1].name", ["x,1", "letters"]),
    "heavier than the platform": ("15.6", "15600", "platform.mass_kg", ["15.6 kg"]),
    "no gyro noise": ("noise_deg_s = 0.05\n", "", "sensor.gyro", ["neither", "noise_deg_s"]),
    "both gyro noises": (
        "noise_deg_s = 0.05",
        "noise_deg_s = 0.05\nnoise_density_deg_s_rthz = 0.1",
        "sensor.gyro",
        ["both"],
    ),
    "unknown disturbance": (
        "[truth]",
        '[disturbance]\nconsider = ["viscus"]\n[truth]',
        "disturbance.consider",
        ["'viscus'", "'viscous'"],
    ),
    "wrong point": ("com_um", 'about = "D"\ncom_um', "platform.about", ["'D'", "'C' or 'P'"]),
    "fault of no mass": (
        "tilt_deg = 3",
        '[[truth.fault]]\nmass = "x2"',
        "truth.fault[1].mass",
        ["'x2'", "x1"],
    ),
    "assumed what is not there": (
        "tilt_deg = 3",
        '[assumed]\n"platform.color" = "so"',
        "assumed.'platform.color'",
        ["no such key"],
    ),
    "box inside out": (
        "tilt_deg = 3",
        "com_low_um = [0, 0, 9999]",
        "truth.com_low_um",
        ["above com_high_um"],
    ),
}


@pytest.mark.parametrize(("old", "new", "key", "words"), CASES.values(), ids=CASES.keys())
def test_a_bad_key_is_named_with_what_was_wanted(old, new, key, words) -> None:
    """File and dotted key come first, then found and wanted, in one line."""
    assert old in GOOD
    with pytest.raises(InputError) as caught:
        parse_testbed(GOOD.replace(old, new, 1), "my.toml")
    sentence = str(caught.value)
    assert sentence.startswith(f"my.toml: {key}")
    assert re.search("; (wanted|did you mean) ", sentence)
    assert "\n" not in sentence
    for word in words:
        assert word in sentence


def test_the_good_file_is_good() -> None:
    """The cases above fail for the reason they state."""
    assert parse_testbed(GOOD, "my.toml").name == "t"


def test_broken_toml_is_named_with_its_line() -> None:
    """A missing bracket is found on its line."""
    with pytest.raises(InputError, match=r"my\.toml, line 2: found '\[platform'"):
        parse_testbed(GOOD.replace("[platform]", "[platform"), "my.toml")


def test_toml_cut_short_is_named() -> None:
    """A file that ends within a list is said to."""
    with pytest.raises(InputError, match="valid TOML"):
        parse_testbed('name = "t"\nx = [1, 2', "my.toml")


@pytest.mark.parametrize(
    ("content", "found"),
    [(None, "no such file"), (b"", "empty"), (b" \n", "empty"), (b"\x00\x01\x02", "binary")],
)
def test_a_file_that_is_no_text_is_named(tmp_path, content, found) -> None:
    """Missing, empty and binary files are distinguished."""
    path = tmp_path / "my.toml"
    if content is not None:
        path.write_bytes(content)
    with pytest.raises(InputError, match=found) as caught:
        read_testbed(path)
    assert str(path) in str(caught.value)
    assert "a testbed file" in str(caught.value)


def test_a_directory_is_no_testbed(tmp_path) -> None:
    """A directory is named as one."""
    with pytest.raises(InputError, match="a directory"):
        read_testbed(tmp_path)


def test_a_bad_text_is_not_written(tmp_path) -> None:
    """What cannot be read is not written either."""
    with pytest.raises(InputError):
        write_testbed("name = 3", tmp_path / "out.toml")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    "escaped",
    ["\\u001b[31mred", "a\\u0007b", "a\\nb", "a\\u0000b", "\\u202Etxt.elif", "a\\u200Bb",
     "\\u2066a", "a\\u2028b", "\\uFEFFa", "a\\u00ADb", "\\uE000"],
)  # fmt: skip
def test_a_name_with_invisible_characters_is_refused(escaped):
    """Colours of a terminal, a bell, an override of the direction; the sentence shows none."""
    with pytest.raises(InputError) as caught:
        parse_testbed(GOOD.replace('name = "t"', f'name = "{escaped}"'), "bed.toml")
    assert str(caught.value).isprintable()
    assert caught.value.where == "bed.toml: name"
    assert "invisible characters" in caught.value.wanted


@pytest.mark.parametrize("name", ["Стенд", "卫星平台", "plate-forme nº 2", "منصة", "µSat"])
def test_a_name_in_any_script_is_read(name):
    assert parse_testbed(GOOD.replace('name = "t"', f'name = "{name}"'), "bed.toml").name == name


@pytest.mark.parametrize("name", ["x\\u202E1", "x1\\n", "x\\u001b"])
def test_a_name_of_a_mass_is_of_plain_letters(name):
    with pytest.raises(InputError, match="a letter, then letters"):
        parse_testbed(GOOD.replace('name = "x1"', f'name = "{name}"'), "bed.toml")
