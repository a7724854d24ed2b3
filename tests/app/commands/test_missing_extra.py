"""A command whose extra is not installed names it."""

import subprocess
import sys

import pytest

BLOCKED = """
import sys
sys.modules["{library}"] = None  # as if it were not installed
from equipoise.app.cli import main
main()
"""
COMPARE = ("compare", "reference-table", "--laws", "--only", "pid", "--runs", "1")
CASES = {
    "dashboard": ("nicegui", ("dashboard", "nanosat", "--port", "0")),
    "cluster": ("distributed", (*COMPARE, "--on", "dask://127.0.0.1:8786")),
    "parquet": ("pyarrow", (*COMPARE, "--resume", "kept")),
}


@pytest.mark.parametrize(("extra", "library", "words"), [(k, *v) for k, v in CASES.items()])
def test_a_command_without_its_extra_names_it(tmp_path, extra, library, words):
    code = BLOCKED.format(library=library)
    words = [sys.executable, "-c", code, *words]
    done = subprocess.run(words, capture_output=True, text=True, cwd=tmp_path, check=False)
    assert done.returncode == 2, done.stderr
    assert f"pip install equipoise[{extra}]" in done.stderr
    assert f"{library} is not installed" in done.stderr
    assert "Traceback" not in done.stderr
