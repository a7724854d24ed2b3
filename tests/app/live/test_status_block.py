"""What a person at a terminal sees of a bench; who is cut off from one gets what was there before.

The commands run as programs at pseudo terminals; what they write is read byte by byte.
"""

import io
import re
import subprocess
from dataclasses import replace

import numpy as np
import pytest
from rich.console import Console

from equipoise.app.cli import BY_HAND
from equipoise.app.console import terminal
from equipoise.app.live.status_block import RecordingView, TerminalView, filled, watched_by
from equipoise.app.text.sparkline import BLOCKS
from equipoise.io.testbed.presets import read_preset
from equipoise.model.recording import Recording, Samples
from equipoise.model.step import Step
from equipoise.simulation.bench import SimulatedBench

pytest.importorskip("pty", reason="no pseudo terminals")
from tests.support.outcomes import OBSERVED
from tests.support.outcomes import verdict as verdict_of
from tests.support.pseudo_terminal import ESCAPE, HIDE, SHOW, AtTerminal, screen, stripped

BED = read_preset("nanosat")
LEAN = np.radians(12.0) / 2
LEANING = [[1.0, 0.0, 0.0, 0.0], [np.cos(LEAN), 0.0, np.sin(LEAN), 0.0]]
ROWS = Recording(
    attitude=Samples(np.array([2.0, 3.0]), np.array(LEANING)),
    rate=Samples(np.array([3.0]), np.radians([[0.0, 3.0, 4.0]])),
    mass_names=("x", "y", "z"),
    masses=Samples(np.array([3.0]), np.array([[0.001, -0.014, 0.0]])),
)
COM = np.array([1.2e-6, -30.06e-6, -1e-4])
VERDICT = verdict_of(True, COM, np.array([1e-7, 2e-7, 1e-6]))


def view():
    found = TerminalView(BED)
    found.rows(ROWS)
    found.step(Step("verify", 2.5, VERDICT.reasons, verdict=VERDICT))
    return found


def drawn(what, width=80, encoding="utf-8"):
    """Return the lines of what is drawn at a terminal of some width."""
    file = io.TextIOWrapper(io.BytesIO(), encoding=encoding, errors="strict")
    console = Console(file=file, width=width, force_terminal=True, color_system=None)
    console.print(what)
    file.seek(0)
    return file.read().splitlines()


def test_the_status_block_shows_the_latest_values_in_bench_units():
    assert drawn(view()) == [
        "",
        "  bench time       3.0 s  tilt  12.00 deg (limit 40)  rate   5.00 deg/s",
        "  masses, mm  x   1.00  y -14.00  z   0.00",
        "  com, um     x 1.2 +/- 0.1  y -30.1 +/- 0.2  z -100.0 +/- 1.0  at 2.5 s",
        "  tilt        █ to 12.0 deg, 2 s",
    ]


def test_a_terminal_without_blocks_gets_plain_letters():
    reported = "\n".join(drawn(view(), encoding="ascii"))
    assert reported.isascii()
    assert "# to 12.0 deg, 2 s" in reported


@pytest.mark.parametrize("width", [1, 5, 20, 40, 60, 80, 200])
def test_no_line_is_wider_than_the_terminal_and_none_is_wrapped(width):
    """What is too long is cut: a name begins each line that does not go on with numbers."""
    lines = drawn(view(), width)
    assert all(len(line) <= width for line in lines)
    assert len(lines) <= 1 + 2 + 3 * 5  # at most a line for each text


def test_texts_are_put_side_by_side_where_the_width_allows():
    assert filled(["name", "ab", "cd", "ef"], 14) == ["  name  ab  cd", "  ef"]
    assert filled(["name", "ab"], 60) == ["  name        ab"]


def test_a_step_that_says_nothing_of_the_centre_of_mass_leaves_the_last_that_did():
    found = view()
    found.step(Step("measurement", 9.0, OBSERVED))
    assert any("at 2.5 s" in line for line in drawn(found))


def test_unknown_quantities_are_not_shown():
    assert drawn(TerminalView(BED)) == ["", "  bench time       0.0 s"]
    found = view()
    sd = np.array([1e-7, np.inf, 1e-6])
    found.step(Step("verify", 4.0, VERDICT.reasons, verdict=replace(VERDICT, sd=sd)))
    assert any("y unobservable" in line for line in drawn(found))


