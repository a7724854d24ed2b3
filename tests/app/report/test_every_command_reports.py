"""What a command prints stands in its report, block by block."""

import pytest

from equipoise.app.text.blocks import Claim, Figure, Table, document_of_text

COMMANDS = {
    "observe": ("observe", "RECORD", "--testbed", "sputnix"),
    "estimate": ("identify", "RECORD", "--testbed", "sputnix"),
    "assess": ("assess", "RECORD", "--testbed", "sputnix"),
    "calibrate": ("calibrate", "RECORD", "--testbed", "sputnix"),
    "design": ("design", "sputnix", "--record-s", "30"),
    "plan": ("plan", "reference-table", "--trials", "2", "--moves", "1", "--duration-s", "8"),
    "balance": ("balance", "sputnix", "--seed", "3"),
}

# What a person looks for: a figure of the paper, and words at the terminal.
FIGURES = {"estimate": "figure06_attitude", "balance": "figure14_balancing"}
WORDS = {"estimate": ("predicted for",), "balance": ("Before and after", "truth after")}


@pytest.mark.usefixtures("few_platforms")
@pytest.mark.parametrize("name", COMMANDS)
def test_the_report_holds_what_the_terminal_shows(name, equipoise, record_file, tmp_path):
    words = [record_file if word == "RECORD" else word for word in COMMANDS[name]]
    done = equipoise(*words, "--out", "out")
    assert done.code in (0, 1)
    folder = tmp_path / "out"
    for file in ("report.html", "report.pdf", f"{name}.json"):
        assert (folder / file).stat().st_size > 0
    document = document_of_text((folder / "report.json").read_text("utf-8"), "report.json")
    blocks = [block for section in document.sections for block in section.blocks]
    printed = " ".join(done.out.split())
    claims = [block for block in blocks if isinstance(block, Claim)]
    assert claims
    assert all(" ".join(claim.text.split()) in printed for claim in claims)
    titles = {block.title for block in blocks if isinstance(block, Table)}
    assert any(title and title in done.out for title in titles)
    for figure in (block for block in blocks if isinstance(block, Figure)):
        assert (folder / "figures" / f"{figure.name}.svg").exists()
    if name in FIGURES:
        assert (folder / "figures" / f"{FIGURES[name]}.svg").exists()
    assert all(words in done.out for words in WORDS.get(name, ()))


@pytest.mark.parametrize("name", ["observe", "calibrate", "plan"])
def test_a_folder_that_cannot_be_written_is_refused_before_any_work(name, equipoise, record_file):
    words = [record_file if word == "RECORD" else word for word in COMMANDS[name]]
    done = equipoise(*words, "--out", record_file)
    assert (done.code, done.out) == (2, "")
