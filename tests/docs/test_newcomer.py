"""A newcomer's path ends with a result that holds the truth, within the words it may take."""

import json
import sys
from pathlib import Path

from tests.docs.newcomer import CLAIMED_PERSON, Walk, report, walk
from tests.support.odd_table import platform


def test_minutes_by_hand():
    """400 words at 200 a minute, 199 letters and Enter are 40 words at 40 a minute."""
    done = Walk(["word " * 400], ["x" * 199], {"a": 60.0, "b": 30.0})
    assert (done.reading, done.typing, done.machine) == (2.0, 1.0, 1.5)
    assert list(report(done))[-2:] == ["reading and typing: 3.0 min, under 15 min",
                                       "machine: 1.5 min, under 2 min"]  # fmt: skip


def test_the_path_leads_to_the_truth(tmp_path):
    done = walk(tmp_path, Path(sys.executable))
    assert done.reading + done.typing < CLAIMED_PERSON
    found = json.loads((tmp_path / "identified" / "estimate.json").read_text())
    by_name = {each["name"]: each for each in found["parameters"]}
    for name, truth in zip(("com_x", "com_y", "com_z"), platform().com, strict=True):
        assert abs(by_name[name]["value"] - truth) < 5 * by_name[name]["sd"]
        assert by_name[name]["observable"]
