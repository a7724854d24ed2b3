"""A folder with runs of elsewhere: a broken or hostile one costs the list nothing but itself."""

import csv
import json
import os
from pathlib import Path

import pytest

from equipoise.io.documents.run_file import text_of_run
from equipoise.model.estimate import COM, INERTIA, Parameter
from equipoise.model.logged_run import LoggedRun, Usability

NAMES = (
    "[red]a[/red]", "b[/red]", "[link=http://x]c[/link]", "\x1b]0;t\x07d", "e\u202e\u200b",
    "=cmd|'/c calc'!A1", "<script>f</script>", "#eval(1)", "../../x", "$\\frac{", "g\0", "{h}",
    ":smile:",
)  # fmt: skip
ACTING = {"\x1b", "\x07", "\u202e", "\u200b", "\0", "\x9b"}


def visible(name: str) -> str:
    """Return how a name is shown, written by hand for the letters above."""
    for letter, shown in (("\x1b", r"\x1b"), ("\x07", r"\x07"), ("\u202e", r"\u202e"),
                          ("\u200b", r"\u200b"), ("\0", r"\x00")):  # fmt: skip
        name = name.replace(letter, shown)
    return name


def entry(name: str, platform: str, week: int = 1, **more: object) -> LoggedRun:
    found = tuple(Parameter(p, "m" if p in COM else "kg m2", 1e-4 + week * 1e-6, 1e-6)
                  for p in (*COM, *INERTIA))  # fmt: skip
    values = {"kind": "identify", "made_at": f"2026-01-{week:02d}T09:00:00+00:00",
              "configuration": "0" * 64, "method": "x", "bench": "x",
              "outcome": Usability.USABLE, "sentence": platform, "parameters": found}  # fmt: skip
    return LoggedRun(name=name, platform=platform, **{**values, **more})


def put(folder: Path, text: str | bytes, testbed: bytes = b"") -> None:
    folder.mkdir(parents=True)
    (folder / "run.json").write_bytes(text.encode() if isinstance(text, str) else text)
    if testbed:
        (folder / "testbed.toml").write_bytes(testbed)


@pytest.fixture
def hostile(tmp_path):
    """Return a folder of runs whose names, and whose texts, mean to do something."""
    runs = tmp_path / "runs"
    for week, name in enumerate(NAMES, 1):
        folder = f"{week} {name}".replace("/", "_").replace("\0", "")
        put(runs / folder, text_of_run(entry(folder, name, week)), b"\xff[red")
    return runs


def test_every_run_is_listed_as_it_is_written(equipoise, hostile):
    """``[/red]`` in one name broke the list of the whole folder; ``[link=`` made another vanish."""
    for words in ((), ("--builds",), ("--compare", "1", "2")):
        done = equipoise("logbook", hostile, *words)
        assert (done.code, done.err) == (0, "")
        assert not ACTING & set(done.out)
        listed = NAMES if not words or words[0] == "--builds" else NAMES[:2]
        for word in " ".join(map(visible, listed)).split():  # a long name may take two lines
            assert word in done.out


def test_documents_for_programs_hold_the_names_and_act_nowhere(equipoise, hostile, strict_json):
    done = equipoise("logbook", hostile, "--json")
    assert not ACTING & set(done.out)
    assert {run["platform"] for run in strict_json(done.out)["runs"]} == set(NAMES)


def test_no_cell_of_an_export_is_a_formula(equipoise, hostile, tmp_path):
    assert equipoise("logbook", hostile, "--export", "runs.csv").code == 0
    text = (tmp_path / "runs.csv").read_text(encoding="utf-8")
    assert not ACTING & set(text)
    rows = list(csv.DictReader(text.splitlines()))
    assert {row["platform"].removeprefix("'") for row in rows} == set(map(visible, NAMES))
    for row in rows:
        assert not row["platform"].startswith(("=", "+", "-", "@"))
        assert float(row["com_x_m"]) > 0


