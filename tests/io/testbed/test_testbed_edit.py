"""A testbed file is edited where drives changed and nowhere else."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.io.testbed.presets import preset_text
from equipoise.io.testbed.testbed_file import parse_testbed, with_drives

TEXT = preset_text("sputnix")


def mended():
    bed = parse_testbed(TEXT, "t")
    y1 = replace(bed.masses[2], gain=1.05, axis=np.array([0.0, 0.8, 0.6]), backlash=4e-4)
    return replace(bed, masses=(*bed.masses[:2], y1, *bed.masses[3:]))


def test_only_changed_keys_change():
    new = with_drives(TEXT, mended(), {"gain y1": "calibrated"}, "t")
    before, after = TEXT.splitlines(), new.splitlines()
    assert [line for line in before if line not in after] == []  # axis = ... of others remains
    added = [line for line in after if line not in before]
    assert added == ["axis = [0.0, 0.8, 0.6]", "gain = 1.05  # calibrated", "backlash_mm = 0.4"]
    read = parse_testbed(new, "t").masses
    assert read[2].gain == 1.05
    assert read[2].backlash == pytest.approx(4e-4)
    assert all(m.gain == 1.0 for k, m in enumerate(read) if k != 2)


def test_a_mass_in_one_line_is_edited_there():
    """An inline table can hold no comment, so that its remark is left out."""
    head, rest = TEXT.split("[platform]")
    platform = rest.split("[[sliding_mass]]")[0]
    mass = '{name = "x1", mass_g = 1, home_mm = [0, 0, 0], axis = [1, 0, 0], travel_mm = [-1, 1]}'
    text = f"{head}sliding_mass = [{mass}]\n[platform]{platform}"
    bed = parse_testbed(text, "t")
    other = replace(bed, masses=(replace(bed.masses[0], gain=1.1),))
    new = with_drives(text, other, {"gain x1": "calibrated"}, "t")
    assert new == text.replace("[-1, 1]}", "[-1, 1], gain = 1.1}")


def test_what_is_said_beside_a_changed_value_and_of_the_next_table_stays_in_its_place():
    """The next table's comment stands before its head, where the table before it ends."""
    old = "axis = [0.0, 1.0, 0.0]"
    text = TEXT.replace(old, f"{old} # along the beam", 1)
    text = text.replace(
        '\n[[sliding_mass]]\nname = "y2"', '\n# opposite\n[[sliding_mass]]\nname = "y2"'
    )
    lines = with_drives(text, mended(), {}, "t").splitlines()
    assert "axis = [0.0, 0.8, 0.6] # along the beam" in lines
    assert lines[lines.index("# opposite") + 1 :][:2] == ["[[sliding_mass]]", 'name = "y2"']
    assert lines.index("backlash_mm = 0.4") < lines.index("# opposite")
