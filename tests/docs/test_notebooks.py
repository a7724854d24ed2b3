"""The notebooks of docs/notebooks run from top to bottom, and are kept without outputs."""

import nbformat
import pytest
from nbclient import NotebookClient

from tests.docs.test_examples import ROOT

FOLDER = ROOT / "docs" / "notebooks"
NOTEBOOKS = sorted(FOLDER.glob("*.ipynb"))
PATIENCE = 300  # s a cell, against a kernel that hangs


def read(path):
    return nbformat.read(path, as_version=4)


def test_there_are_five():
    assert len(NOTEBOOKS) == 5


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_is_kept_without_outputs(path):
    book = read(path)
    nbformat.validate(book)
    cells = [cell for cell in book.cells if cell.cell_type == "code"]
    assert cells
    assert all(cell.outputs == [] and cell.execution_count is None for cell in cells)
    assert path.stat().st_size < 10_000


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_runs_and_shows_figures_and_tables(path, tmp_path, monkeypatch):
    """A cell that fails raises; what a reader comes for is there."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("EQUIPOISE_RUNS", "")
    book = read(path)
    NotebookClient(book, timeout=PATIENCE, resources={"metadata": {"path": tmp_path}}).execute()
    shown = [each for cell in book.cells for each in cell.get("outputs", [])]
    kinds = {kind for each in shown for kind in each.get("data", {})}
    assert "text/html" in kinds
    drawn = any(".plot()" in cell.source for cell in book.cells)
    assert ("image/png" in kinds) == drawn
    assert [each.text for each in shown if each.get("name") == "stderr"] == []
