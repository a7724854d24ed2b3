"""The report stands alone and shows all that was done."""

import re
from html.parser import HTMLParser
from pathlib import Path

import pytest

from equipoise import __version__

README = Path(__file__).parents[3] / "README.md"
VOID = {"meta", "img", "br"}
OF_A_REPORT = {"report.html", "report.pdf", "report.json"}
LARGEST = 3_000_000  # bytes
PAPER = ["06", "07", "08", "11", "12", "13", "14", "15"]


class Balanced(HTMLParser):
    """Fails on a tag that is not closed in its place."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []

    def handle_starttag(self, tag, attrs):
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    from equipoise.app.cli import run

    out = tmp_path_factory.mktemp("demo") / "made" / "here"
    assert run(["demo", "--out", str(out)]) in (0, 1)
    return out


def test_the_demo_writes_every_figure_of_the_paper(folder):
    figures = sorted(path.name for path in folder.glob("figures/figure*.svg"))
    assert [name[6:8] for name in figures] == PAPER
    others = {path.name for path in folder.iterdir()}
    assert others == OF_A_REPORT | {
        "figures",
        "balance.json",
        "testbed.toml",
        "recording.csv",
        "run.json",
    }


def test_figures_of_steps_say_where_the_masses_are(folder):
    """Identification states com with the masses at home, as every method does; balance does not.

    Rests, the linear method and the fit stand beside each other, by name.
    """
    page = (folder / "report.html").read_text(encoding="utf-8")
    identified, balanced = page.split("<h2>Balance</h2>")
    assert identified.count("masses at home, um in body axes, with bars") == 3
    assert "in their present positions, um" not in identified
    assert (
        balanced.count("with bars of two standard deviations; shaded: target with tolerance") >= 3
    )
    drawn = (folder / "figures" / "step04_estimate.svg").read_text()
    assert "momentum_laboratory" in drawn
    assert "trajectory" in drawn


def test_every_measurement_or_estimate_step_has_its_figure(folder):
    page = (folder / "report.html").read_text(encoding="utf-8")
    drawn = sorted(path.stem for path in folder.glob("figures/*.svg"))
    measurements = page.count("<b>measurement<") + page.count("<b>verify<")
    assert len(drawn) >= len(PAPER) + measurements > len(PAPER)


def test_the_report_needs_no_other_file(folder):
    page = (folder / "report.html").read_text(encoding="utf-8")
    assert "http" not in re.sub(r"data:image/svg[^']*", "", page)
    assert page.count("src='data:image/svg+xml,") == len(list(folder.glob("figures/*.svg")))
    assert len(page) < LARGEST
    parser = Balanced()
    parser.feed(page)
    assert parser.open == []


def test_the_report_states_how_to_repeat_the_run(folder):
    page = (folder / "report.html").read_text(encoding="utf-8")
    for word in ("command to repeat", "seed", __version__, "preset sputnix", "95 % interval"):
        assert word in page
    assert "Before and after" in page
    assert "What the data cannot show" in page


def test_every_step_is_in_the_report(folder, strict_json):
    page = (folder / "report.html").read_text(encoding="utf-8")
    document = strict_json((folder / "balance.json").read_text(encoding="utf-8"))
    for step in document["steps"]:
        assert step["sentence"].replace("'", "&#x27;").replace(">", "&gt;") in page


def test_a_record_is_drawn_on_request(equipoise, record_file, tmp_path):
    for name in ("record.png", "record.svg", "record.pdf"):
        assert equipoise("inspect", record_file, "--figure", name).code == 0
        assert (tmp_path / name).stat().st_size > 5000


def test_a_new_testbed_reads_back(equipoise):
    assert equipoise("new", "sputnix").code == 0
    assert equipoise("simulate", "sputnix.toml", "--out", "a.csv", "--duration-s", "5").code == 0


def test_the_same_seed_gives_the_same_record(equipoise, tmp_path):
    for name, seed in (("a.csv", 1), ("b.csv", 1), ("c.csv", 2)):
        words = ["--out", name, "--duration-s", "5", "--seed", seed]
        assert equipoise("simulate", "sputnix", *words).code == 0
    a, b, c = ((tmp_path / name).read_bytes() for name in ("a.csv", "b.csv", "c.csv"))
    assert a == b != c


def test_readme_shows_what_the_demo_finds(folder):
    """To a tenth of an sd: the last digits may differ from machine to machine."""
    shown = re.findall(
        r"^(com_[xyz]|inertia_P_\w\w) +(-?[\d.]+) +([\d.]+) ",
        README.read_text("utf-8"),
        re.MULTILINE,
    )
    page = (folder / "report.html").read_text(encoding="utf-8")
    cell = r'<td class="right">(-?[\d.]+)</td>'
    row = rf'<th scope="row">([a-z]+_\w+)</th>{cell}{cell}'
    found = {name: (float(value), float(sd)) for name, value, sd in re.findall(row, page)}
    assert len(shown) >= 4
    for name, value, sd in shown:
        assert float(value) == pytest.approx(found[name][0], abs=0.1 * found[name][1])
        assert float(sd) == pytest.approx(found[name][1], rel=0.1)
