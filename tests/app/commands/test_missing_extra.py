"""A command whose extra is not installed names it."""

import subprocess
import sys

BLOCKED = """
import sys
sys.modules["nicegui"] = None  # as if it were not installed
from equipoise.app.cli import main
main()
"""


def test_a_dashboard_without_its_extra_names_it(tmp_path):
    words = [sys.executable, "-c", BLOCKED, "dashboard", "nanosat", "--port", "0"]
    done = subprocess.run(words, capture_output=True, text=True, cwd=tmp_path, check=False)
    assert done.returncode == 2, done.stderr
    assert "pip install equipoise[dashboard]" in done.stderr
    assert "nicegui is not installed" in done.stderr
    assert "Traceback" not in done.stderr
