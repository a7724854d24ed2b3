"""``docs/tutorial.md``, followed to the letter with a table of a motion that MuJoCo made."""

import contextlib
import io
import json
import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest

from equipoise.app.cli import run
from tests.docs.test_examples import ROOT, blocks, commands
from tests.support.odd_table import odd_table, platform

BLOCKS = blocks((ROOT / "docs" / "tutorial.md").read_text(encoding="utf-8"))
NUMBER = re.compile(r"-?\d+(?:\.\d+)?")


@dataclass(frozen=True)
class Step:
    """A command of the page, what it printed, and what the page says that it prints."""

    words: list[str]
    code: int
    out: str
    shown: list[str]

    def line_like(self, shown: str) -> str | None:
        """Return the stretch of the output with the same words, whatever its numbers."""
        form = NUMBER.sub("NUMBER", " ".join(shown.split()))
        pattern = re.escape(form).replace("NUMBER", NUMBER.pattern)
        found = re.search(pattern, " ".join(self.out.split()))
        return found and found[0]


@pytest.fixture(scope="module")
def laboratory(tmp_path_factory) -> Path:
    folder = tmp_path_factory.mktemp("laboratory")
    (folder / "log.csv").write_text(odd_table())
    return folder


@pytest.fixture(scope="module")
def steps(laboratory) -> list[Step]:
    """Return what came of following the page."""
    found: list[Step] = []
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(laboratory)
        for block in BLOCKS:
            if block.kind == "toml":
                (laboratory / "my.toml").write_text(block.text)
            elif given := commands(block):
                ((_, words),) = given
                with contextlib.redirect_stdout(io.StringIO()) as stream:
                    code = run(words[1:])
                found.append(Step(words, code, stream.getvalue(), []))
            elif found:
                found[-1].shown.extend(line for line in block.text.splitlines() if line != "...")
    return found


def test_the_table_of_the_page_is_the_one_that_is_read(laboratory):
    shown = BLOCKS[0].text.splitlines()
    assert (laboratory / "log.csv").read_text().splitlines()[: len(shown)] == shown


def test_every_command_ends_well(steps):
    assert [step.words[1] for step in steps] == ["new", "import", "inspect", "identify"]
    assert [step.code for step in steps] == [0, 0, 0, 0]


def test_every_command_prints_what_the_page_shows(steps):
    """Numbers may differ by the last digits shown: sums are not rounded alike everywhere."""
    assert all(step.shown for step in steps[1:])
    for step in steps:
        for shown in step.shown:
            printed = step.line_like(shown)
            assert printed is not None, shown
            numbers = [[*map(float, NUMBER.findall(line))] for line in (shown, printed)]
            np.testing.assert_allclose(numbers[1], numbers[0], rtol=0.03, atol=2e-3, err_msg=shown)


def test_the_truth_is_within_the_stated_intervals(steps, laboratory):
    document = json.loads((laboratory / "identified" / "estimate.json").read_text())
    found = {each["name"]: each for each in document["parameters"]}
    true, J = platform(), platform().inertia_P
    truth = {f"com_{axis}": true.com[k] for k, axis in enumerate("xyz")}
    truth |= {f"inertia_P_{a}{b}": J["xyz".index(a), "xyz".index(b)]
              for a, b in ("xx", "yy", "zz", "xy", "xz", "yz")}  # fmt: skip
    off = {
        name: (found[name]["value"] - value) / found[name]["sd"] for name, value in truth.items()
    }
    assert {name: sd for name, sd in off.items() if not abs(sd) < 5} == {}
    assert all(found[name]["observable"] for name in truth)


def test_the_intervals_are_as_narrow_as_the_page_says(steps, laboratory):
    """Aside 0.7 um, height 3 %, moments 3 %, their ratios a few parts in ten thousand."""
    document = json.loads((laboratory / "identified" / "estimate.json").read_text())
    names = [each["name"] for each in document["parameters"]]
    cov, J = np.array(document["covariance"]), platform().inertia_P
    sd = dict(zip(names, np.sqrt(np.diag(cov)), strict=True))
    assert max(sd["com_x"], sd["com_y"]) < 0.7e-6
    assert sd["com_z"] < 0.03 * 160e-6
    moments = [names.index(f"inertia_P_{axis}{axis}") for axis in "xyz"]
    relative = cov[np.ix_(moments, moments)] / np.outer(np.diag(J), np.diag(J))
    assert (np.sqrt(np.diag(relative)) < 0.03).all()
    for ratio in ([1, 0, -1], [0, 1, -1]):
        assert np.sqrt(ratio @ relative @ ratio) < 4e-4