@pytest.mark.parametrize("name", NAMES)
def test_a_name_is_no_formula_of_a_figure_either(equipoise, tmp_path, name):
    """``$`` began one, and an odd number of them ended the program."""
    for week in (1, 2):
        put(tmp_path / "runs" / f"r{week}", text_of_run(entry("r", name, week)))
    done = equipoise("logbook", "runs", "--trend", "trend.svg")
    assert done.code == 0
    assert not ACTING & set((tmp_path / "trend.svg").read_text(encoding="utf-8"))


def changed(**parts: object) -> str:
    document = json.loads(text_of_run(entry("x", "x")))
    document["run"] |= parts
    return json.dumps(document)


BROKEN = {
    "cut": "{",
    "empty": "",
    "nested": '{"run": ' + "[" * 100_000,
    "list": "[]",
    "year 1": changed(made_at="0001-01-01T00:00:00"),
    "last year": changed(made_at="9999-12-31T23:59:59-14:00"),
    "no time": changed(made_at="spring"),
    "endless time": changed(made_at="9" * 5000),
    "other kind": changed(kind="attack"),
    "number for a text": changed(platform=1e308),
    "list for a text": changed(platform=["x"]),
    "text for a number": changed(temperature="warm"),
    "lone surrogate": changed(platform="\ud800"),
    "parameters": changed(parameters=[{"name": "com_x"}]),
    "negative sd": text_of_run(entry("x", "x", parameters=(Parameter("com_x", "m", 1e-6, -1.0),))),
    "far future": changed(made_at="9999-12-30T00:00:00"),
    "before 1970": changed(made_at="1969-01-01T00:00:00"),
    "binary": b"\x00\xff\x1b]0;t\x07",
}


@pytest.mark.parametrize("text", BROKEN.values(), ids=BROKEN.keys())
def test_a_broken_run_is_left_out_alone(equipoise, tmp_path, text):
    runs = tmp_path / "runs"
    put(runs / "good", text_of_run(entry("good", "good bed")))
    put(runs / "odd\x1b[31m", text)
    done = equipoise("logbook", runs)
    assert done.code == 0
    assert "good bed" in done.out
    assert len(done.err.splitlines()) == 1
    assert r"odd\x1b[31m" in done.err
    assert not ACTING & set(done.err)


def test_a_folder_whose_name_is_no_text_is_left_out_alone(equipoise, tmp_path):
    """SQLite keeps no such name; it ended the list."""
    runs = tmp_path / "runs"
    put(runs / "good", text_of_run(entry("good", "good bed")))
    put(Path(os.fsdecode(os.fsencode(runs) + b"/odd\xff")), text_of_run(entry("odd", "odd bed")))
    done = equipoise("logbook", runs)
    assert done.code == 0
    assert "good bed" in done.out
    assert r"odd\xff" in done.err


@pytest.mark.parametrize("bed", [b"\xff\xfe\x00", b"[red", b"a = " + b"[" * 5000, b"\0" * 100])
def test_a_testbed_that_is_none_costs_no_list(equipoise, tmp_path, bed):
    runs = tmp_path / "runs"
    for week, testbed in ((1, b"mass = 1\n"), (2, bed), (3, b"mass = 2\n")):
        run = entry("r", "bed", week, configuration=f"c{week}")
        put(runs / f"r{week}", text_of_run(run), testbed)
    for words in ((), ("--builds",), ("--builds", "--json")):
        assert equipoise("logbook", runs, *words).code == 0


@pytest.mark.parametrize("value", [1e308, -1e308, 1e-320, float("inf"), float("nan"), 0.0])
def test_numbers_beyond_all_measure_cost_no_list(equipoise, tmp_path, value):
    runs = tmp_path / "runs"
    odd = tuple(Parameter(name, "m", value, abs(value)) for name in (*COM, *INERTIA))
    for week in (1, 2):
        run = entry("r", "bed", week, parameters=odd, standing=odd, temperature=value)
        put(runs / f"r{week}", text_of_run(run))
    for words in ((), ("--json",), ("--compare", "1", "2"), ("--export", "a.csv")):
        assert equipoise("logbook", runs, *words).code == 0
    assert equipoise("logbook", runs, "--trend", "a.png").code in (0, 2)
