"""A testbed file is edited where drives changed and nowhere else."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.io.testbed.presets import preset_text
from equipoise.io.testbed.testbed_edit import with_drives
from equipoise.io.testbed.testbed_file import parse_testbed
from equipoise.model.errors import InputError

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


def test_a_layout_that_it_does_not_understand_is_refused():
    head, rest = TEXT.split("[platform]")
    platform = rest.split("[[sliding_mass]]")[0]
    mass = '{name = "x1", mass_g = 1, home_mm = [0, 0, 0], axis = [1, 0, 0], travel_mm = [-1, 1]}'
    text = f"{head}sliding_mass = [{mass}]\n[platform]{platform}"
    bed = parse_testbed(text, "t")
    other = replace(bed, masses=(replace(bed.masses[0], gain=1.1),))
    with pytest.raises(InputError, match="layout"):
        with_drives(text, other, {}, "t")