def test_recording_progress_shows_share_file_and_rows_of_each_channel(tmp_path):
    found = RecordingView(BED, tmp_path / "run.mcap", 1.0, 8.0)
    found.rows(ROWS)
    reported = drawn(found)
    assert "  record       25% of 8 s  run.mcap" in reported
    assert "  rows        attitude 2  rate 1  masses 1" in reported


def test_a_drawing_failure_is_reported_in_the_block_and_nowhere_else():
    found = view()
    found.newest = None
    (_, reported) = drawn(found, 120)
    assert reported.startswith("  the view has failed, the bench continues: AttributeError")


def interactive(monkeypatch, **environment):
    """Let signs of life be drawn at a terminal in memory; return where."""
    file = io.StringIO()
    console = Console(file=file, force_terminal=True, width=80, soft_wrap=True,
                      _environ={"TERM": "xterm", **environment})  # fmt: skip
    monkeypatch.setattr(terminal, "_new_stderr", lambda: console)
    return file


def test_a_simulated_bench_is_handed_on_whole_and_one_without_a_terminal_as_it_is(monkeypatch):
    bench = SimulatedBench(BED, 1)
    assert watched_by(view(), bench) is bench
    interactive(monkeypatch)
    found = TerminalView(BED)
    observed = watched_by(found, bench)
    assert observed is not bench
    rows = observed.read(2.0)
    assert found.newest.counts["attitude"] == len(rows.attitude)


def test_what_is_said_meanwhile_stands_above_the_block(monkeypatch):
    file = interactive(monkeypatch)
    with terminal.busy("balancing", above=view()):
        terminal.complain("a sentence of one who was asked")
    left = screen(file.getvalue())
    assert left == ["equipoise: a sentence of one who was asked"]
    assert file.getvalue().rindex(SHOW) > file.getvalue().rindex(HIDE)


def test_a_dumb_terminal_gets_plain_lines(monkeypatch):
    file = interactive(monkeypatch, TERM="dumb")
    with terminal.busy("balancing", above=view()):
        pass
    assert file.getvalue() == "balancing ...\n"
    assert watched_by(view(), None) is None


BALANCE = ("balance", "nanosat", "--seed", 1)


def without_its_making(document):
    return re.sub(r'"(made at|command to repeat)": ".*"', "", document)


def test_balancing_with_a_live_view_gives_the_same_document_as_without(equipoise, tmp_path):
    """The same seed, the same bytes; the block is on stderr alone and leaves nothing behind."""
    observed = AtTerminal(tmp_path, [*BALANCE, "--json"], stdout=subprocess.PIPE)
    with observed.stdout:
        document = observed.stdout.read().decode()
    plain = equipoise(*BALANCE, "--json")
    assert observed.ended() == plain.code
    assert without_its_making(document) == without_its_making(plain.out)
    assert "\x1b" not in plain.out + plain.err
    reported = stripped(observed.written)
    for text in ("bench time", "(limit 40)", "deg/s", "masses, mm", "com, um", "balancing ..."):
        assert text in reported
    assert re.search(f"[{BLOCKS}] to [0-9.]+ deg, ", reported)
    assert observed.written.rindex(SHOW) > observed.written.rindex(HIDE)
    assert screen(observed.written) == []


def test_ctrl_c_leaves_a_narrow_terminal_clean(tmp_path):
    """Without colour and without blocks; the code is a shell's for Ctrl-C."""
    environment = {"NO_COLOR": "1", "PYTHONIOENCODING": "ascii"}
    observed = AtTerminal(tmp_path, BALANCE, (40, 15), environment)
    observed.wait_for(" deg, ")
    observed.ctrl_c()
    assert observed.ended() == BY_HAND
    assert observed.written.rindex(SHOW) > observed.written.rindex(HIDE)
    *above, last = screen(observed.written)
    assert last.startswith("equipoise: stopped by hand")
    assert all(re.match(r" +[0-9.]+ s  \w+|  ", line) for line in above), above
    assert not any("bench time" in line or "balancing" in line for line in above)
    assert not any(verb == "m" and "3" in n for _, n, verb in ESCAPE.findall(observed.written))
    assert re.search(r"[#*+=] to [0-9.]+ deg, ", stripped(observed.written))
